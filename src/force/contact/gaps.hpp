#pragma once
#include <vector>

#include "force/contact/adhesion.hpp"
#include "force/contact/candidates.hpp"
#include "force/contact/exponential_repulsion.hpp"

namespace ricochet {

/// Gaps between rim nodes p and rim segments a b of the other body: one array a quantity, so that loops over them
/// vectorise.
struct Gaps {
  std::vector<double> px, py, ax, ay, bx, by;  ///< in: places [R]
  std::vector<double> along;                   ///< out: where on the segment the closest point lies, 0 at a, 1 at b
  std::vector<double> energy;                  ///< out: of the pair [m0 c^2]; 0 beyond the law's reach
  std::vector<double> fx, fy;                  ///< out: force on the node [m0 c^2/R]; its reverse acts on the segment
  std::vector<double> distance;                ///< out, with adhesion only: of the pair [R]

  void resize(std::size_t count) {
    for (auto* values : {&px, &py, &ax, &ay, &bx, &by, &along, &energy, &fx, &fy}) values->resize(count);
  }
};

/// `energy` holds distances before, energies after;
/// `fx`, `fy` the vectors from the closest point before, forces after.
inline void repel(std::size_t count, double V0, double xi, double reach, double* __restrict energy,
                  double* __restrict fx, double* __restrict fy) {
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = energy[i];
    const bool within = distance < reach;
    const double pair_energy = (within ? V0 : 0.0) * exponential(-xi * (within ? distance : reach));
    // On the segment itself the direction is undefined and the force 0; no scene that conserves energy gets there below
    // V0.
    const double scale = xi * pair_energy / (distance > 0 ? distance : 1.0);
    energy[i] = pair_energy;
    fx[i] *= scale;
    fy[i] *= scale;
  }
}

/// Adds adhesion to forces that are so far those of the repulsion alone.
inline void attract(Gaps& g, const Adhesion& law, double reach) {
  for (std::size_t i = 0; i < g.px.size(); ++i) {
    const double distance = g.distance[i];
    if (!(distance > 0 && distance < reach)) continue;
    const double closest_x = g.ax[i] + g.along[i] * (g.bx[i] - g.ax[i]),
                 closest_y = g.ay[i] + g.along[i] * (g.by[i] - g.ay[i]);
    const double scale = law.force(distance) / distance;
    g.fx[i] += scale * (g.px[i] - closest_x);
    g.fy[i] += scale * (g.py[i] - closest_y);
  }
}

/// Fills in what follows from the places. `adhesion` may be nullptr.
inline void measure(Gaps& g, const ExponentialRepulsion& law, const Adhesion* adhesion = nullptr) {
  closest_points(g.px.size(), g.px.data(), g.py.data(), g.ax.data(), g.ay.data(), g.bx.data(), g.by.data(),
                 g.along.data(), g.fx.data(), g.fy.data(), g.energy.data());
  if (adhesion) g.distance = g.energy;
  repel(g.px.size(), law.V0, law.xi, law.reach, g.energy.data(), g.fx.data(), g.fy.data());
  if (adhesion) attract(g, *adhesion, law.reach);
}

}  // namespace ricochet
