#include "render/tile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace ricochet::render {
namespace {

constexpr Colour rim_colour{25, 25, 38, 255}, ghost_colour{110, 110, 120, 200}, hatch_colour{90, 90, 100, 255},
    trail_colour{93, 58, 155, 255}, force_colour{136, 34, 85, 255};  // none of the ledger's

constexpr double force_length = 4.0, velocity_length = 4.5;  // of the longest arrows [text sizes]

// The box that shows all of every tile: what is larger shall look larger, and what lies higher, higher.
std::pair<Vec2, Vec2> common_box(const std::vector<Tile>& tiles) {
  Vec2 low = tiles[0].subject->survey.low, high = tiles[0].subject->survey.high;
  for (const Tile& tile : tiles) {
    low = low.cwiseMin(tile.subject->survey.low);
    high = high.cwiseMax(tile.subject->survey.high);
  }
  return {low, high};
}

// How far the projectile's rim is from its centre, at most. [R]
double radius_of(const FrameMesh& mesh) {
  Vec2 low = Vec2::Constant(1e300), high = Vec2::Constant(-1e300);
  for (const MeshChain& chain : mesh.bodies.front().surface)
    for (const int node : chain.node) {
      low = low.cwiseMin(seen(mesh, mesh.rest, node));
      high = high.cwiseMax(seen(mesh, mesh.rest, node));
    }
  return (high - low).maxCoeff() / 2;
}

}  // namespace

View view_of(const Show& show, const Tile& tile, const std::vector<Tile>& tiles, const Box& box, double margin) {
  if (show.camera == "fit") {
    const auto [low, high] = common_box(tiles);
    const Vec2 extent = (high - low).cwiseMax(1e-9);
    return {(low + high) / 2,
            std::min(std::max(1.0, box.width - 2 * margin) / extent.x(),
                     std::max(1.0, box.height - 2 * margin) / extent.y()),
            box};
  }
  const Units& units = tile.subject->mesh.units;
  double width = !std::isnan(show.width) ? show.width / units.worth("R") : show.camera == "follow" ? 5.0 : 2.5;
  if (std::isnan(show.width) && show.camera == "follow")  // all of the body, also in a flat picture
    width = std::max(width, 2.3 * radius_of(tile.subject->mesh) * std::max(1.0, box.width / box.height));
  return {show.camera == "contact" ? contact_place(tile.subject->mesh, *tile.frame)
                                   : motion_of(tile.subject->mesh, *tile.frame, 0).centre,
          box.width / width, box};
}

