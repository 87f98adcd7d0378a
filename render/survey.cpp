#include "render/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace ricochet::render {

Points shown_places(const Show& show, const FrameMesh& mesh, const Frame& frame) {
  Points places;
  for (int i = 0; i < mesh.nodes(); ++i) places.push_back(seen(mesh, frame.position, i));
  if (show.magnify == 1) return places;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    const Motion motion = motion_of(mesh, frame, static_cast<int>(b));
    const BodyMesh& body = mesh.bodies[b];
    for (int i = body.first; i < body.first + body.nodes; ++i) {
      const Vec2 rigid = motion.moved(seen(mesh, mesh.rest, i));
      places[i] = rigid + show.magnify * (places[i] - rigid);
    }
  }
  return places;
}

// Nodes that broke loose are not worth a smaller picture, and of an open chain, which goes on beside it, only its
// height is seen.
void Survey::see_surfaces(const FrameMesh& mesh, const Points& places) {
  for (const BodyMesh& body : mesh.bodies)
    for (const MeshChain& chain : body.surface)
      for (const int node : chain.node) {
        const Vec2& place = places[static_cast<std::size_t>(node)];
        if (!place.allFinite()) continue;
        const int first_axis = chain.closed ? 0 : 1;
        for (int axis = first_axis; axis < 2; ++axis) {
          low[axis] = std::min(low[axis], place[axis]);
          high[axis] = std::max(high[axis], place[axis]);
        }
      }
}

namespace {

void check_waves(const FrameMesh& mesh) {
  if (mesh.bodies.size() < 2 || std::isnan(mesh.bodies[1].wave_speeds[0]))
    throw FieldError(
        "fronts",
        "needs a target whose waves have one speed: it must not be rigid or prestressed, nor its stiffness "
        "or density differ from place to place; a recording by an older version does not hold it");
  if (std::isnan(mesh.first_touch)) throw FieldError("fronts", "needs bodies that touch, and these never do");
}

}  // namespace

void Survey::see(const Show& show, const FrameMesh& mesh, const Fields& fields, const Frame& frame) {
  const Points places = shown_places(show, mesh, frame);
  see_surfaces(mesh, places);
  if (const Quantity* quantity = coloured_quantity(show)) {
    const bool material = show.material == quantity->name;
    std::vector<double> values =
        material ? fields.of_material(quantity->name, frame) : fields.of_springs(quantity->name, frame);
    if (material && mesh.bodies.size() > 1)
      for (int i = 0; i < mesh.bodies[1].nodes; ++i)
        if (const double v = std::abs(values[static_cast<std::size_t>(mesh.bodies[1].first + i)]); std::isfinite(v))
          target_most = std::max(target_most, v);
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
    if (!values.empty()) {
      // The one spring in a thousand that is strongest does not pale all others.
      const auto share = [&](double part) {
        const auto place = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
        std::nth_element(values.begin(), place, values.end());
        return *place;
      };
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      value_least = std::min(value_least, *least);
      value_most = std::max(value_most, *most);
      value_high = std::max(value_high, share(0.999));
      value_low = std::min(value_low, share(0.001));
    }
  }
  if (show.ledger) {
    const std::array<double, 7> parts = ledger_parts(mesh, frame);
    double sum = 0;
    for (std::size_t k = 0; k + 1 < parts.size(); ++k) sum += std::max(0.0, parts[k]);
    owed = std::min(owed, parts.back());
    most_total = std::max(most_total, sum + parts.back());
    most_energy = std::max(sum, most_total - owed);
    effects = effects || std::abs(parts.back()) > 1e-4 * most_energy;
  }
  if (show.fronts) {
    check_waves(mesh);
    if (const double missed = std::abs(frame.time - mesh.first_touch); missed < touch_missed_) {
      touch_missed_ = missed;
      touch = contact_place(mesh, frame);
    }
  }
  if (show.forces)
    for (int i = 0; i < mesh.bodies.front().nodes; ++i)
      most_force = std::max<double>(most_force, seen(mesh, frame.contact_force, i).cast<float>().norm());
  if (show.velocity || show.trail) {
    const Motion motion = motion_of(mesh, frame, 0);
    most_speed = std::max(most_speed, motion.velocity.norm());
    trail.push_back(motion.centre);
  }
  times.push_back(frame.time);
  if (plotted_quantity(show)) curve.emplace_back(frame.time, plotted_value(show.plot, mesh, frame));
}

double Scale::operator()(double value) const {
  if (low < 0 && high > 0)
    return std::clamp(0.5 + 0.5 * value / (value < 0 ? -low : high), 0.0, 1.0);  // 0 in the middle of the colours
  const double part = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return root ? std::sqrt(part) : part;
}

Scale common_scale(const Show& show, const std::vector<const Survey*>& surveys, double worth) {
  Scale scale;
  const Quantity* quantity = coloured_quantity(show);
  if (!quantity) return scale;
  double low = 0, high = 0;
  for (const Survey* survey : surveys) {
    low = std::min(low, survey->value_low);
    high = std::max(high, survey->value_high);
    scale.most = std::max(scale.most, survey->value_most);
    scale.least = std::min(scale.least, survey->value_least);
  }
  if (quantity->is_signed) {
    high = std::max(high, -low);
    low = -high;
  } else
    low = 0;
  if (high == low) high = low + 1;  // all is at rest
  const double wanted_low = show.low / worth, wanted_high = show.high / worth;
  scale.high = !std::isnan(show.high) ? wanted_high : quantity->is_signed && !std::isnan(show.low) ? -wanted_low : high;
  scale.low = !std::isnan(show.low) ? wanted_low : quantity->is_signed && !std::isnan(show.high) ? -wanted_high : low;
  if (!(scale.high > scale.low))
    throw FieldError("low", fmt::format("lies above all values, of which the greatest is {:.4g}", high * worth));
  scale.root =
      show.scale == "sqrt" || (show.scale == "auto" && !quantity->is_signed && quantity->name.starts_with("energy"));
  return scale;
}

}  // namespace ricochet::render
