#include "body/modal/build.hpp"

#include <algorithm>
#include <cmath>

#include "body/description.hpp"
#include "body/modes.hpp"
#include "core/error.hpp"

namespace ricochet {
namespace {

// What a body of stiffness 1 does; its modes' shapes are those of any.
std::vector<Mode> modes_of(const Solid& solid, int count) {
  const int all = solid.free_coordinates() - (solid.anchored() ? 0 : 3);
  try {
    return slowest_modes(solid, 1, count > 0 ? count : std::min(all, most_modes));
  } catch (const Error& error) {
    throw FieldError("modes", error.what());
  }
}

MovedNodes moved(std::vector<int> nodes, const std::vector<Mode>& modes) {
  MovedNodes moved{std::move(nodes), {}};
  moved.shape.reserve(modes.size() * 2 * moved.node.size());
  for (const Mode& mode : modes)
    for (const int node : moved.node)
      for (int d = 0; d < 2; ++d) moved.shape.push_back(mode.shape[2 * node + d]);
  return moved;
}

// The greatest eigenvalue of what a force on a node does to the node: the flight of the body, its turning, its modes.
double give(const Modes& modes, std::size_t rim_node) {
  const Vec2 turned = perpendicular(modes.arm[static_cast<std::size_t>(modes.rim.node[rim_node])]);
  double xx = modes.per_mass + modes.per_inertia * turned.x() * turned.x();
  double yy = modes.per_mass + modes.per_inertia * turned.y() * turned.y();
  double xy = modes.per_inertia * turned.x() * turned.y();
  for (std::size_t k = 0; k < modes.omega.size(); ++k) {
    const double* shape = modes.rim.of_mode(k) + 2 * rim_node;
    xx += shape[0] * shape[0];
    yy += shape[1] * shape[1];
    xy += shape[0] * shape[1];
  }
  return (xx + yy) / 2 + std::hypot((xx - yy) / 2, xy);
}

}  // namespace

std::shared_ptr<const Solid> as_modes(const std::shared_ptr<const Solid>& solid, int count) {
  const std::vector<Mode> slowest = modes_of(*solid, count);
  Modes modes;
  modes.of = solid;
  for (const Mode& mode : slowest) modes.omega.push_back(mode.omega);
  std::vector<int> free, rim;
  for (int i = 0; i < solid->free; ++i) free.push_back(i);
  std::copy_if(surface_nodes(solid->surface).begin(), surface_nodes(solid->surface).end(), std::back_inserter(rim),
               [&](int node) { return node < solid->free; });
  modes.all = moved(std::move(free), slowest);
  modes.rim = moved(std::move(rim), slowest);
  const Vec2 centre = solid->centre();
  for (const Vec2& p : solid->points) modes.arm.push_back(p - centre);
  if (!solid->anchored()) {
    modes.per_mass = 1 / solid->total_mass();
    modes.per_inertia = 1 / solid->inertia();
  }
  modes.give.assign(solid->points.size(), 0);
  for (std::size_t n = 0; n < modes.rim.node.size(); ++n)
    modes.give[static_cast<std::size_t>(modes.rim.node[n])] = give(modes, n);
  Eigen::Index most = 0;
  slowest.back().shape.cwiseAbs().maxCoeff(&most);
  modes.fastest_node = static_cast<int>(most / 2);
  auto made = std::make_shared<Solid>(*solid);
  made->interior = std::move(modes);
  return made;
}

}  // namespace ricochet
