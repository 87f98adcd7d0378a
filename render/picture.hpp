#pragma once
// Draws plain frames: points, triangles, edges and their values. Knows nothing of the engine.

#include <array>

#include "core/vec2.hpp"
#include "render/context.hpp"

namespace ricochet::render {

struct Frame {
  Points points;
  std::vector<double> edge_values;  ///< [edge] 0 ... 1, coloured from dark to bright; NaN: not drawn
};

/// What stays the same over a sequence.
struct Mesh {
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::vector<int>> rims;  ///< closed chains of points
};

/// The part of the plane that is shown, widened to the picture's shape.
struct View {
  Vec2 low, high;
};

Image draw(Context& context, int width, int height, const Mesh& mesh, const Frame& frame, const View& view);

}  // namespace ricochet::render
