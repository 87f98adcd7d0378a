#pragma once
#include <cstdint>
#include <memory>
#include <vector>

namespace ricochet::render {

/// A picture: rows from the top, three bytes a pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// A vertex: a place in the unit of the view, a colour.
struct Vertex {
  float x, y, r, g, b;
};

/// A software OpenGL 3.3 core context in memory (OSMesa): no window system, no GPU, no environment variables.
/// Throws Error if the size is out of range or OSMesa cannot make one.
class Context {
 public:
  Context(int width, int height);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Draws triangles (three vertices each, in clip space -1 ... 1) over a background; every pixel is the mean of 4 samples.
  Image draw(const std::vector<Vertex>& triangles, float red, float green, float blue);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ricochet::render
