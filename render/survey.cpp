#include "render/survey.hpp"

#include <algorithm>
#include <cmath>

namespace ricochet::render {

Points shown_places(const Show& show, const FrameMesh& mesh, const Frame& frame) {
  Points places;
  for (const Eigen::Vector2f& p : frame.position) places.push_back(p.cast<double>());
  if (show.magnify == 1) return places;
  for (int body : {0, 1}) {
    const Motion motion = motion_of(mesh, frame, body);
    for (int i = 0; i < mesh.nodes(); ++i) {
      if (mesh.body_of(i) != body) continue;
      const Vec2 rigid = motion.moved(mesh.rest[i]);
      places[i] = rigid + show.magnify * (places[i] - rigid);
    }
  }
  return places;
}

void Survey::see(const Show& show, const FrameMesh& mesh, const Fields& fields, const Frame& frame) {
  for (const Vec2& p : shown_places(show, mesh, frame))
    if (p.allFinite()) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if (const Quantity* quantity = coloured_quantity(show)) {
    const bool material = show.material == quantity->name;
    std::vector<double> values = material ? fields.of_material(quantity->name, frame) : fields.of_springs(quantity->name, frame);
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
    if (!values.empty()) {
      // The one spring in a thousand that is strongest does not pale all others.
      const auto share = [&](double part) {
        const auto place = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
        std::nth_element(values.begin(), place, values.end());
        return *place;
      };
      value_high = std::max(value_high, share(0.999)), value_low = std::min(value_low, share(0.001));
    }
  }
  most_energy = std::max(most_energy, frame.energy[7]);
  if (show.forces)
    for (int i = 0; i < mesh.projectile_nodes; ++i) most_force = std::max<double>(most_force, frame.contact_force[static_cast<std::size_t>(i)].norm());
  if (show.velocity || show.trail) {
    const Motion motion = motion_of(mesh, frame, 0);
    most_speed = std::max(most_speed, motion.velocity.norm());
    trail.push_back(motion.centre);
  }
  times.push_back(frame.time);
  if (plotted_quantity(show)) series.push_back(plotted_value(show.plot, mesh, frame));
}

double Scale::operator()(double value) const {
  const double part = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return root ? std::sqrt(part) : part;
}

Scale common_scale(const Show& show, const std::vector<const Survey*>& surveys) {
  Scale scale;
  const Quantity* quantity = coloured_quantity(show);
  if (!quantity) return scale;
  double low = 0, high = 0;
  for (const Survey* survey : surveys) low = std::min(low, survey->value_low), high = std::max(high, survey->value_high);
  if (quantity->is_signed) high = std::max(high, -low), low = -high;
  else low = 0;
  if (high == low) high = low + 1;  // all is at rest
  scale.high = std::isnan(show.high) ? high : show.high;
  scale.low = !std::isnan(show.low) ? show.low : quantity->is_signed && !std::isnan(show.high) ? -show.high : low;
  if (!(scale.high > scale.low)) scale.high = scale.low + std::max(1.0, std::abs(scale.low));  // all values lie below the given low
  scale.root = show.scale == "sqrt" || (show.scale == "auto" && !quantity->is_signed && quantity->name.starts_with("energy"));
  return scale;
}

}  // namespace ricochet::render
