#include "render/picture.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace ricochet::render {
namespace {

constexpr Colour black{20, 20, 30, 255}, white{255, 255, 255, 255}, rim_colour{25, 25, 38, 255},
    ghost_colour{110, 110, 120, 200}, hatch_colour{90, 90, 100, 255};

/// How the plane lies in a box of the painting.
struct View {
  Vec2 centre = Vec2::Zero();  // [R]
  double scale = 1;            // [pixels/R]
  Box box{};

  Vec2 operator()(const Vec2& p) const {
    const Vec2 d = scale * (p - centre);
    return {box.x + box.width / 2 + d.x(), box.y + box.height / 2 - d.y()};
  }
};

// Everything to be drawn at one place, and what it is drawn with.
struct Brush {
  const Show& show;
  Scale scale;
  int text;     // size [pixels]
  double unit;  // width of a thin stroke [pixels]
};

// The box that shows all of every tile: what is larger shall look larger, and what lies higher, higher.
std::pair<Vec2, Vec2> common_box(const std::vector<Tile>& tiles) {
  Vec2 low = tiles[0].subject->survey.low, high = tiles[0].subject->survey.high;
  for (const Tile& tile : tiles) {
    low = low.cwiseMin(tile.subject->survey.low);
    high = high.cwiseMax(tile.subject->survey.high);
  }
  return {low, high};
}

View view_of(const Show& show, const Tile& tile, const std::vector<Tile>& tiles, const Box& box, double margin) {
  if (show.camera == "fit") {
    const auto [low, high] = common_box(tiles);
    const Vec2 extent = (high - low).cwiseMax(1e-9);
    return {(low + high) / 2,
            std::min(std::max(1.0, box.width - 2 * margin) / extent.x(),
                     std::max(1.0, box.height - 2 * margin) / extent.y()),
            box};
  }
  const double width = !std::isnan(show.width) ? show.width : show.camera == "follow" ? 5.0 : 2.5;
  return {show.camera == "contact" ? contact_place(tile.subject->mesh, *tile.frame)
                                   : motion_of(tile.subject->mesh, *tile.frame, 0).centre,
          box.width / width, box};
}

void draw_material(Panel& panel, const Brush& brush, const Tile& tile, const Points& pixels) {
  const Subject& subject = *tile.subject;
  const FrameMesh& mesh = subject.mesh;
  const Quantity* quantity = coloured_quantity(brush.show);
  const bool by_material = quantity && brush.show.material == quantity->name, by_springs = quantity && !by_material;
  std::vector<float> value(mesh.rest.size(), 0.0f), spring(mesh.springs.size(), 0.0f);
  const float at_rest = static_cast<float>(brush.scale(0));  // springs between held nodes, which the mesh leaves out
  if (by_material) {
    const std::vector<double> values = subject.fields.of_material(quantity->name, *tile.frame);
    for (std::size_t i = 0; i < values.size(); ++i) value[i] = static_cast<float>(brush.scale(values[i]));
  }
  if (by_springs) {
    const std::vector<double> values = subject.fields.of_springs(quantity->name, *tile.frame);
    for (std::size_t s = 0; s < values.size(); ++s)
      spring[s] = std::isnan(values[s]) ? -1.0f : static_cast<float>(brush.scale(values[s]));
  } else {
    for (std::size_t s = 0; s < tile.frame->elongation.size(); ++s)
      if (std::isnan(tile.frame->elongation[s])) spring[s] = -1;
  }
  panel.mesh.reserve(3 * mesh.triangles.size());
  const auto& sides = subject.fields.sides();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const std::array<Vec2, 3> p{pixels[corners[0]], pixels[corners[1]], pixels[corners[2]]};
    const double area = std::abs(cross(p[1] - p[0], p[2] - p[0]));
    MeshVertex vertex{};
    std::array<float, 3> height{};
    bool whole = true;  // what has a broken side is a hole
    for (std::size_t c = 0; c < 3; ++c) {
      const int s = sides[t][c];
      vertex.spring[c] = s < 0 ? at_rest : spring[s];
      whole = whole && vertex.spring[c] >= 0;
      height[c] = static_cast<float>(area / std::max(1e-9, (p[(c + 2) % 3] - p[(c + 1) % 3]).norm()));
    }
    if (!whole) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      vertex.x = static_cast<float>(p[c].x());
      vertex.y = static_cast<float>(p[c].y());
      vertex.value = value[corners[c]];
      for (std::size_t side = 0; side < 3; ++side) vertex.distance[side] = side == c ? height[c] : 0;
      panel.mesh.push_back(vertex);
    }
  }
}

