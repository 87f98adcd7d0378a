#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/canvas.hpp"

namespace ricochet::render {

/// A picture: rows from the top, four bytes a pixel, of which the last means nothing.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// A corner of a triangle of material, in pixels. The springs along the triangle's sides are drawn by the same stroke
/// of the brush.
struct MeshVertex {
  float x, y;
  float value;        ///< of the material, 0 ... 1 in its colours
  float distance[3];  ///< from the side opposite to each corner [pixels]
  float spring[3];    ///< value of the spring of that side, 0 ... 1; read only if springs are coloured
};

/// A part of the picture, cut at its borders, painted in this order.
struct Panel {
  int x = 0, y = 0, width = 0, height = 0;
  std::vector<MeshVertex> mesh;
  std::vector<ShapeVertex> above;
  Colour ink{30, 30, 45, 90};  ///< of springs that are not coloured by value
  double half_width = 0;       ///< of springs [pixels]; 0: none are drawn
};

/// All that a picture is made of.
struct Painting {
  std::vector<Panel> panels;
  std::vector<ShapeVertex> over;   ///< over all panels
  std::vector<Colour> colours;     ///< 256, of values from 0 to 1
  bool material_coloured = false;  ///< by value; else `body`
  bool springs_coloured = false;   ///< by value; else `ink`
  Colour body{237, 237, 240, 255};
};

/// How pictures are smoothed: `lines` where strokes are drawn (free, for they are smooth by themselves), `multisample`
/// by four samples at every edge, `supersample` by four times the pixels.
enum class Smoothing { lines, multisample, supersample };

/// A software OpenGL 3.3 core context in memory (OSMesa): no window system, no GPU, no environment variables. The
/// library is loaded with the first context, so that a program that draws nothing never touches it. A context belongs
/// to the thread that made it. Throws FieldError "size" if the size is out of range, FileError if OSMesa is missing.
class Context {
 public:
  Context(int width, int height, Smoothing smoothing = Smoothing::lines);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Pixels of a painting along each side of a pixel of the picture: 2 for `supersample`.
  int scale() const;

  /// Paints over white. The font is the one whose glyphs the shapes name.
  Image draw(const Painting& painting, const Font& font);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The least and the greatest width and height of a picture.
inline constexpr int least_size = 16, most_width = 7680, most_height = 4320;
/// Throws FieldError "size" outside of them.
void check_size(int width, int height);

}  // namespace ricochet::render
