#pragma once
// What a sweep tells its user, while it runs and at its end.

#include <chrono>
#include <functional>
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

/// How fast, how deep and how long a touch of these scenes is, by the law of a line contact; empty where none holds.
std::string scale_text(const std::vector<Scene>& scenes);

/// How many lattices were passed over for bodies of these scenes (crossing = "pass_over"); empty if none was.
std::string passed_over_text(const std::vector<Scene>& scenes);

/// How many rows hold numbers that mean less than they say: over_yield, folded, penetration above 0.01 R; a line each,
/// empty if none does.
std::string doubts_text(const std::vector<Row>& rows);
/// The same as warnings: where --quiet keeps back what a run says of itself.
void warn_of_doubts(Session& session, const std::vector<Row>& rows);

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

/// "pefrl, time step 0.0052 R/c, theta 1.6 and at most 1.68 (stable below 2.99)" for each method that ran.
std::string steps_text(const std::vector<Scene>& scenes, const std::vector<Row>& rows);

/// Warns of finished impacts that came so near to where their method is unstable that their error is unknown.
void warn_of_limit(Session& session, const std::vector<Scene>& scenes, const std::vector<Row>& rows,
                   const std::function<std::string(std::size_t)>& name);

}  // namespace ricochet