// What is left around broken springs: those that hold at the sides of holes, and nodes that hang by none.
void draw_wreck(Canvas& canvas, const Brush& brush, const Tile& tile, const Points& pixels) {
  const std::vector<float>& elongation = tile.frame->elongation;
  const FrameMesh& mesh = tile.subject->mesh;
  std::vector<bool> held(mesh.rest.size(), false), near_hole(mesh.springs.size(), false);
  const auto broken = [&](int s) { return s >= 0 && std::isnan(elongation[static_cast<std::size_t>(s)]); };
  for (const auto& sides : tile.subject->fields.sides())
    if (broken(sides[0]) || broken(sides[1]) || broken(sides[2]))
      for (const int s : sides)
        if (s >= 0) near_hole[static_cast<std::size_t>(s)] = true;
  for (std::size_t s = 0; s < mesh.springs.size(); ++s) {
    if (std::isnan(elongation[s])) continue;
    for (const int node : mesh.springs[s]) held[static_cast<std::size_t>(node)] = true;
    if (near_hole[s])
      canvas.line(pixels[mesh.springs[s][0]], pixels[mesh.springs[s][1]], brush.unit, {120, 120, 130, 255});
  }
  for (int i = 0; i < mesh.nodes(); ++i)
    if (!held[static_cast<std::size_t>(i)] && !mesh.anchored[static_cast<std::size_t>(i)])
      canvas.disc(pixels[i], 1.5 * brush.unit, {120, 120, 130, 255});
}

// Springs alone, as strokes: where no material is filled.
void draw_bare_springs(Canvas& canvas, const Brush& brush, const Tile& tile, const Points& pixels,
                       const std::vector<Colour>& colours) {
  const FrameMesh& mesh = tile.subject->mesh;
  const Quantity* quantity = coloured_quantity(brush.show);
  const std::vector<double> values = tile.subject->fields.of_springs(quantity ? quantity->name : "energy", *tile.frame);
  std::vector<std::size_t> order;
  for (std::size_t s = 0; s < values.size(); ++s)
    if (!std::isnan(values[s])) order.push_back(s);
  // The strongest last, so that they lie on top.
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return std::abs(values[a]) < std::abs(values[b]); });
  for (const std::size_t s : order) {
    const double part = quantity ? brush.scale(values[s]) : 0;
    const Colour colour = quantity ? colours[static_cast<std::size_t>(part * static_cast<double>(colours.size() - 1))]
                                   : Colour{90, 90, 105, 255};
    canvas.line(pixels[mesh.springs[s][0]], pixels[mesh.springs[s][1]], (quantity ? 1.6 : 1.0) * brush.unit, colour);
  }
}

