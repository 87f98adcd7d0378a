#pragma once
// Flat shapes in pixels (x right, y down, from the picture's upper left corner), smooth at their edges: lines, arrows,
// rectangles, text.

#include <cstdint>
#include <string>
#include <vector>

#include "core/vec2.hpp"
#include "render/colour_map.hpp"
#include "render/font.hpp"

namespace ricochet::render {

/// A corner of a triangle. A point at (u, v) of the shape's own axes, v along a stroke from 0 to `length`, is covered
/// as far as it lies within `half` of the stroke. half = -1: a glyph, (u, v) its place in the atlas. half = 0: all
/// covered.
struct ShapeVertex {
  float x, y;
  Colour colour;
  float u, v, half, length;
};

enum class Align { left, centre, right };

class Canvas {
 public:
  explicit Canvas(Font& font) : font_(font) {}

  void triangle(const Vec2& a, const Vec2& b, const Vec2& c, const Colour& colour);
  void rectangle(const Vec2& corner, const Vec2& extent, const Colour& colour);
  /// A stroke with round ends.
  void line(const Vec2& a, const Vec2& b, double width, const Colour& colour);
  void polyline(const Points& points, double width, const Colour& colour, bool closed = false);
  void disc(const Vec2& centre, double radius, const Colour& colour) { line(centre, centre, 2 * radius, colour); }
  /// With a rim of white, so that it shows on any colour.
  void arrow(const Vec2& from, const Vec2& to, double width, const Colour& colour);
  /// Text on a baseline. After a symbol of one letter or a number, _ and ^ lower and raise the next character, or a
  /// group {...}: x_1, 10^{-3}, but soft_wall.
  void text(const Vec2& at, const std::string& utf8, int size, const Colour& colour, Align align = Align::left);
  double text_width(const std::string& utf8, int size);
  /// The same where there is only so much room: smaller, and, where that would be less than 7 pixels high, cut.
  void text_within(double room, const Vec2& at, const std::string& utf8, int size, const Colour& colour,
                   Align align = Align::left);

  /// The same, cut and never smaller.
  void text_cut(double room, const Vec2& at, const std::string& utf8, int size, const Colour& colour,
                Align align = Align::left);

  const std::vector<ShapeVertex>& vertices() const { return vertices_; }
  std::vector<ShapeVertex> take() { return std::move(vertices_); }

 private:
  template <class Use>
  double each_glyph(const std::string& utf8, int size, Use&& use);
  void quad(const std::array<ShapeVertex, 4>& corners);

  Font& font_;
  std::vector<ShapeVertex> vertices_;
};

}  // namespace ricochet::render
