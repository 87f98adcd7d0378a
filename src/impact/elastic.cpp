#include "impact/elastic.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "body/elasticity.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double density_of(const Body& body) {
  if (!body.node_density.empty()) return mean(body.node_density);
  const BodyNumbers& numbers = body.numbers;
  return std::isnan(numbers.mass) ? numbers.area_density() : numbers.mass * numbers.nodes / signed_area(body.outline);
}

}  // namespace

double Elastic::wave_speed() const { return std::sqrt(modulus / (density * (1 - poisson * poisson))); }

double Elastic::shear_speed() const { return std::sqrt(modulus / (density * 2 * (1 + poisson))); }

Elastic elastic_of(const Body& body) {
  if (body.rigid()) return {};
  const PlaneModuli moduli = usual_moduli(body.numbers);
  const double stiffness = body.node_stiffness.empty() ? body.numbers.stiffness : mean(body.node_stiffness);
  return {moduli.per_stiffness * stiffness, moduli.poisson_ratio, density_of(body),
          std::find(body.anchored.begin(), body.anchored.end(), true) != body.anchored.end()};
}

}  // namespace ricochet
