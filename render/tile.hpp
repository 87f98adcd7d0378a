#pragma once
// A tile: the bodies at a moment and all that is drawn over them, as a camera sees them.

#include "render/picture.hpp"

namespace ricochet::render {

/// How the plane lies in a box of the painting.
struct View {
  Vec2 centre = Vec2::Zero();  ///< [R]
  double scale = 1;            ///< [pixels/R]
  Box box{};

  Vec2 operator()(const Vec2& p) const {
    const Vec2 d = scale * (p - centre);
    return {box.x + box.width / 2 + d.x(), box.y + box.height / 2 - d.y()};
  }
};

/// Everything to be drawn at one place, and what it is drawn with.
struct Brush {
  const Show& show;
  Scale scale;
  int text;               ///< size [pixels]
  double unit;            ///< width of a thin stroke [pixels]
  bool compares = false;  ///< tell how far a scene goes on the scale that it shares with others
};

/// What the show's camera sees of a tile in this box, with a margin. [pixels]
View view_of(const Show& show, const Tile& tile, const std::vector<Tile>& tiles, const Box& box, double margin);
/// Arcs and marks of the waves of the first touch, in the target (fronts.cpp). `pixels`: where its nodes are drawn.
void draw_fronts(Canvas& canvas, const Brush& brush, const Tile& tile, const Points& pixels, const View& view,
                 const Box& cut);
Panel draw_tile(const Brush& brush, Font& font, const Tile& tile, const View& view, const Box& cut,
                const std::vector<Colour>& colours);

}  // namespace ricochet::render
