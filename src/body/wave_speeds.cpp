#include "body/wave_speeds.hpp"

#include <cmath>

#include "body/elasticity.hpp"

namespace ricochet {
namespace {

double mass_of_all_nodes(const Solid& solid) {
  double sum = 0;
  for (int i = 0; i < solid.nodes(); ++i) sum += solid.mass[i];
  return sum;
}

double measure_of_cells(const Solid& solid) {
  double sum = 0;
  for (const Triangle& cell : solid.cells) sum += measure_at_rest(solid, cell);
  return sum;
}

}  // namespace

double surface_over_shear(double shear_over_pressure) {
  const auto left = [&](double y) {
    const double z = y * shear_over_pressure;
    return (2 - y * y) * (2 - y * y) - 4 * std::sqrt(1 - y * y) * std::sqrt(1 - z * z);
  };
  // Below 0 under the root, above 0 beyond it; no material's lies below 0.5, and y = 0 solves it too.
  double low = 0.5, high = 1;
  while (high - low > 1e-14) {
    const double middle = (low + high) / 2;
    (left(middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

WaveSpeeds wave_speeds(const Body& body, const Solid& solid) {
  const bool uniform =
      body.node_stiffness.empty() && body.node_density.empty() && body.node_nu.empty() && body.numbers.prestress == 0;
  if (body.rigid() || solid.cells.empty() || !uniform) return {};
  const PlaneModuli moduli = usual_moduli(body.numbers);
  const double E2 = moduli.per_stiffness * body.numbers.stiffness, nu2 = moduli.poisson_ratio;
  const double density = mass_of_all_nodes(solid) / measure_of_cells(solid);
  WaveSpeeds speeds;
  speeds.pressure = std::sqrt(E2 / (density * (1 - nu2 * nu2)));
  speeds.shear = std::sqrt(E2 / (2 * density * (1 + nu2)));
  speeds.surface = speeds.shear * surface_over_shear(speeds.shear / speeds.pressure);
  return speeds;
}

}  // namespace ricochet