// Strokes away from a held rim, as in a drawing of a clamped beam.
void draw_anchors(Canvas& canvas, const Brush& brush, const FrameMesh& mesh, const Points& pixels, const Box& cut) {
  const double spacing = 0.7 * brush.text, length = 0.55 * brush.text;
  for (const std::vector<int>& rim : mesh.rims) {
    double due = spacing / 2;
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const int a = rim[k], b = rim[(k + 1) % rim.size()];
      if (!mesh.anchored[a] || !mesh.anchored[b]) continue;
      const double extent = (pixels[b] - pixels[a]).norm();
      if (!(extent > 0)) continue;
      const Vec2 along = (pixels[b] - pixels[a]) / extent,
                 out(-along.y(), along.x());  // pixels run down: the outside of a counter-clockwise chain
      const auto strokes = static_cast<long>(
          std::ceil((extent - due) / spacing));  // on this side, of which only those near the panel are drawn
      double first = 0, last = static_cast<double>(strokes);
      for (int axis : {0, 1}) {
        const double low = (axis == 0 ? cut.x : cut.y) - length,
                     high = (axis == 0 ? cut.x + cut.width : cut.y + cut.height) + length,
                     from = pixels[a][axis] + due * along[axis], by = spacing * along[axis];
        if (std::abs(by) < 1e-12) {
          if (from < low || from > high) last = 0;
          continue;
        }
        first = std::max(first, std::min((low - from) / by, (high - from) / by));
        last = std::min(last, std::max((low - from) / by, (high - from) / by) + 1);
      }
      for (double stroke = std::ceil(first); stroke < last; ++stroke) {
        const Vec2 foot = pixels[a] + (due + stroke * spacing) * along;
        canvas.line(foot, foot + length * (out - 0.7 * along).normalized(), brush.unit, hatch_colour);
      }
      due += static_cast<double>(std::max(0L, strokes)) * spacing - extent;
    }
  }
}

Points chain(const std::vector<int>& rim, const Points& pixels) {
  Points points;
  for (const int node : rim) points.push_back(pixels[node]);
  return points;
}

void draw_projectile_marks(Canvas& canvas, const Brush& brush, const Tile& tile, const View& view) {
  const Show& show = brush.show;
  const FrameMesh& mesh = tile.subject->mesh;
  const Survey& survey = tile.subject->survey;
  const Motion motion = motion_of(mesh, *tile.frame, 0);
  if (show.trail) {
    Points path;
    for (std::size_t k = 0; k <= tile.index && k < survey.trail.size(); ++k) path.push_back(view(survey.trail[k]));
    canvas.polyline(path, 3.4 * brush.unit, white);
    canvas.polyline(path, 1.6 * brush.unit, kind_colour(3));
    canvas.disc(view(motion.centre), 2.4 * brush.unit, kind_colour(3));
  }
  if (show.spin) {
    double radius = 0;
    for (const int node : mesh.rims[0]) radius = std::max(radius, (mesh.rest[node] - motion.rest_centre).norm());
    const Vec2 end = motion.centre + 0.8 * radius * (Eigen::Rotation2Dd(motion.angle) * Vec2(0, 1));
    canvas.line(view(motion.centre), view(end), 2.5 * brush.unit, black);
    canvas.disc(view(motion.centre), 3 * brush.unit, black);
  }
  if (show.velocity && survey.most_speed > 0) {
    const Vec2 from = view(motion.centre), step = 4.5 * brush.text / survey.most_speed * motion.velocity;
    canvas.arrow(from, from + Vec2(step.x(), -step.y()), 3 * brush.unit, kind_colour(0));
  }
}

void draw_forces(Canvas& canvas, const Brush& brush, const Tile& tile, const Points& pixels) {
  const double most = tile.subject->survey.most_force;
  if (!(most > 0)) return;
  for (int i = 0; i < tile.subject->mesh.projectile_nodes; ++i) {
    const Vec2 force = tile.frame->contact_force[static_cast<std::size_t>(i)].cast<double>();
    if (force.norm() < 0.02 * most) continue;
    const Vec2 step = 4.0 * brush.text / most * force;
    canvas.arrow(pixels[i], pixels[i] + Vec2(step.x(), -step.y()), 1.6 * brush.unit, kind_colour(5));
  }
}

