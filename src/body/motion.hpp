#pragma once
#include <vector>

#include "body/elements/flow.hpp"
#include "body/modal/motion.hpp"
#include "body/shares.hpp"
#include "body/solid.hpp"
#include "core/coordinates.hpp"

namespace ricochet {

/// One body in motion, in W lanes: flat coordinates, the free ones first. `f` collects what acts on a coordinate until
/// its kick, which empties it; on a held one, which is never kicked, it only grows, and only moving anchors are asked
/// for it.
template <int W>
struct Motion {
  const Solid* solid = nullptr;
  Coordinates<W> q, v, f;               ///< places [R], velocities [c], forces [m0 c^2/R]
  Lane<W> stiffness = Lane<W>::Zero();  ///< of each lane: ka of springs, E of elements [m0 c^2/R^2]
  /// Sum of the free coordinates' velocities at the last kick: finite as long as they all are.
  Lane<W> pulse = Lane<W>::Zero();
  Flow<W>* flow = nullptr;           ///< of elements that yield; whoever lets them keeps it
  const Sharing* sharing = nullptr;  ///< whose threads share its sweep; nobody's: that of the caller
  ModalMotion<W> modal{};            ///< of a body of modes: where its nodes are follows from it
};

/// The bodies of a scene, by index.
template <int W>
using Motions = std::vector<Motion<W>>;

/// At rest where it was built, in every lane.
template <int W>
Motion<W> at_rest(const Solid& solid) {
  Motion<W> motion{&solid, {}, {}, {}};
  for (Coordinates<W>* values : {&motion.q, &motion.v, &motion.f}) values->resize(solid.coordinates());
  for (int i = 0; i < solid.nodes(); ++i)
    for (int lane = 0; lane < W; ++lane) motion.q.set(i, lane, solid.points[static_cast<std::size_t>(i)]);
  if (const Modes* modes = solid.modes()) motion.modal.rest(modes->omega.size(), solid.centre());
  return motion;
}

}  // namespace ricochet
