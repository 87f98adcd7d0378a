#include "render/picture.hpp"

#include <algorithm>
#include <cmath>

#include "render/colour_map.hpp"

namespace ricochet::render {
namespace {

constexpr Colour background{1.0f, 1.0f, 1.0f}, body{0.93f, 0.93f, 0.94f}, rim{0.05f, 0.05f, 0.08f};

/// Turns points of the plane into clip space and strokes into triangles.
class Canvas {
 public:
  Canvas(int width, int height, const View& view) {
    const Vec2 extent = view.high - view.low;
    pixel_ = std::max(extent.x() / width, extent.y() / height);
    half_ = Vec2(width, height) * pixel_ / 2;
    centre_ = (view.low + view.high) / 2;
  }

  void triangle(const Vec2& a, const Vec2& b, const Vec2& c, const Colour& colour) {
    for (const Vec2& p : {a, b, c}) vertex(p, colour);
  }

  void line(const Vec2& a, const Vec2& b, double pixels, const Colour& colour) {
    const Vec2 along = b - a;
    if (along.squaredNorm() == 0) return;
    const Vec2 side = perpendicular(along.normalized()) * (pixels * pixel_ / 2);
    triangle(a - side, b - side, b + side, colour);
    triangle(a - side, b + side, a + side, colour);
  }

  const std::vector<Vertex>& vertices() const { return vertices_; }

 private:
  void vertex(const Vec2& p, const Colour& colour) {
    const Vec2 q = (p - centre_).cwiseQuotient(half_);
    vertices_.push_back({static_cast<float>(q.x()), static_cast<float>(q.y()), colour[0], colour[1], colour[2]});
  }

  double pixel_;
  Vec2 half_, centre_;
  std::vector<Vertex> vertices_;
};

}  // namespace

Image draw(Context& context, int width, int height, const Mesh& mesh, const Frame& frame, const View& view) {
  Canvas canvas(width, height, view);
  const double unit = std::max(1.0, height / 720.0);
  for (const auto& t : mesh.triangles) canvas.triangle(frame.points[t[0]], frame.points[t[1]], frame.points[t[2]], body);
  // Bright springs last, so that the stressed ones lie on top.
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < mesh.edges.size(); ++i)
    if (!std::isnan(frame.edge_values[i])) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return frame.edge_values[a] < frame.edge_values[b]; });
  for (const std::size_t i : order) {
    const double value = frame.edge_values[i];
    canvas.line(frame.points[mesh.edges[i][0]], frame.points[mesh.edges[i][1]], unit * (1.0 + 1.5 * std::min(1.0, value)), cividis(value));
  }
  for (const auto& chain : mesh.rims)
    for (std::size_t i = 0; i < chain.size(); ++i) canvas.line(frame.points[chain[i]], frame.points[chain[(i + 1) % chain.size()]], 2 * unit, rim);
  return context.draw(canvas.vertices(), background[0], background[1], background[2]);
}

}  // namespace ricochet::render
