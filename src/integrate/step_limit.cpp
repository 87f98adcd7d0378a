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
      const Spring spring = lattice.spring[s];
      const Vec2 d = lattice.points[spring.other] - lattice.points[i];
      const double r = d.norm(), x = r - spring.length;  // not 0 under prestress
      const Vec2 n = d / r;
      const double across = spring.stiffness * std::abs(x) / r, more = spring.stiffness - across;
      for (const int node : {i, spring.other}) {
        blocks[node].xx += across + more * n.x() * n.x();
        blocks[node].xy += more * n.x() * n.y();
        blocks[node].yy += across + more * n.y() * n.y();
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