Panel draw_tile(const Brush& brush, Font& font, const Tile& tile, const View& view, const Box& cut,
                const std::vector<Colour>& colours) {
  const Show& show = brush.show;
  const FrameMesh& mesh = tile.subject->mesh;
  Points pixels;
  for (const Vec2& p : shown_places(show, mesh, *tile.frame)) pixels.push_back(view(p));
  Panel panel;
  panel.x = static_cast<int>(cut.x);
  panel.y = static_cast<int>(cut.y);
  panel.width = static_cast<int>(cut.width);
  panel.height = static_cast<int>(cut.height);
  Canvas above(font);
  if (show.material != "none") {
    draw_material(panel, brush, tile, pixels);
    if (!tile.frame->elongation.empty()) draw_wreck(above, brush, tile, pixels);
  } else if (show.springs != "none") {
    draw_bare_springs(above, brush, tile, pixels, colours);
  }
  // Where springs would cover everything they are paler.
  const double spacing = view.scale * tile.subject->fields.mean_spring_length();
  panel.half_width = show.springs == "none" ? 0 : (show.springs == "plain" ? 0.45 : 0.8) * brush.unit;
  panel.ink[3] = static_cast<std::uint8_t>(90 * std::min(1.0, std::pow(spacing / (7 * brush.unit), 2)));
  if (show.anchors) draw_anchors(above, brush, mesh, pixels, cut);
  if (show.rims)
    for (const auto& rim : mesh.rims) above.polyline(chain(rim, pixels), 1.8 * brush.unit, rim_colour, true);
  if (show.ghost)
    for (int body : {0, 1}) {
      const Motion motion = motion_of(mesh, *tile.frame, body);
      Points rigid;
      for (const int node : mesh.rims[static_cast<std::size_t>(body)])
        rigid.push_back(view(motion.moved(mesh.rest[node])));
      above.polyline(rigid, brush.unit, ghost_colour, true);
    }
  if (show.forces) draw_forces(above, brush, tile, pixels);
  if (show.velocity || show.spin || show.trail) draw_projectile_marks(above, brush, tile, view);
  panel.above = above.take();
  return panel;
}

const ColourMap& map_of(const Show& show, const Quantity& quantity) {
  return colour_map_named(show.colours != "auto" ? show.colours.c_str() : quantity.is_signed ? "puor" : "ylgnbu");
}

}  // namespace

std::string clock_text(const std::vector<Tile>& tiles) {
  // As many decimals as tell one frame from the next.
  const std::vector<double>& times = tiles[0].subject->survey.times;
  double least = 0.1;
  for (std::size_t k = 1; k < times.size(); ++k) least = std::min(least, times[k] - times[k - 1]);
  std::string text = fmt::format(
      "t = {} R/c", number_text(tiles[0].frame->time, std::pow(10.0, std::floor(std::log10(std::max(least, 1e-9))))));
  const double psi1 = tiles[0].subject->mesh.psi1;
  for (const Tile& tile : tiles)
    if (tile.subject->mesh.psi1 != psi1) return text;
  return std::isnan(psi1) ? text : text + fmt::format("    Ψ_1 = {}", number_text(psi1));
}

