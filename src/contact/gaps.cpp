#include "contact/gaps.hpp"

#include <algorithm>

#include "core/exponential.hpp"
#include "shape/closest.hpp"

namespace ricochet {
namespace {

// `energy` holds distances before, energies after;
// `fx`, `fy` the vectors from the closest point before, forces after.
void repel(std::size_t count, double V0, double xi, double reach, double* __restrict energy, double* __restrict fx,
           double* __restrict fy) {
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

// The law before a plane, whose distance has a sign: V0 exp(-xi d) rises on inside it, so that nothing is passed. It
// is bounded by exp(700), where no impact is finite any more.
void repel_from_plane(Gaps& g, const ExponentialRepulsion& law, const Plane& plane) {
  const double nx = plane.normal.x(), ny = plane.normal.y();
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double distance = nx * g.px[i] + ny * g.py[i] - plane.offset;
    const bool within = distance < law.reach;
    const double exponent = std::min(-law.xi * (within ? distance : law.reach), 700.0);
    g.energy[i] = (within ? law.V0 : 0.0) * exponential(exponent);
    g.fx[i] = law.xi * g.energy[i] * nx;
    g.fy[i] = law.xi * g.energy[i] * ny;
    g.along[i] = 0;
    g.ax[i] = g.bx[i] = g.px[i] - distance * nx;
    g.ay[i] = g.by[i] = g.py[i] - distance * ny;
  }
}

// Adds a pair force to forces that are so far those of the repulsion alone.
template <class Law>
void add_pair_force(Gaps& g, const Law& law, double reach) {
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double distance = g.distance[i];
    if (!(distance != 0 && distance < reach)) continue;  // below 0 inside a plane
    const double closest_x = g.ax[i] + g.along[i] * (g.bx[i] - g.ax[i]),
                 closest_y = g.ay[i] + g.along[i] * (g.by[i] - g.ay[i]);
    const double scale = law.force(distance) / distance;
    g.fx[i] += scale * (g.px[i] - closest_x);
    g.fy[i] += scale * (g.py[i] - closest_y);
  }
}

}  // namespace

void measure(Gaps& g, const ExponentialRepulsion& law, const std::vector<PairForce>& forces, const Plane* plane) {
  if (plane) {
    repel_from_plane(g, law, *plane);
    if (!forces.empty()) {
      g.distance.resize(g.size());
      for (std::size_t i = 0; i < g.size(); ++i)
        g.distance[i] = plane->normal.x() * g.px[i] + plane->normal.y() * g.py[i] - plane->offset;
    }
  } else {
    closest_points(g.size(), g.px.data(), g.py.data(), g.ax.data(), g.ay.data(), g.bx.data(), g.by.data(),
                   g.along.data(), g.fx.data(), g.fy.data(), g.energy.data());
    if (!forces.empty()) g.distance = g.energy;
    repel(g.size(), law.V0, law.xi, law.reach, g.energy.data(), g.fx.data(), g.fy.data());
  }
  for (std::size_t i = 0; i < g.weight.size(); ++i) {
    g.energy[i] *= g.weight[i];
    g.fx[i] *= g.weight[i];
    g.fy[i] *= g.weight[i];
  }
  for (const PairForce& force : forces)
    std::visit([&](const auto& of_pairs) { add_pair_force(g, of_pairs, law.reach); }, force);
}

void keep_nearest(Gaps& g, const std::vector<int>& node) {
  for (std::size_t begin = 0, end = 0; begin < g.size(); begin = end) {
    std::size_t nearest = begin;
    for (end = begin + 1; end < g.size() && node[end] == node[begin]; ++end)
      if (g.energy[end] > g.energy[nearest] * (1 + 1e-9)) nearest = end;
    for (std::size_t i = begin; i < end; ++i)
      if (i != nearest) g.energy[i] = g.fx[i] = g.fy[i] = 0;
  }
}

void turn_to_normals(Gaps& g, const ExponentialRepulsion& law) {
  for (std::size_t i = 0; i < g.size(); ++i) {
    const Vec2 edge(g.bx[i] - g.ax[i], g.by[i] - g.ay[i]);
    const double length = edge.norm(), scale = length > 0 ? law.xi * g.energy[i] / length : 0;
    g.fx[i] = scale * edge.y();  // the inside of a surface lies to the left of its segments
    g.fy[i] = -scale * edge.x();
  }
}

}  // namespace ricochet