namespace {

void draw_material(Panel& panel, const Brush& brush, const Tile& tile, const Points& pixels) {
  const Subject& subject = *tile.subject;
  const FrameMesh& mesh = subject.mesh;
  const Quantity* quantity = coloured_quantity(brush.show);
  const bool by_material = quantity && brush.show.material == quantity->name, by_springs = quantity && !by_material;
  std::vector<float> value(mesh.mass.size(), 0.0f), spring(mesh.springs.size(), 0.0f);
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
  std::vector<bool> held(mesh.mass.size(), false), near_hole(mesh.springs.size(), false);
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

// Of all bodies.
std::vector<const MeshChain*> chains_of(const FrameMesh& mesh) {
  std::vector<const MeshChain*> chains;
  for (const BodyMesh& body : mesh.bodies)
    for (const MeshChain& chain : body.surface) chains.push_back(&chain);
  return chains;
}

// Strokes away from a held rim, as in a drawing of a clamped beam.
void draw_anchors(Canvas& canvas, const Brush& brush, const FrameMesh& mesh, const Points& pixels, const Box& cut) {
  const double spacing = 0.7 * brush.text, length = 0.55 * brush.text;
  for (const MeshChain* chain : chains_of(mesh)) {
    double due = spacing / 2;
    const std::vector<int>& rim = chain->node;
    for (std::size_t k = 0; k < (chain->closed ? rim.size() : rim.size() - 1); ++k) {
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
      const auto end = static_cast<long>(std::ceil(last));
      for (auto stroke = static_cast<long>(std::ceil(first)); stroke < end; ++stroke) {
        const Vec2 foot = pixels[a] + (due + static_cast<double>(stroke) * spacing) * along;
        canvas.line(foot, foot + length * (out - 0.7 * along).normalized(), brush.unit, hatch_colour);
      }
      due += static_cast<double>(std::max(0L, strokes)) * spacing - extent;
    }
  }
}

Points pixels_of(const MeshChain& chain, const Points& pixels) {
  Points points;
  for (const int node : chain.node) points.push_back(pixels[node]);
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
    canvas.polyline(path, 1.6 * brush.unit, trail_colour);
    canvas.disc(view(motion.centre), 2.4 * brush.unit, trail_colour);
  }
  if (show.spin) {
    double radius = 0;
    for (const MeshChain& chain : mesh.bodies.front().surface)
      for (const int node : chain.node)
        radius = std::max(radius, (seen(mesh, mesh.rest, node) - motion.rest_centre).norm());
    const Vec2 end = motion.centre + 0.8 * radius * (Eigen::Rotation2Dd(motion.angle) * Vec2(0, 1));
    canvas.line(view(motion.centre), view(end), 2.5 * brush.unit, black);
    canvas.disc(view(motion.centre), 3 * brush.unit, black);
  }
  if (show.velocity && survey.most_speed > 0) {
    const Vec2 from = view(motion.centre), step = velocity_length * brush.text / survey.most_speed * motion.velocity;
    canvas.arrow(from, from + Vec2(step.x(), -step.y()), 3 * brush.unit, kind_colour(0));
  }
}

void draw_forces(Canvas& canvas, const Brush& brush, const Tile& tile, const Points& pixels) {
  const double most = tile.subject->survey.most_force;
  if (!(most > 0)) return;
  for (int i = 0; i < tile.subject->mesh.bodies.front().nodes; ++i) {
    const Vec2 force = seen(tile.subject->mesh, tile.frame->contact_force, i);
    if (force.norm() < 0.02 * most) continue;
    const Vec2 step = force_length * brush.text / most * force;
    canvas.arrow(pixels[i], pixels[i] + Vec2(step.x(), -step.y()), 1.6 * brush.unit, force_colour);
  }
}

// Where springs have broken a rim is no line any more: of its sides those stay that a whole triangle stands behind.
void draw_rims(Canvas& canvas, const Brush& brush, const Tile& tile, const Points& pixels) {
  const FrameMesh& mesh = tile.subject->mesh;
  const std::vector<float>& elongation = tile.frame->elongation;
  const double width = 1.8 * brush.unit;
  if (std::none_of(elongation.begin(), elongation.end(), [](float x) { return std::isnan(x); })) {
    for (const MeshChain* chain : chains_of(mesh))
      canvas.polyline(pixels_of(*chain, pixels), width, rim_colour, chain->closed);
    return;
  }
  std::set<std::pair<int, int>> whole;
  const auto& sides = tile.subject->fields.sides();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (std::any_of(sides[t].begin(), sides[t].end(),
                    [&](int s) { return s >= 0 && std::isnan(elongation[static_cast<std::size_t>(s)]); }))
      continue;
    for (std::size_t c = 0; c < 3; ++c)
      whole.insert(std::minmax(int{mesh.triangles[t][c]}, int{mesh.triangles[t][(c + 1) % 3]}));
  }
  for (const MeshChain* chain : chains_of(mesh))
    for (std::size_t k = 0; k + (chain->closed ? 0 : 1) < chain->node.size(); ++k) {
      const int a = chain->node[k], b = chain->node[(k + 1) % chain->node.size()];
      const bool held = mesh.anchored[a] && mesh.anchored[b];
      if (held || whole.contains(std::minmax(int{a}, int{b}))) canvas.line(pixels[a], pixels[b], width, rim_colour);
    }
}

// The round number below `most`: 1, 2 or 5 of its decade.
double round_below(double most) {
  const double decade = std::pow(10.0, std::floor(std::log10(most) + 1e-9));
  return most >= 5 * decade ? 5 * decade : most >= 2 * decade ? 2 * decade : decade;
}

std::string with_unit(double value, const char* unit, const FrameMesh& mesh) {
  const Units& units = mesh.units;
  const int power = power_of(value * units.worth(unit));
  const std::string number = number_text(value * units.worth(unit) / std::pow(10.0, power));
  return number + " " + unit_text(typeset(units.name(unit)), power);
}