Painting paint(const Show& show, const Layout& layout, Font& font, const std::vector<Tile>& tiles,
               const std::string& clock) {
  Painting painting;
  const int columns = layout.columns, rows = (static_cast<int>(tiles.size()) + columns - 1) / columns;
  const double shortest = std::min<double>(layout.height, layout.width / 1.5);
  const int text = std::max(layout.height < 300 ? 9 : 11,
                            static_cast<int>(std::lround(shortest / 36.0 * (rows > 1 || columns > 2 ? 0.85 : 1.0))));
  std::vector<const Survey*> surveys;
  for (const Tile& tile : tiles) surveys.push_back(&tile.subject->survey);
  const Brush brush{show, common_scale(show, surveys), text, std::max(1.0, shortest / 720.0)};

  const Quantity* quantity = coloured_quantity(show);
  painting.material_coloured = quantity && show.material == quantity->name;
  painting.springs_coloured = quantity && !painting.material_coloured;
  if (quantity)
    for (int i = 0; i < 256; ++i) painting.colours.push_back(colour_of(map_of(show, *quantity), i / 255.0));

  Canvas over(font);
  const double line = std::round(1.5 * text), pad = std::round(0.6 * text);
  double top = pad;
  if (!show.title.empty()) {
    over.text_within(layout.width - 2 * pad, {layout.width / 2.0, top + 1.05 * text}, show.title,
                     static_cast<int>(std::lround(1.15 * text)), black, Align::centre);
    top += 1.2 * line;
  }
  const bool bar = quantity && show.colour_bar;
  const int power = bar ? power_of(std::max(std::abs(brush.scale.low), std::abs(brush.scale.high))) : 0;
  double right = pad;
  std::vector<BarMark> marks;
  if (bar) {
    marks = bar_marks(brush.scale, power, layout.height > 15 * text);
    for (const BarMark& mark : marks)
      right = std::max(right, std::round(over.text_width(mark.text, text) + 2.6 * text));
  }
  if (!clock.empty() || bar) {
    // The clock takes what it needs, up to half of the line if the bar's label stands there too.
    const double half = bar ? (layout.width - 3 * pad) / 2.0 : layout.width - 2 * pad,
                 taken = clock.empty() ? 0 : std::min(half, over.text_width(clock, text));
    if (!clock.empty()) over.text_within(half, {pad, top + text}, clock, text, black);
    if (bar)
      over.text_within(layout.width - 3 * pad - taken, {layout.width - pad, top + text}, label_of(*quantity, power),
                       text, black, Align::right);
    top += line;
  }
  if (bar)
    draw_colour_bar(over,
                    {layout.width - right + std::round(0.6 * text), top + pad, std::round(0.9 * text),
                     layout.height - top - 3.0 * pad},
                    text, brush.scale, painting.colours, marks);

  const bool captions = std::any_of(tiles.begin(), tiles.end(), [](const Tile& tile) { return !tile.caption.empty(); });
  const double caption = captions ? line : 0, ledger = show.ledger ? 2.9 * text : 0;
  const Box all{0, top, layout.width - right, layout.height - top};
  const double plot = plotted_quantity(show) ? std::max(7.5 * text, 0.26 * all.height / rows) : 0;
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    const Tile& tile = tiles[k];
    const Box cell{std::round(all.x + all.width * static_cast<double>(static_cast<int>(k) % columns) / columns),
                   std::round(all.y + all.height * static_cast<double>(static_cast<int>(k) / columns) / rows),
                   std::floor(all.width / columns), std::floor(all.height / rows)};
    if ((tiles.size() > 1 || ledger + plot > 0) &&
        (cell.height - caption - ledger - plot < 2.5 * text || cell.width < 8 * text))
      throw FieldError("size", fmt::format("there is no room for {} {} and {} of {} pixels each beside their texts, "
                                           "ledger and plot; make the picture larger or show less",
                                           columns, columns == 1 ? "column" : "columns",
                                           rows == 1 ? "a row" : fmt::format("{} rows", rows),
                                           fmt::format("{:.0f} x {:.0f}", cell.width, cell.height)));
    const Box scene{cell.x, cell.y + caption, cell.width, std::max(1.0, cell.height - caption - ledger - plot)};
    const View view = view_of(show, tile, tiles, scene, show.anchors ? text : pad);
    // Bodies under a camera that sees a part are cut at the border of their cell; others fit anyway.
    painting.panels.push_back(draw_tile(brush, font, tile, view, scene, painting.colours));
    if (captions)
      over.text_within(cell.width - pad, {cell.x + cell.width / 2, cell.y + text}, tile.caption, text, black,
                       Align::centre);
    if (show.ledger)
      draw_ledger(over, {cell.x + 2 * pad, cell.y + cell.height - plot - ledger, cell.width - 4 * pad, ledger}, text,
                  tile);
    if (plotted_quantity(show))
      draw_plot(over, {cell.x + 2 * pad, cell.y + cell.height - plot, cell.width - 4 * pad, plot - 0.3 * text}, text,
                tile, *plotted_quantity(show));
  }
  painting.over = over.take();
  return painting;
}

}  // namespace ricochet::render
