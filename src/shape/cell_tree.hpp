#pragma once
#include <algorithm>
#include <utility>
#include <vector>

#include "core/vec2.hpp"
#include "shape/surface.hpp"

namespace ricochet {

/// The segments of chains as a binary tree of bounding boxes over runs of them, so that a search looks at few. Built in
/// O(n); refers to the points.
class CellTree {
 public:
  CellTree(const Points& points, Cells<2> cells)
      : points_(points), cells_(std::move(cells)), boxes_(2 * cells_.size() - 1) {
    build(0, 0, cells_.size());
  }
  /// Of an outline: segment s joins points s and s + 1, the last one the last point and the first.
  explicit CellTree(const Points& outline) : CellTree(outline, ring(static_cast<int>(outline.size()))) {}

  std::size_t size() const { return cells_.size(); }
  const Vec2& from(std::size_t segment) const { return points_[static_cast<std::size_t>(cells_[segment][0])]; }
  const Vec2& to(std::size_t segment) const { return points_[static_cast<std::size_t>(cells_[segment][1])]; }
  /// True if no segment before joins this one.
  bool begins_chain(std::size_t segment) const { return segment == 0 || cells_[segment - 1][1] != cells_[segment][0]; }

  /// Calls found(segment), by rising number, where wanted(low, high) is true of the segment's box and of every run's
  /// that holds it.
  template <class Wanted, class Found>
  void search(const Wanted& wanted, const Found& found) const {
    search(0, 0, cells_.size(), wanted, found);
  }

  /// The least distance(segment), or `least` if none is below it. `distance`: that of the segment from p.
  template <class Distance>
  double nearest(const Vec2& p, double least, const Distance& distance) const {
    nearest(0, 0, cells_.size(), p, least, distance);
    return least;
  }

 private:
  struct Box {
    Vec2 low, high;
  };

  // The box of a run of segments lies at `place`, those within its first half follow, then those within its second
  // half.
  static std::size_t middle(std::size_t begin, std::size_t end) { return begin + (end - begin) / 2; }
  static std::size_t second(std::size_t place, std::size_t begin, std::size_t end) {
    return place + 2 * (middle(begin, end) - begin);
  }

  void build(std::size_t place, std::size_t begin, std::size_t end) {
    Box& box = boxes_[place];
    if (end - begin == 1) {
      box = {from(begin).cwiseMin(to(begin)), from(begin).cwiseMax(to(begin))};
      return;
    }
    build(place + 1, begin, middle(begin, end));
    build(second(place, begin, end), middle(begin, end), end);
    const Box &a = boxes_[place + 1], &b = boxes_[second(place, begin, end)];
    box = {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
  }

  template <class Wanted, class Found>
  void search(std::size_t place, std::size_t begin, std::size_t end, const Wanted& wanted, const Found& found) const {
    if (!wanted(boxes_[place].low, boxes_[place].high)) return;
    if (end - begin == 1) return found(begin);
    search(place + 1, begin, middle(begin, end), wanted, found);
    search(second(place, begin, end), middle(begin, end), end, wanted, found);
  }

  template <class Distance>
  void nearest(std::size_t place, std::size_t begin, std::size_t end, const Vec2& p, double& least,
               const Distance& distance) const {
    if (end - begin == 1) {
      least = std::min(least, distance(begin));
      return;
    }
    // Less by more than it is rounded: a box may end where its segment does.
    const auto from_box = [&](std::size_t at) {
      return (1 - 1e-15) * (boxes_[at].low - p).cwiseMax(p - boxes_[at].high).cwiseMax(0.0).norm();
    };
    const std::size_t a = place + 1, b = second(place, begin, end), half = middle(begin, end);
    const double to_a = from_box(a), to_b = from_box(b);
    const auto first_half = [&] {
      if (to_a < least) nearest(a, begin, half, p, least, distance);
    };
    const auto second_half = [&] {
      if (to_b < least) nearest(b, half, end, p, least, distance);
    };
    if (to_a <= to_b) {
      first_half();
      second_half();
    } else {
      second_half();
      first_half();
    }
  }

  const Points& points_;
  Cells<2> cells_;
  std::vector<Box> boxes_;
};

}  // namespace ricochet