// In the lower left corner: what the arrows are worth, and, under a camera that sees a part, a length.
void draw_scales(Canvas& canvas, const Brush& brush, const Tile& tile, const View& view) {
  const Show& show = brush.show;
  const Survey& survey = tile.subject->survey;
  const FrameMesh& mesh = tile.subject->mesh;
  const double size = brush.text;
  double y = view.box.y + view.box.height - 0.8 * size;
  const auto add = [&](double pixels, const std::string& text, const auto& draw) {
    const double x = view.box.x + 0.8 * size;
    canvas.rectangle({x - 0.3 * size, y - 0.75 * size},
                     {pixels + canvas.text_width(text, brush.text) + 1.3 * size, 1.5 * size}, {255, 255, 255, 215});
    draw(Vec2(x, y), Vec2(x + pixels, y));
    canvas.text({x + pixels + 0.5 * size, y + 0.36 * size}, text, brush.text, black);
    y -= 1.5 * size;
  };
  const auto arrow = [&](double width, const Colour& colour) {
    return [&canvas, width, colour](const Vec2& from, const Vec2& to) { canvas.arrow(from, to, width, colour); };
  };
  if (show.camera != "fit") {
    const double length =
        round_below(0.3 * view.box.width / view.scale * mesh.units.worth("R")) / mesh.units.worth("R");
    add(length * view.scale, with_unit(length, "R", mesh), [&](const Vec2& from, const Vec2& to) {
      canvas.line(from, to, 1.6 * brush.unit, black);
      for (const Vec2& end : {from, to})
        canvas.line(end - Vec2(0, 0.25 * size), end + Vec2(0, 0.25 * size), 1.6 * brush.unit, black);
    });
  }
  const auto worth = [&](double most, const char* unit) {
    return round_below(most * mesh.units.worth(unit)) / mesh.units.worth(unit);
  };
  if (show.forces && survey.most_force > 0) {
    const double force = worth(survey.most_force, "m0 c^2/R");
    add(force_length * size * force / survey.most_force, with_unit(force, "m0 c^2/R", mesh),
        arrow(1.6 * brush.unit, force_colour));
  }
  if (show.velocity && survey.most_speed > 0) {
    const double speed = worth(survey.most_speed, "c");
    add(velocity_length * size * speed / survey.most_speed, with_unit(speed, "c", mesh),
        arrow(3 * brush.unit, kind_colour(0)));
  }
}

// In the upper right corner: how far the target goes on a scale that scenes share, where it may be all pale.
void draw_greatest(Canvas& canvas, const Brush& brush, const Tile& tile, const View& view) {
  const Quantity* quantity = coloured_quantity(brush.show);
  const double most = tile.subject->survey.target_most, size = brush.text;
  if (!quantity || !brush.compares || !(most > 0)) return;
  const FrameMesh& mesh = tile.subject->mesh;
  const std::string unit = unit_of(*quantity, mesh);
  const double worth = mesh.units.worth(unit.c_str()), rounded = std::stod(fmt::format("{:.2g}", most * worth)) / worth;
  const std::string text = "target: up to " + with_unit(rounded, unit.c_str(), mesh);
  canvas.text_within(view.box.width, {view.box.x + view.box.width - 0.5 * size, view.box.y + size}, text, brush.text,
                     black, Align::right);
}

}  // namespace

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
  const double spacing = view.scale * tile.subject->fields.mean_side_length();
  panel.half_width = show.springs == "none" ? 0 : (show.springs == "plain" ? 0.45 : 0.8) * brush.unit;
  panel.ink[3] = static_cast<std::uint8_t>(90 * std::min(1.0, std::pow(spacing / (7 * brush.unit), 2)));
  if (show.anchors) draw_anchors(above, brush, mesh, pixels, cut);
  if (show.rims) draw_rims(above, brush, tile, pixels);
  if (show.ghost)
    for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
      const Motion motion = motion_of(mesh, *tile.frame, static_cast<int>(b));
      for (const MeshChain& chain : mesh.bodies[b].surface) {
        Points rigid;
        for (const int node : chain.node) rigid.push_back(view(motion.moved(seen(mesh, mesh.rest, node))));
        above.polyline(rigid, brush.unit, ghost_colour, chain.closed);
      }
    }
  if (show.fronts) draw_fronts(above, brush, tile, pixels, view, cut);
  if (show.forces) draw_forces(above, brush, tile, pixels);
  if (show.velocity || show.spin || show.trail) draw_projectile_marks(above, brush, tile, view);
  draw_scales(above, brush, tile, view);
  draw_greatest(above, brush, tile, view);
  panel.above = above.take();
  return panel;
}

}  // namespace ricochet::render
