#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/picture.hpp"

namespace ricochet::render {
namespace {

constexpr Colour grey{120, 120, 130, 255}, faint{205, 205, 210, 255};

// The round step that gives `count` ticks or a few more.
double round_step(double extent, int count) {
  const double rough = extent / count, decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 2.5, 5.0})
    if (rough <= step * decade) return step * decade;
  return 10 * decade;
}

std::vector<double> ticks(double low, double high, int count) {
  const double step = round_step(high - low, count);
  std::vector<double> list;
  const double first = std::ceil(low / step - 1e-9);
  for (int k = 0; k < 100 && (first + k) * step <= high + 1e-9 * step; ++k) list.push_back((first + k) * step);
  return list;
}

// Ticks of which two at least are not 0, so that a scale can be read.
std::vector<double> readable_ticks(double low, double high, int count) {
  std::vector<double> list;
  for (int more = count; more < count + 6; ++more) {
    list = ticks(low, high, more);
    if (std::count_if(list.begin(), list.end(), [&](double v) { return std::abs(v) > 1e-9 * (high - low); }) >= 2)
      break;
  }
  return list;
}

}  // namespace

std::string number_text(double value, double step) {
  if (std::abs(value) < 1e-12 * std::max(1.0, step)) value = 0;
  std::string text =
      step > 0
          ? fmt::format(
                "{:.{}f}", value,
                std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)) +
                                (std::abs(step / std::pow(10.0, std::floor(std::log10(step) + 1e-9)) - 2.5) < 1e-6)))
          : fmt::format("{:.4g}", value);
  if (text[0] == '-') text.replace(0, 1, "−");
  return text;
}

int power_of(double most) {
  if (!(most > 0)) return 0;
  const int power = static_cast<int>(std::floor(std::log10(most) + 1e-9));
  return power >= -2 && power < 4 ? 0 : power;
}

int time_power(const Units& units, double last) { return units.si ? power_of(last * units.worth("R/c")) : 0; }

std::string typeset(std::string unit) {
  for (std::size_t at = unit.find("m0 "); at != std::string::npos; at = unit.find("m0 ")) unit.replace(at, 3, "m_0");
  return unit;
}

std::string unit_of(const Quantity& quantity, const FrameMesh& mesh) {
  const auto& bodies = mesh.bodies;
  const bool in_space =
      std::any_of(bodies.begin(), bodies.end(), [](const BodyMesh& body) { return body.axisymmetric; });
  return in_space && quantity.unit == "m0 c^2/R^2" ? "m0 c^2/R^3" : quantity.unit;
}

std::string unit_text(const std::string& unit, int power) {
  const std::string factor = power == 0 ? "" : fmt::format("10^{{{}}}", number_text(power));
  return factor + (factor.empty() || unit.empty() ? "" : " ") + unit;
}

std::string label_of(const Quantity& quantity, int power, const FrameMesh& mesh) {
  const std::string unit = unit_text(typeset(mesh.units.name(unit_of(quantity, mesh))), power);
  return unit.empty() ? quantity.label : fmt::format("{} [{}]", quantity.label, unit);
}

std::vector<BarMark> bar_marks(const Scale& scale, double factor, bool tall) {
  const std::vector<double> values = readable_ticks(scale.low / factor, scale.high / factor, tall ? 5 : 3);
  std::vector<BarMark> marks;
  for (const double value : values)
    marks.push_back({value * factor, number_text(value, values.size() > 1 ? values[1] - values[0] : 0)});
  return marks;
}

