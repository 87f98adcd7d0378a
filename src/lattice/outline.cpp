#include "lattice/outline.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ricochet {
namespace {

// Twice the area of the triangle a, b, c. Its sign is all that is used; points within rounding of a line count as on it.
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

}  // namespace

double signed_area(const Points& outline) {
  double twice = 0;
  for (std::size_t i = 0, n = outline.size(); i < n; ++i) twice += cross(outline[i], outline[(i + 1) % n]);
  return twice / 2;
}

bool is_simple(const Points& outline) {
  const std::size_t n = outline.size();
  if (n < 3) return false;
  // Edges by their left end: only those whose x ranges overlap are compared.
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  const auto left = [&](std::size_t i) { return std::min(outline[i].x(), outline[(i + 1) % n].x()); };
  const auto right = [&](std::size_t i) { return std::max(outline[i].x(), outline[(i + 1) % n].x()); };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return left(i) < left(j); });
  for (std::size_t s = 0; s < n; ++s) {
    const std::size_t i = order[s];
    if (outline[i] == outline[(i + 1) % n]) return false;
    for (std::size_t t = s + 1; t < n && left(order[t]) <= right(i); ++t) {
      const std::size_t j = order[t];
      const Vec2 &a = outline[i], &b = outline[(i + 1) % n], &c = outline[j], &d = outline[(j + 1) % n];
      if ((i + 1) % n == j || (j + 1) % n == i) {  // neighbours: only a fold back onto each other is wrong
        const Vec2 &corner = (i + 1) % n == j ? b : a, &before = (i + 1) % n == j ? a : b, &after = (i + 1) % n == j ? d : c;
        if (orientation(before, corner, after) == 0 && (before - corner).dot(after - corner) > 0) return false;
      } else if (segments_meet(a, b, c, d)) {
        return false;
      }
    }
  }
  return true;
}

bool contains(const Points& outline, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vec2 &a = outline[i], &b = outline[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

bool outlines_overlap(const Points& a, const Points& b) {
  // Only the edges of either that reach into the other's box can meet.
  const auto edges_near = [](const Points& outline, const Points& other) {
    Vec2 low = other[0], high = other[0];
    for (const Vec2& p : other) low = low.cwiseMin(p), high = high.cwiseMax(p);
    std::vector<std::pair<Vec2, Vec2>> edges;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 &from = outline[i], &to = outline[(i + 1) % outline.size()];
      if ((from.cwiseMax(to).array() >= low.array()).all() && (from.cwiseMin(to).array() <= high.array()).all()) edges.emplace_back(from, to);
    }
    return edges;
  };
  const auto of_b = edges_near(b, a);
  for (const auto& [p, q] : edges_near(a, b))
    for (const auto& [r, s] : of_b)
      if (segments_meet(p, q, r, s)) return true;
  return contains(a, b[0]) || contains(b, a[0]);
}

Points resample(const Points& outline, double spacing) {
  const std::size_t n = outline.size();
  const double cos_turn = std::sqrt(3.0) / 2;  // 30 degrees
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 in = (outline[i] - outline[(i + n - 1) % n]).normalized(), out = (outline[(i + 1) % n] - outline[i]).normalized();
    if (in.dot(out) < cos_turn) corners.push_back(i);
  }
  const bool smooth = corners.empty();
  if (smooth) corners.push_back(0);

  Points result;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const std::size_t first = corners[c], last = c + 1 < corners.size() ? corners[c + 1] : corners[0] + n;
    std::vector<double> arc{0};  // arc length from `first` to each point of this stretch
    for (std::size_t i = first; i < last; ++i) arc.push_back(arc.back() + (outline[(i + 1) % n] - outline[i % n]).norm());
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

Points outward_normals(const Points& outline) {
  const std::size_t n = outline.size();
  Points normals(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 in = (outline[i] - outline[(i + n - 1) % n]).normalized(), out = (outline[(i + 1) % n] - outline[i]).normalized();
    normals[i] = -perpendicular(in + out).normalized();
  }
  return normals;
}

double support(const Points& outline, const Vec2& direction) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Vec2& p : outline) largest = std::max(largest, direction.dot(p));
  return largest;
}

}  // namespace ricochet
