#include "shape/crossed.hpp"

#include <algorithm>

#include "shape/outline.hpp"

namespace ricochet {

Points CrossedGrid::rim() const {
  Points points;
  for (int i = 0; i < columns(); ++i) points.emplace_back(x[static_cast<std::size_t>(i)], y.front());
  for (int j = 0; j < rows(); ++j) points.emplace_back(x.back(), y[static_cast<std::size_t>(j)]);
  for (int i = columns(); i > 0; --i) points.emplace_back(x[static_cast<std::size_t>(i)], y.back());
  for (int j = rows(); j > 0; --j) points.emplace_back(x.front(), y[static_cast<std::size_t>(j)]);
  return points;
}

Points CrossedGrid::inside() const {
  Points points;
  for (std::size_t j = 1; j + 1 < y.size(); ++j)
    for (std::size_t i = 1; i + 1 < x.size(); ++i) points.emplace_back(x[i], y[j]);
  for (std::size_t j = 0; j + 1 < y.size(); ++j)
    for (std::size_t i = 0; i + 1 < x.size(); ++i) points.emplace_back((x[i] + x[i + 1]) / 2, (y[j] + y[j + 1]) / 2);
  return points;
}

// The number of a point where lines cross.
int CrossedGrid::crossing(int column, int row) const {
  if (row == 0) return column;
  if (column == columns()) return columns() + row;
  if (row == rows()) return 2 * columns() + rows() - column;
  if (column == 0) return 2 * (columns() + rows()) - row;
  return 2 * (columns() + rows()) + (row - 1) * (columns() - 1) + column - 1;
}

std::vector<Triangle> CrossedGrid::triangles() const {
  std::vector<Triangle> triangles;
  int middle = 2 * (columns() + rows()) + (rows() - 1) * (columns() - 1);
  for (int j = 0; j < rows(); ++j)
    for (int i = 0; i < columns(); ++i) {
      const int corners[] = {crossing(i, j), crossing(i + 1, j), crossing(i + 1, j + 1), crossing(i, j + 1)};
      for (std::size_t k = 0; k < 4; ++k) triangles.push_back({corners[k], corners[(k + 1) % 4], middle});
      ++middle;
    }
  return triangles;
}

std::optional<CrossedGrid> crossed_grid(const Points& outline, const SizeField& size) {
  Vec2 low = outline.front(), high = low;
  for (const Vec2& p : outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  for (const Vec2& p : outline)
    if (p.x() != low.x() && p.x() != high.x() && p.y() != low.y() && p.y() != high.y()) return std::nullopt;
  for (const Vec2& corner : {low, high, Vec2(low.x(), high.y()), Vec2(high.x(), low.y())})
    if (std::find(outline.begin(), outline.end(), corner) == outline.end()) return std::nullopt;
  CrossedGrid grid;
  for (const Vec2& p : resample(outline, size)) {
    if (p.y() == low.y()) grid.x.push_back(p.x());
    if (p.x() == low.x()) grid.y.push_back(p.y());
  }
  for (std::vector<double>* lines : {&grid.x, &grid.y}) std::sort(lines->begin(), lines->end());
  return grid;
}

}  // namespace ricochet
