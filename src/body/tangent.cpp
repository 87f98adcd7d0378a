#include "body/tangent.hpp"

#include <vector>

#include "body/elements/stiffness.hpp"
#include "body/springs/tangent.hpp"

namespace ricochet {
namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

// The block of two free nodes, row by row.
void add_block(Entries& entries, int a, int b, const NodeStiffness<1>& k) {
  entries.emplace_back(2 * a, 2 * b, k.xx[0]);
  entries.emplace_back(2 * a, 2 * b + 1, k.xy[0]);
  entries.emplace_back(2 * a + 1, 2 * b, k.yx[0]);
  entries.emplace_back(2 * a + 1, 2 * b + 1, k.yy[0]);
}

Eigen::SparseMatrix<double> tangent_stiffness(const Solid& solid, const Elements& elements) {
  Motion<1> body = at_rest<1>(solid);
  body.stiffness = 1;
  AssembledStiffness<1> K;
  K.assemble(body, elements);
  Entries entries;
  for (int i = 0; i < solid.free; ++i) add_block(entries, i, i, K.diagonal[static_cast<std::size_t>(i)]);
  for (std::size_t s = 0; s < elements.edge.size(); ++s) {
    const auto& [i, j] = elements.edge[s];
    if (i >= solid.free || j >= solid.free) continue;
    const NodeStiffness<1>& k = K.off_diagonal[s];
    add_block(entries, i, j, k);
    add_block(entries, j, i, NodeStiffness<1>(k.xx, k.yx, k.xy, k.yy));
  }
  Eigen::SparseMatrix<double> matrix(solid.free_coordinates(), solid.free_coordinates());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

Eigen::SparseMatrix<double> tangent_stiffness(const Solid& solid) {
  if (const Springs* springs = solid.springs()) return tangent_stiffness(solid, *springs);
  if (const Elements* elements = solid.elements()) return tangent_stiffness(solid, *elements);
  if (const Modes* modes = solid.modes()) return tangent_stiffness(*modes->of);
  return {solid.free_coordinates(), solid.free_coordinates()};
}

}  // namespace ricochet
