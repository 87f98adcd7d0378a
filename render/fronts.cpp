// How far waves have come in the target since the first touch.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/tile.hpp"

namespace ricochet::render {
namespace {

constexpr Colour front_colour{20, 20, 30, 255};

// Whether a point lies inside of closed lines, by how many of their sides lie to its right.
bool lies_inside(const Vec2& p, const std::vector<Points>& lines) {
  bool inside = false;
  for (const Points& line : lines)
    for (std::size_t i = 0, j = line.size() - 1; i < line.size(); j = i++) {
      const Vec2 &a = line[i], &b = line[j];
      if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
        inside = !inside;
    }
  return inside;
}

void draw_label(Canvas& canvas, const Brush& brush, const Vec2& at, const std::string& text) {
  const double width = canvas.text_width(text, brush.text), size = brush.text;
  canvas.rectangle({at.x() - width / 2 - 0.2 * size, at.y() - 0.6 * size}, {width + 0.4 * size, 1.2 * size},
                   {255, 255, 255, 225});
  canvas.text({at.x(), at.y() + 0.36 * size}, text, brush.text, front_colour, Align::centre);
}

/// An arc about a place, where it lies inside of the target and the panel.
struct Arc {
  Vec2 centre;
  double radius;  ///< [pixels]
  double dash;    ///< [pixels]; 0: a whole line
  double label;   ///< where its name stands if it can: the angle from straight down
};

void draw_arc(Canvas& canvas, const Brush& brush, const Arc& arc, const std::vector<Points>& target, const Box& cut,
              const std::string& name) {
  const int count = std::clamp(static_cast<int>(2 * std::numbers::pi * arc.radius / brush.unit), 60, 5000);
  const double step = 2 * std::numbers::pi / count;
  const auto point = [&](int k) {  // pixels run down
    const double angle = -std::numbers::pi + k * step;
    return Vec2(arc.centre + arc.radius * Vec2(std::sin(angle), std::cos(angle)));
  };
  const int around = 1 + static_cast<int>(1.2 * brush.text / (step * arc.radius));  // points that a name covers
  int seen = 0, label = -1;
  std::vector<Points> runs(1);
  for (int k = 0; k <= count; ++k) {
    const Vec2 p = point(k);
    const bool shown = p.x() > cut.x && p.x() < cut.x + cut.width && p.y() > cut.y && p.y() < cut.y + cut.height &&
                       lies_inside(p, target);
    seen = shown ? seen + 1 : 0;
    const auto off = [&](int place) { return std::abs(place * step - std::numbers::pi - arc.label); };
    if (seen > 2 * around && (label < 0 || off(k - around) < off(label))) label = k - around;
    const bool gap = arc.dash > 0 && std::fmod(k * step * arc.radius, 2 * arc.dash) > arc.dash;
    if (shown && !gap)
      runs.back().push_back(p);
    else if (!runs.back().empty())
      runs.emplace_back();
  }
  for (const auto& [width, colour] : {std::pair{3.4, Colour{255, 255, 255, 190}}, std::pair{1.5, front_colour}})
    for (const Points& run : runs) canvas.polyline(run, width * brush.unit, colour);
  if (label >= 0) draw_label(canvas, brush, point(label), name);
}

// The place so far along a closed line from its point `from`, and the line's direction there; ends where it is held.
bool walk(const Points& line, const std::vector<bool>& held, std::size_t from, int way, double distance, Vec2& place,
          Vec2& along) {
  const std::size_t n = line.size();
  std::size_t i = from;
  for (std::size_t k = 0; k < n / 2 && !held[i]; ++k) {
    const std::size_t next = (i + n + static_cast<std::size_t>(way + static_cast<int>(n))) % n;
    const Vec2 side = line[next] - line[i];
    const double length = side.norm();
    if (length > 0 && distance <= length) {
      along = side / length;
      place = line[i] + distance * along;
      return true;
    }
    distance -= length;
    i = next;
  }
  return false;
}

void draw_surface_marks(Canvas& canvas, const Brush& brush, const Points& line, const std::vector<bool>& held,
                        const Vec2& centre, double distance) {
  std::size_t from = 0;
  for (std::size_t i = 0; i < line.size(); ++i)
    if ((line[i] - centre).norm() < (line[from] - centre).norm()) from = i;
  for (const int way : {-1, 1}) {
    Vec2 place, along;
    if (!walk(line, held, from, way, distance, place, along)) continue;
    const Vec2 out = way * Vec2(-along.y(), along.x());  // the inside lies to the left, and pixels run down
    const double size = brush.text;
    canvas.line(place - 0.8 * size * out, place + 0.8 * size * out, 4 * brush.unit, {255, 255, 255, 190});
    canvas.line(place - 0.8 * size * out, place + 0.8 * size * out, 2 * brush.unit, front_colour);
    draw_label(canvas, brush, place + 1.5 * size * out, "R");
  }
}

}  // namespace

void draw_fronts(Canvas& canvas, const Brush& brush, const Tile& tile, const Points& pixels, const View& view,
                 const Box& cut) {
  const FrameMesh& mesh = tile.subject->mesh;
  const BodyMesh& target = mesh.bodies[1];
  const double since = tile.frame->time - mesh.first_touch;
  if (!(since > 0)) return;
  std::vector<Points> lines;
  std::size_t nearest = 0;
  double least = 1e300;
  const Vec2 centre = view(tile.subject->survey.touch);
  for (const MeshChain& chain : target.surface) {
    lines.emplace_back();
    for (const int node : chain.node) {
      lines.back().push_back(pixels[static_cast<std::size_t>(node)]);
      if (const double distance = (lines.back().back() - centre).norm(); distance < least) {
        least = distance;
        nearest = lines.size() - 1;
      }
    }
  }
  const auto pixels_of = [&](std::size_t wave) { return target.wave_speeds[wave] * since * view.scale; };
  draw_arc(canvas, brush, {centre, pixels_of(0), 0, 0}, lines, cut, "P");
  draw_arc(canvas, brush, {centre, pixels_of(1), 0.6 * brush.text, 0.6}, lines, cut, "S");
  std::vector<bool> held;
  for (const int node : target.surface[nearest].node) held.push_back(mesh.anchored[static_cast<std::size_t>(node)]);
  draw_surface_marks(canvas, brush, lines[nearest], held, centre, pixels_of(2));
}

}  // namespace ricochet::render
