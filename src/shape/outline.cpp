#include "shape/outline.hpp"

#include <algorithm>
#include <cmath>

namespace ricochet {
namespace {

// Twice the area of the triangle a, b, c. Its sign is all that is used; points within rounding of a line count as on
// it.
double orientation(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

bool on_segment(const Vec2& a, const Vec2& b, const Vec2& p) {
  return std::min(a.x(), b.x()) <= p.x() && p.x() <= std::max(a.x(), b.x()) && std::min(a.y(), b.y()) <= p.y() &&
         p.y() <= std::max(a.y(), b.y());
}

int sign(double x) { return (x > 0) - (x < 0); }

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const int abc = sign(orientation(a, b, c)), abd = sign(orientation(a, b, d));
  const int cda = sign(orientation(c, d, a)), cdb = sign(orientation(c, d, b));
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && on_segment(a, b, c)) || (abd == 0 && on_segment(a, b, d)) || (cda == 0 && on_segment(c, d, a)) ||
         (cdb == 0 && on_segment(c, d, b));
}

bool boxes_meet(const Vec2& low, const Vec2& high, const Vec2& other_low, const Vec2& other_high) {
  return (low.array() <= other_high.array()).all() && (high.array() >= other_low.array()).all();
}

}  // namespace

Box bounding_box(const Points& points) {
  Box box{points.front(), points.front()};
  for (const Vec2& p : points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

double signed_area(const Points& outline) {
  double twice = 0;
  for (std::size_t i = 0, n = outline.size(); i < n; ++i) twice += cross(outline[i], outline[(i + 1) % n]);
  return twice / 2;
}

double perimeter(const Points& outline) {
  double sum = 0;
  for (std::size_t i = 0, n = outline.size(); i < n; ++i) sum += (outline[(i + 1) % n] - outline[i]).norm();
  return sum;
}

bool is_simple(const Points& outline) { return outline.size() >= 3 && is_simple(CellTree(outline)); }

bool is_simple(const CellTree& tree) {
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const Vec2 &a = tree.from(i), &b = tree.to(i);
    if (a == b) return false;
    bool meets = false;
    tree.search([&](const Vec2& low,
                    const Vec2& high) { return !meets && boxes_meet(a.cwiseMin(b), a.cwiseMax(b), low, high); },
                [&](std::size_t j) {
                  if (j <= i) return;  // each pair once
                  const Vec2 &c = tree.from(j), &d = tree.to(j);
                  const bool next = &c == &b, previous = &d == &a;
                  if (next || previous) {  // neighbours: only a fold back onto each other is wrong
                    const Vec2 &corner = next ? b : a, &before = next ? a : b, &after = next ? d : c;
                    if (orientation(before, corner, after) == 0 && (before - corner).dot(after - corner) > 0)
                      meets = true;
                  } else if (segments_meet(a, b, c, d)) {
                    meets = true;
                  }
                });
    if (meets) return false;
  }
  return true;
}

bool inside(const CellTree& surface, const Vec2& p) {
  bool odd = false;
  surface.search(
      [&](const Vec2& low, const Vec2& high) { return low.y() <= p.y() && p.y() <= high.y() && p.x() <= high.x(); },
      [&](std::size_t s) {
        const Vec2 &a = surface.to(s), &b = surface.from(s);
        if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
          odd = !odd;
      });
  return odd;
}

bool outlines_overlap(const CellTree& a, const CellTree& b) {
  bool meets = false;
  for (std::size_t i = 0; i < a.size() && !meets; ++i) {
    const Vec2 &p = a.from(i), &q = a.to(i);
    b.search([&](const Vec2& low,
                 const Vec2& high) { return !meets && boxes_meet(p.cwiseMin(q), p.cwiseMax(q), low, high); },
             [&](std::size_t s) { meets = meets || segments_meet(p, q, b.from(s), b.to(s)); });
  }
  const auto some_inside = [](const CellTree& of, const CellTree& in) {
    for (std::size_t s = 0; s < of.size(); ++s)
      if (of.begins_chain(s) && inside(in, of.from(s))) return true;
    return false;
  };
  return meets || some_inside(b, a) || some_inside(a, b);
}

bool is_corner(const Points& outline, std::size_t i) {
  const double cos_turn = std::sqrt(3.0) / 2 - 1e-12;  // a dodecagon's corners, of 30 degrees, are alike
  const std::size_t n = outline.size();
  const Vec2 in = (outline[i] - outline[(i + n - 1) % n]).normalized(),
             out = (outline[(i + 1) % n] - outline[i]).normalized();
  return in.dot(out) < cos_turn;
}

std::vector<std::size_t> corners_of(const Points& outline) {
  const std::size_t n = outline.size();
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < n; ++i)
    if (is_corner(outline, i)) corners.push_back(i);
  return corners;
}

