#pragma once
// W impacts that share their solids, advancing together. Four parts, each a file:
//
//   State    where every body is, what acts between them and on them          impact/state.hpp
//   Moving   one step of a method, over every body and contact                impact/moving.hpp
//   Watch    between steps: ledger, frequency bounds, endings                 impact/watch/watch.hpp
//   report   from what was followed of a run to its outcome                   impact/report.hpp
//
// A lane begins with a scene, is advanced with the others, and is cleared when a look has found its end. Nothing here
// knows how many bodies there are; engine.cpp compiles it for each lane width.

#include <functional>

#include "impact/moving.hpp"
#include "impact/snapshot.hpp"
#include "impact/watch/watch.hpp"

namespace ricochet {

/// An impact on its way from a lane to one of an engine of another width, between two steps.
struct Handover {
  Run run;
  Carrier carrier;
  std::optional<AnchorCourse> course;
};

template <int W>
class Engine {
 public:
  /// `threads`: how many share the work of one impact alone (W = 1), the caller's among them.
  Engine(const Solids& solids, const Method& method, const std::vector<Effect>& effects, int threads = 1);

  const Run& run(int lane) const { return watch_.run(lane); }
  /// Whether the lane has ceased to be finite.
  bool broken(int lane) const { return state_.broken[static_cast<std::size_t>(lane)].has_value(); }
  bool idle(int lane) const { return watch_.idle(lane); }

  /// Puts a scene into a lane. Returns the outcome at once if it never touches.
  std::optional<Outcome> begin(int lane, const Scene& scene, std::size_t index);
  /// The same from a start that somebody has made.
  void begin(int lane, const Scene& scene, std::size_t index, const Start& start);

  /// `seen`: a look or a snapshot follows.
  void advance_one_step(bool seen = true);

  using Ended = typename Watch<W>::Ended;
  /// After every step: looks at the lanes that have asked for it: those that have come to an end.
  std::vector<Ended> look_closely();
  /// Looks at every lane: those that have come to an end.
  std::vector<Ended> look();
  Snapshot snapshot(int lane);

  void clear(int lane);
  Handover give(int lane);
  void take(int lane, Handover&& impact);
  void spend(int lane, double seconds) { watch_.run(lane).seconds += seconds; }

  int steps_between_looks() const;
  const Method& method() const { return state_.method; }

  /// Test hook: the bodies where the run is, which most methods leave ahead of a step's end.
  Motions<W>& bodies() { return state_.bodies; }
  /// Test hook: changes the bodies at the end of the last step, in every lane.
  void change(const std::function<void(Motions<W>&)>& by);

 private:
  State<W> state_;
  Moving<W> moving_;
  Watch<W> watch_;
  bool looks_closely_ = false;  // at the end of the step that was made last
};

}  // namespace ricochet
