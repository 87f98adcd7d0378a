#pragma once
#include <vector>

#include "contact/exponential_repulsion.hpp"
#include "contact/pair_forces.hpp"
#include "shape/surface.hpp"

namespace ricochet {

/// Gaps between nodes p and cells a b of another surface, or a plane: one array a quantity, so that loops over them
/// vectorise.
struct Gaps {
  std::vector<double> px, py, ax, ay, bx, by;  ///< in: places [R]; a and b unused before a plane
  std::vector<double> weight;                  ///< in: the pair's own number; empty: 1
  std::vector<double> along;                   ///< out: where on the segment the closest point lies, 0 at a, 1 at b
  std::vector<double> energy;                  ///< out: of the pair [m0 c^2]; 0 beyond the law's reach
  std::vector<double> fx, fy;                  ///< out: force on the node [m0 c^2/R]; its reverse acts on the segment
  std::vector<double> distance;                ///< out, with pair forces only: of the pair [R]

  void resize(std::size_t count) {
    for (auto* values : {&px, &py, &ax, &ay, &bx, &by, &along, &energy, &fx, &fy}) values->resize(count);
  }
  std::size_t size() const { return px.size(); }
};

/// Fills in what follows from the places. `plane`: what the nodes stand before; nullptr: segments.
void measure(Gaps& g, const ExponentialRepulsion& law, const std::vector<PairForce>& forces = {},
             const Plane* plane = nullptr);

/// After measure(), of segments: leaves every node the nearest segment of its own alone. `node`: [gap] whose it is;
/// gaps of a node stand together. Of two that are equally near, to 1e-9 of the energy, as both sides of a vertex are to
/// a node beside it, the first.
void keep_nearest(Gaps& g, const std::vector<int>& node);

/// After measure(), of segments: turns every force to the outward normal of its segment, F = xi V n, V the energy.
void turn_to_normals(Gaps& g, const ExponentialRepulsion& law);

}  // namespace ricochet
