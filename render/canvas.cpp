#include "render/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ricochet::render {
namespace {

ShapeVertex vertex(const Vec2& p, const Colour& colour, double u = 0, double v = 0, double half = 0,
                   double length = 0) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), colour, static_cast<float>(u), static_cast<float>(v),
          static_cast<float>(half),  static_cast<float>(length)};
}

}  // namespace

void Canvas::quad(const std::array<ShapeVertex, 4>& c) {
  vertices_.insert(vertices_.end(), {c[0], c[1], c[2], c[0], c[2], c[3]});
}

void Canvas::triangle(const Vec2& a, const Vec2& b, const Vec2& c, const Colour& colour) {
  for (const Vec2& p : {a, b, c}) vertices_.push_back(vertex(p, colour));
}

void Canvas::rectangle(const Vec2& corner, const Vec2& extent, const Colour& colour) {
  quad({vertex(corner, colour), vertex(corner + Vec2(extent.x(), 0), colour), vertex(corner + extent, colour),
        vertex(corner + Vec2(0, extent.y()), colour)});
}

void Canvas::line(const Vec2& a, const Vec2& b, double width, const Colour& colour) {
  const double length = (b - a).norm(), half = width / 2, out = half + 1;
  const Vec2 along = length > 0 ? Vec2((b - a) / length) : Vec2(1, 0), side = perpendicular(along);
  const Vec2 from = a - out * along, to = b + out * along;
  quad({vertex(from - out * side, colour, -out, -out, half, length),
        vertex(from + out * side, colour, out, -out, half, length),
        vertex(to + out * side, colour, out, length + out, half, length),
        vertex(to - out * side, colour, -out, length + out, half, length)});
}

void Canvas::polyline(const Points& points, double width, const Colour& colour, bool closed) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) line(points[i], points[i + 1], width, colour);
  if (closed && points.size() > 2) line(points.back(), points.front(), width, colour);
}

void Canvas::arrow(const Vec2& from, const Vec2& to, double width, const Colour& colour) {
  const double length = (to - from).norm(), head = std::min(length, 5 * width), rim = std::max(1.0, 0.4 * width);
  if (!(length > 0.5)) return;
  const Vec2 along = (to - from) / length, side = perpendicular(along), neck = to - head * along;
  const Points tip{to, neck + 0.45 * head * side, neck - 0.45 * head * side};
  line(from, neck, width + 2 * rim, white);
  polyline(tip, 2 * rim, white, true);
  line(from, neck, width, colour);
  triangle(tip[0], tip[1], tip[2], colour);
  polyline(tip, 0.6, colour, true);  // smooth edges
}

// Calls use(glyph, x, rise) for every glyph, x from the start of the text; returns the text's width.
template <class Use>
double Canvas::each_glyph(const std::string& utf8, int size, Use&& use) {
  const std::u32string all = characters(utf8);
  const auto is_letter = [](char32_t c) { return (c >= U'a' && c <= U'z') || (c >= U'A' && c <= U'Z') || c >= 0x370; };
  const auto after_symbol = [&](std::size_t i) {
    return i > 0 && i + 1 < all.size() && all[i - 1] != U' ' && all[i - 1] != U'_' &&
           !(is_letter(all[i - 1]) && i > 1 && (is_letter(all[i - 2]) || all[i - 2] == U'_'));
  };
  const int small = std::max(6, static_cast<int>(std::lround(0.72 * size)));
  double x = 0;
  int level = 0;  // -1: lowered, 1: raised
  bool group = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (level == 0 && (all[i] == U'_' || all[i] == U'^') && after_symbol(i)) {
      level = all[i] == U'_' ? -1 : 1;
      if (all[i + 1] == U'{') {
        group = true;
        ++i;
      }
      continue;
    }
    if (group && all[i] == U'}') {
      group = false;
      level = 0;
      continue;
    }
    const Font::Glyph& glyph = font_.glyph(all[i], level ? small : size);
    use(glyph, x, level * (level > 0 ? 0.38 : 0.2) * size);
    x += glyph.advance;
    if (!group) level = 0;
  }
  return x;
}

double Canvas::text_width(const std::string& utf8, int size) {
  return each_glyph(utf8, size, [](const Font::Glyph&, double, double) {});
}

void Canvas::text_within(double room, const Vec2& at, const std::string& utf8, int size, const Colour& colour,
                         Align align) {
  while (size > 7 && text_width(utf8, size) > room) --size;
  text_cut(room, at, utf8, size, colour, align);
}

void Canvas::text_cut(double room, const Vec2& at, const std::string& utf8, int size, const Colour& colour,
                      Align align) {
  std::string shown = utf8;
  while (!shown.empty() && text_width(shown + (shown.size() < utf8.size() ? "…" : ""), size) > room) {
    bool inside = true;  // of a character of several bytes
    while (inside) {
      inside = (static_cast<unsigned char>(shown.back()) & 0xc0) == 0x80;
      shown.pop_back();
    }
  }
  text(at, shown.size() < utf8.size() ? shown + "…" : shown, size, colour, align);
}

void Canvas::text(const Vec2& at, const std::string& utf8, int size, const Colour& colour, Align align) {
  const double width = align == Align::left ? 0 : text_width(utf8, size);
  const double start = at.x() - (align == Align::left ? 0 : align == Align::centre ? width / 2 : width);
  each_glyph(utf8, size, [&](const Font::Glyph& g, double x, double rise) {
    if (g.width == 0) return;
    // Whole pixels: glyphs stay as sharp as they were drawn.
    const Vec2 corner(std::round(start + x) + g.left, std::round(at.y() - rise) - g.top), extent(g.width, g.height);
    const double u0 = g.x, v0 = g.y, u1 = g.x + g.width, v1 = g.y + g.height;
    quad({vertex(corner, colour, u0, v0, -1), vertex(corner + Vec2(extent.x(), 0), colour, u1, v0, -1),
          vertex(corner + extent, colour, u1, v1, -1), vertex(corner + Vec2(0, extent.y()), colour, u0, v1, -1)});
  });
}

}  // namespace ricochet::render