void draw_colour_bar(Canvas& canvas, const Box& box, int size, const Scale& scale, const std::vector<Colour>& colours,
                     const std::vector<BarMark>& marks) {
  const double share = box.height / static_cast<double>(colours.size()), thin = std::max(1.0, size / 18.0);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double low = std::round(box.y + box.height - share * static_cast<double>(i + 1)),
                 high = std::round(box.y + box.height - share * static_cast<double>(i));
    canvas.rectangle({box.x, low}, {box.width, high - low}, colours[i]);
  }
  canvas.polyline({{box.x, box.y},
                   {box.x + box.width, box.y},
                   {box.x + box.width, box.y + box.height},
                   {box.x, box.y + box.height}},
                  thin, grey, true);
  // What lies beyond an end has its colour: a tip says so.
  const double tip = 0.9 * box.width;
  if (scale.most > scale.high * (1 + 1e-6))
    canvas.triangle({box.x, box.y}, {box.x + box.width, box.y}, {box.x + box.width / 2, box.y - tip}, colours.back());
  if (scale.least < scale.low - 1e-6 * std::abs(scale.low))
    canvas.triangle({box.x, box.y + box.height}, {box.x + box.width, box.y + box.height},
                    {box.x + box.width / 2, box.y + box.height + tip}, colours.front());
  double last = 1e300;
  for (const BarMark& mark : marks) {
    const double y = box.y + box.height * (scale.low < scale.high ? 1 - scale(mark.value) : 0.5);
    if (last - y < 1.1 * size) continue;
    last = y;
    canvas.line({box.x + box.width, y}, {box.x + box.width + 0.3 * size, y}, thin, grey);
    canvas.text({box.x + box.width + 0.45 * size, y + 0.36 * size}, mark.text, size, black);
  }
}

namespace {

// What the ledger's parts are called; the last is what effects hold or have taken, if that ever counts, by their names.
std::vector<std::string> part_names(const Subject& subject) {
  std::vector<std::string> names{"normal", "tangential", "spin", "vibration", "target", "contact"};
  if (!subject.survey.effects) return names;
  std::string effects;
  for (const std::string& effect : subject.mesh.effects) effects += (effects.empty() ? "" : ", ") + effect;
  std::replace(effects.begin(), effects.end(), '_', ' ');
  names.push_back(effects.empty() ? "effects" : effects);
  return names;
}

// Where each name of the ledger's parts stands, in rows of this width: x and row.
std::vector<std::pair<double, int>> legend_of(Canvas& canvas, double width, int size,
                                              const std::vector<std::string>& names) {
  std::vector<std::pair<double, int>> places;
  double x = 0;
  int row = 0;
  for (const std::string& name : names) {
    const double taken = 1.0 * size + canvas.text_width(name, size);
    if (x > 0 && x + taken > width) {
      x = 0;
      ++row;
    }
    places.emplace_back(x, row);
    x += taken + 0.9 * size;
  }
  return places;
}

}  // namespace

double ledger_height(Canvas& canvas, double width, int size, const Subject& subject) {
  const int rows = legend_of(canvas, width, size, part_names(subject)).back().second;
  return (2.9 + 1.2 * rows) * size;
}

void draw_ledger(Canvas& canvas, const Box& box, int size, const Tile& tile) {
  const Survey& survey = tile.subject->survey;
  std::array<double, 7> parts = ledger_parts(tile.subject->mesh, *tile.frame);
  // A potential has no zero of its own: counted from its least, all energy that stays fills all of the bar.
  parts[6] -= survey.owed;
  const double most = survey.most_energy;
  const std::vector<std::string> names = part_names(*tile.subject);
  const auto places = legend_of(canvas, box.width, size, names);
  const double bar = std::round(0.9 * size), y = box.y + (1.45 + 1.2 * places.back().second) * size,
               thin = std::max(1.0, size / 18.0);
  canvas.rectangle({box.x, y}, {box.width, bar}, {240, 240, 242, 255});
  double x = box.x;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Colour colour = kind_colour(static_cast<int>(k));
    const double width = most > 0 ? std::min(std::max(0.0, parts[k]) / most * box.width, box.x + box.width - x) : 0;
    if (width > 0) canvas.rectangle({x, y}, {width, bar}, colour);
    x += width;
    const double left = box.x + places[k].first, top = box.y + (0.35 + 1.2 * places[k].second) * size;
    canvas.rectangle({left, std::round(top)}, {std::round(0.7 * size), std::round(0.7 * size)}, colour);
    canvas.text_within(std::max(1.0, box.x + box.width - left - 1.0 * size), {left + 1.0 * size, top + 0.7 * size},
                       names[k], size, black);
  }
  canvas.polyline({{box.x, y}, {box.x + box.width, y}, {box.x + box.width, y + bar}, {box.x, y + bar}}, thin, grey,
                  true);
}