namespace {

// Points along an outline, `spacing` apart as nearly as an even division allows, by what length(a, b) says of its
// edges.
template <class Length>
Points divided(const Points& outline, double spacing, Length&& length) {
  const std::size_t n = outline.size();
  std::vector<std::size_t> corners = corners_of(outline);
  const bool smooth = corners.empty();
  if (smooth) corners.push_back(0);

  Points result;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const std::size_t first = corners[c], last = c + 1 < corners.size() ? corners[c + 1] : corners[0] + n;
    std::vector<double> arc{0};  // arc length from `first` to each point of this stretch
    for (std::size_t i = first; i < last; ++i)
      // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): an outline has points
      arc.push_back(arc.back() + length(outline[i % n], outline[(i + 1) % n]));
    const int least = smooth ? 3 : 1;
    const int pieces = std::max(least, static_cast<int>(std::lround(arc.back() / spacing)));
    std::size_t edge = 0;
    for (int k = 0; k < pieces; ++k) {
      const double s = arc.back() * k / pieces;
      while (edge + 2 < arc.size() && arc[edge + 1] <= s) ++edge;
      const Vec2 &a = outline[(first + edge) % n], &b = outline[(first + edge + 1) % n];
      result.push_back(a + (b - a) * ((s - arc[edge]) / (arc[edge + 1] - arc[edge])));
    }
  }
  return result;
}

}  // namespace

Points resample(const Points& outline, double spacing) {
  return divided(outline, spacing, [](const Vec2& a, const Vec2& b) { return (b - a).norm(); });
}

Points resample(const Points& outline, const SizeField& size) {
  const std::size_t n = outline.size();
  std::size_t begin = 0;
  const auto from_finest = [&](std::size_t i) { return (outline[i] - size.fine_at).squaredNorm(); };
  for (std::size_t i = 0; i < n && corners_of(outline).empty(); ++i)
    if (from_finest(i) < from_finest(begin)) begin = i;
  Points fine;  // so finely that the size hardly changes along an edge
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = outline[(begin + i) % n], &b = outline[(begin + i + 1) % n];
    const double length = (b - a).norm();
    for (double s = 0; s < length;) {
      const Vec2 place = a + s / length * (b - a);
      fine.push_back(place);
      const double step = size(place) / 8;
      s = s + 1.5 * step < length ? s + step : length;
    }
  }
  return divided(fine, 1, [&](const Vec2& a, const Vec2& b) { return (b - a).norm() / size((a + b) / 2); });
}

Points outward_normals(const Points& outline) {
  const std::size_t n = outline.size();
  Points normals(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 in = (outline[i] - outline[(i + n - 1) % n]).normalized(),
               out = (outline[(i + 1) % n] - outline[i]).normalized();
    normals[i] = -perpendicular(in + out).normalized();
  }
  return normals;
}

double support(const Points& outline, const Vec2& direction) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Vec2& p : outline) largest = std::max(largest, direction.dot(p));
  return largest;
}

bool is_convex(const Points& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = outline[(i + 1) % n] - outline[i], after = outline[(i + 2) % n] - outline[(i + 1) % n];
    const double cross = before.x() * after.y() - before.y() * after.x();
    if (cross < -1e-9 * before.norm() * after.norm()) return false;
  }
  return true;
}

}  // namespace ricochet
