#include "integrate/step_limit.hpp"

#include <cmath>

namespace ricochet {

FrequencyBound frequency_bound(const Lattice& lattice, double stiffness) {
  struct Block {
    double xx = 0, xy = 0, yy = 0;
    double largest_eigenvalue() const { return (xx + yy) / 2 + std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy); }
  };
  std::vector<Block> blocks(lattice.nodes());
  for (int i = 0; i < lattice.free; ++i)
    for (int s = lattice.first[i]; s < lattice.first[i + 1]; ++s) {
      const Spring& spring = lattice.spring[s];
      const Vec2 n = (lattice.points[spring.other] - lattice.points[i]) / spring.length;
      for (const int node : {i, spring.other}) {
        blocks[node].xx += spring.stiffness * n.x() * n.x();
        blocks[node].xy += spring.stiffness * n.x() * n.y();
        blocks[node].yy += spring.stiffness * n.y() * n.y();
      }
    }
  FrequencyBound bound{0, 0};
  for (int i = 0; i < lattice.free; ++i) {
    const double omega = std::sqrt(2 * stiffness * blocks[i].largest_eigenvalue() / lattice.mass);
    if (omega > bound.omega) bound = {omega, i};
  }
  return bound;
}

}  // namespace ricochet
