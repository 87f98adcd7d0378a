#pragma once
// What a sweep tells its user, while it runs and at its end.

#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "impact/scene.hpp"
#include "record/row.hpp"
#include "script/session.hpp"

namespace ricochet {

/// One line on a terminal, plain lines elsewhere, nothing with --quiet.
class Progress {
 public:
  Progress(const Session& session, std::string name, std::size_t total, std::size_t before);

  void add(std::size_t count, std::size_t failed);

 private:
  using Clock = std::chrono::steady_clock;

  std::string name_;
  std::size_t total_, before_, done_, failed_ = 0, tenth_ = 0;
  bool quiet_, terminal_;
  Clock::time_point start_ = Clock::now();
};

/// What is told of a sweep at its end, gathered scene by scene and row by row: of a long one they are never all there.
class SweepTold {
 public:
  /// `scenes`: how many there will be; estimates are made of two hundred of them.
  explicit SweepTold(std::size_t scenes) : every_(scenes / 200 + 1) {}

  /// A scene by its place in the sweep.
  void add_scene(std::size_t place, const Scene& scene);

  /// What of a row is told.
  struct Ended {
    const Method* method;
    bool step_is_chosen, finished;
    double step, theta, theta_most, over_yield, folded;
    double penetration;  // [R]
  };
  const Units& units() const { return units_; }  ///< of the first scene
  void add_row(std::size_t place, const Ended& row);
  void add_row(std::size_t place, const Scene& scene, const Row& row);

  /// "pefrl, time step 0.0052 R/c, theta 1.6 and at most 1.68 (stable below 2.99)" for each method that ran, and the
  /// texts below.
  std::string steps_text() const;
  /// How fast, how deep and how long a touch of these scenes is, by the law of a line contact, and what is doubted of
  /// it; empty where no law holds. How many lattices were passed over for bodies of these scenes (crossing =
  /// "pass_over"). How many rows hold numbers that mean less than they say: over_yield, folded, penetration above 0.01
  /// R; a line each.
  std::string of_scenes() const { return scale_text() + passed_over_text() + doubts_text(); }
  /// The last of these as warnings: where --quiet keeps back what a run says of itself.
  void warn_of_doubts(Session& session) const;
  /// Warns of finished impacts that came so near to where their method is unstable that their error is unknown.
  void warn_of_limit(Session& session, const std::function<std::string(std::size_t)>& name) const;

 private:
  struct Extent {
    double low = HUGE_VAL, high = -HUGE_VAL;
    void include(double x);
    std::string text(int digits = 4) const;
  };
  struct Steps {
    Extent step, theta, most, bound;
  };

  std::string scale_text() const;
  std::string passed_over_text() const;
  std::string doubts_text() const;

  std::size_t every_, unknown_ = 0, rows_ = 0, near_limit_ = 0, worst_ = 0;
  Extent speed_, depth_, length_;
  bool elements_ = false;
  Units units_;
  bool knows_units_ = false;
  std::map<std::string, std::string> doubts_;  ///< that no column tells, by their kind
  std::map<std::string, int> passed_over_;     ///< lattices, by body
  std::map<std::string, Steps> methods_;
  std::array<std::size_t, 3> doubtful_{};  ///< rows, by the kinds of doubt that columns tell
  double most_ = 0, enough_ = 0;           ///< of the stability limit; theta
};

/// Of one impact that runs: on a terminal one line, anew every second, elsewhere a line after 10, 20, 40 ... seconds,
/// nothing with --quiet.
class RunProgress {
 public:
  /// `time_limit`: of the impact [R/c]; it and times are told in `units`.
  RunProgress(bool quiet, bool terminal, double time_limit, const Units& units = {});
  ~RunProgress();
  RunProgress(const RunProgress&) = delete;
  RunProgress& operator=(const RunProgress&) = delete;

  /// At the end of a step.
  void tell(double time);
  /// What is due after so many seconds; empty if nothing is.
  std::string line(double time, double seconds);

 private:
  using Clock = std::chrono::steady_clock;

  bool quiet_, terminal_, told_ = false;
  double time_limit_, next_;  // [R/c]; [s] since the start
  Units units_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace ricochet