namespace {

// The axis of time below a plot, from `first` to `last`. [R/c]
void draw_moments(Canvas& canvas, const Box& in, int size, const Units& units, double first, double last) {
  const int power = time_power(units, last);
  const double factor = std::pow(10.0, power) / units.worth("R/c"), thin = std::max(1.0, size / 18.0);
  const std::string name = fmt::format("t [{}]", unit_text(units.name("R/c"), power));
  const auto moments = ticks(first / factor, last / factor, in.width > 30 * size ? 6 : 3);
  for (const double moment : moments) {
    const double t = moment * factor, x = in.x + in.width * (t - first) / (last - first);
    canvas.line({x, in.y + in.height}, {x, in.y + in.height + 0.3 * size}, thin, grey);
    const std::string text = number_text(moment, moments.size() > 1 ? moments[1] - moments[0] : 0);
    if (x + 0.5 * canvas.text_width(text, size) + 0.6 * size < in.x + in.width - canvas.text_width(name, size))
      canvas.text({x, in.y + in.height + 1.3 * size}, text, size, black, Align::centre);
  }
  canvas.text({in.x + in.width, in.y + in.height + 1.3 * size}, name, size, black, Align::right);
}

}  // namespace

void draw_plot(Canvas& canvas, const Box& box, int size, const Tile& tile, const Quantity& quantity) {
  const Survey& survey = tile.subject->survey;
  double low = survey.curve.front().y(), high = low;
  for (const Vec2& point : survey.curve) {
    low = std::min(low, point.y());
    high = std::max(high, point.y());
  }
  if (quantity.name != "height") {
    low = std::min(0.0, low);
    high = std::max(0.0, high);
  }
  if (high == low) high = low + 1;
  const double room = 0.06 * (high - low);
  high += room;
  low -= low == 0 ? 0 : room;
  const double thin = std::max(1.0, size / 18.0);
  const double first = survey.times.front(), last = survey.times.back() > first ? survey.times.back() : first + 1;
  const Units& units = tile.subject->mesh.units;
  const double worth = units.worth(unit_of(quantity, tile.subject->mesh));
  const int power = power_of(worth * std::max(high, -low));
  const double factor = std::pow(10.0, power) / worth;
  const Box in{box.x + 3.4 * size, box.y + 1.3 * size, box.width - 4.2 * size, box.height - 2.8 * size};
  const auto x = [&](double t) { return in.x + in.width * (t - first) / (last - first); };
  const auto y = [&](double v) { return in.y + in.height * (1 - (v - low) / (high - low)); };
  const auto marks = readable_ticks(low / factor, high / factor, in.height > 5 * size ? 4 : 3);
  for (const double mark : marks) {
    canvas.line({in.x, y(mark * factor)}, {in.x + in.width, y(mark * factor)}, thin, mark == 0 ? grey : faint);
    canvas.text({in.x - 0.4 * size, y(mark * factor) + 0.36 * size},
                number_text(mark, marks.size() > 1 ? marks[1] - marks[0] : 0), size, black, Align::right);
  }
  draw_moments(canvas, in, size, units, first, last);
  canvas.text({box.x, box.y + 0.8 * size}, label_of(quantity, power, tile.subject->mesh), size, black);
  canvas.line({in.x, in.y}, {in.x, in.y + in.height}, thin, grey);
  canvas.line({in.x, in.y + in.height}, {in.x + in.width, in.y + in.height}, thin, grey);
  Points curve;
  for (const Vec2& point : survey.curve)
    if (point.x() <= tile.frame->time) curve.push_back({x(point.x()), y(point.y())});
  canvas.polyline(curve, std::max(1.2, 0.12 * size), kind_colour(0));
  if (!curve.empty()) canvas.disc(curve.back(), 0.25 * size, kind_colour(5));
}

}  // namespace ricochet::render
