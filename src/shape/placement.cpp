#include "shape/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/error.hpp"
#include "shape/closest.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

/// Answers `contains` quickly for many points: edges of all chains sorted into horizontal strips.
class Inside {
 public:
  explicit Inside(const Rim& rim) : rim_(rim), box_(bounding_box(rim.points)), strips_(rim.points.size()) {
    height_ = (box_.high.y() - box_.low.y()) / static_cast<double>(strips_.size());
    for (std::size_t i = 0; i < rim.cells.size(); ++i) {
      const Vec2 &a = rim.from(i), &b = rim.to(i);
      for (std::size_t s = strip(std::min(a.y(), b.y())); s <= strip(std::max(a.y(), b.y())); ++s)
        strips_[s].push_back(i);
    }
  }

  bool operator()(const Vec2& p) const {
    if (p.y() < box_.low.y() || p.y() > box_.high.y()) return false;
    bool inside = false;
    each_crossing(p.y(), [&](double x) { inside = inside != (p.x() < x); });
    return inside;
  }

  /// Where the rim crosses the height y, from left to right: a line at y is inside from the first to the second,
  /// and so on.
  std::vector<double> crossings(double y) const {
    std::vector<double> xs;
    if (y < box_.low.y() || y > box_.high.y()) return xs;
    each_crossing(y, [&](double x) { xs.push_back(x); });
    std::sort(xs.begin(), xs.end());
    return xs;
  }

  const Box& box() const { return box_; }

 private:
  // Calls use(x) wherever an edge crosses the height y of the box.
  template <class Use>
  void each_crossing(double y, Use&& use) const {
    for (const std::size_t i : strips_[strip(y)]) {
      const Vec2 &a = rim_.to(i), &b = rim_.from(i);
      if ((a.y() > y) != (b.y() > y)) use(a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()));
    }
  }

  std::size_t strip(double y) const {
    const double s = std::clamp((y - box_.low.y()) / height_, 0.0, static_cast<double>(strips_.size() - 1));
    return static_cast<std::size_t>(s);
  }

  const Rim& rim_;
  Box box_;
  double height_ = 1;
  std::vector<std::vector<std::size_t>> strips_;
};

Vec2 draw(const Box& box, Random& random) {
  const double x = random.uniform(box.low.x(), box.high.x());
  return {x, random.uniform(box.low.y(), box.high.y())};
}

/// A grid over a box that answers whether a point in it has a neighbour nearer than `distance`, which must not be above
/// the first one given.
class Neighbours {
 public:
  Neighbours(const Box& box, double distance) : low_(box.low), cell_(distance) {
    const Vec2 size = (box.high - box.low) / cell_;
    columns_ = static_cast<std::int64_t>(size.x()) + 3;  // a border spares questions at the edge
    cells_.resize(static_cast<std::size_t>(columns_ * (static_cast<std::int64_t>(size.y()) + 3)));
  }
  void add(const Vec2& p) {
    Member& first = cells_[static_cast<std::size_t>(cell(p))];
    if (std::isnan(first.x)) {
      first.x = p.x();
      first.y = p.y();
    } else {
      more_.push_back({p.x(), p.y(), first.next});
      first.next = static_cast<std::int32_t>(more_.size() - 1);
    }
  }
  bool any_nearer(const Vec2& p, double distance) const {
    const double square = distance * distance;
    const auto nearer = [&](const Member& m) {
      return (p.x() - m.x) * (p.x() - m.x) + (p.y() - m.y) * (p.y() - m.y) < square;
    };
    for (std::int64_t row = cell(p) - columns_ - 1, last = row + 2 * columns_; row <= last; row += columns_)
      for (std::int64_t c = row; c < row + 3; ++c) {
        const Member* m = &cells_[static_cast<std::size_t>(c)];
        if (nearer(*m)) return true;
        while (m->next != none)
          if (m = &more_[static_cast<std::size_t>(m->next)]; nearer(*m)) return true;
      }
    return false;
  }

 private:
  static constexpr std::int32_t none = -1;
  /// The first point of a cell, in place; NaN, which is near to nothing, if it has none. Others are linked.
  struct Member {
    double x = std::numeric_limits<double>::quiet_NaN(), y = 0;
    std::int32_t next = none;
  };

  std::int64_t cell(const Vec2& p) const {
    return (static_cast<std::int64_t>((p.y() - low_.y()) / cell_) + 1) * columns_ +
           static_cast<std::int64_t>((p.x() - low_.x()) / cell_) + 1;
  }

  Vec2 low_;
  double cell_;
  std::int64_t columns_ = 0;
  std::vector<Member> cells_, more_;  // cells_: [row][column]
};

/// Keeps points away from a rim.
class Margin {
 public:
  Margin(const Rim& rim, double width) : tree_(rim.points, rim.cells), width_(width) {}
  bool operator()(const Vec2& p) const {
    const auto distance = [&](std::size_t s) { return closest(p, tree_.from(s), tree_.to(s)).distance; };
    return width_ == 0 || tree_.nearest(p, width_, distance) == width_;
  }
  double width() const { return width_; }

 private:
  CellTree tree_;
  double width_;
};

/// Squares of a rim's box that lie wholly inside and wholly nearer than some distance to a point: darts at a
/// nearly full surface mostly fall there, and one bit tells. Another tells of most darts whether they are inside at
/// all.
class Covered {
 public:
  Covered(const Rim& rim, const Inside& inside, double side) : low_(inside.box().low), side_(side) {
    const Vec2 size = (inside.box().high - low_) / side_;
    columns_ = static_cast<std::int64_t>(size.x()) + 1;
    rows_ = static_cast<std::int64_t>(size.y()) + 1;
    covered_.resize(static_cast<std::size_t>(columns_ * rows_ / 64 + 1));
    inside_ = divided_ = covered_;
    for (std::int64_t j = 0; j < rows_; ++j) {
      const std::vector<double> xs = inside.crossings(low_.y() + side_ * (static_cast<double>(j) + 0.5));
      for (std::size_t k = 0; k + 1 < xs.size(); k += 2)
        for (std::int64_t i = column(Vec2(xs[k], 0)), last = column(Vec2(xs[k + 1], 0)); i <= last; ++i)
          set(inside_, j * columns_ + i);
    }
    // An edge divides only squares that its stretches of less than a side reach.
    for (std::size_t k = 0; k < rim.cells.size(); ++k) {
      const Vec2 &a = rim.from(k), edge = rim.to(k) - a;
      const int pieces = static_cast<int>(edge.norm() / side_) + 1;
      for (int piece = 0; piece <= pieces; ++piece)
        around(a + edge * piece / pieces, 1, [&](std::int64_t square) {
          unset(inside_, square);
          set(divided_, square);
        });
    }
  }
  void clear() { std::fill(covered_.begin(), covered_.end(), 0); }
  // Row by row the squares between the two ends of the disk there, a word of them at a time.
  void add(const Vec2& p, double distance) {
    const double within = distance * (1 - 1e-9);  // the squares' corners are rounded
    const std::int64_t reach = static_cast<std::int64_t>(within / side_) + 1;
    for (std::int64_t j = std::max<std::int64_t>(0, row(p) - reach), last = std::min(rows_ - 1, row(p) + reach);
         j <= last; ++j) {
      const double below = low_.y() + side_ * static_cast<double>(j) - p.y(),
                   farthest = std::max(-below, below + side_);
      const double half = std::sqrt(std::max(0.0, within * within - farthest * farthest));
      const std::int64_t from =
          std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil((p.x() - half - low_.x()) / side_)));
      const std::int64_t to =
          std::min(columns_, static_cast<std::int64_t>(std::floor((p.x() + half - low_.x()) / side_)));
      for (std::int64_t i = j * columns_ + from, end = j * columns_ + to; i < end;) {
        const std::int64_t next = std::min(end, (i / 64 + 1) * 64);
        const auto word = static_cast<std::size_t>(i / 64);
        covered_[word] |= inside_[word] & (~std::uint64_t{0} >> (64 - (next - i)) << (i % 64));
        i = next;
      }
    }
  }
  std::int64_t square_of(const Vec2& p) const { return row(p) * columns_ + column(p); }
  void expect(std::int64_t square) const { __builtin_prefetch(&covered_[static_cast<std::size_t>(square / 64)]); }
  bool operator()(std::int64_t square) const { return is_set(covered_, square); }
  /// Whether p, which lies in that square, is inside the rim.
  bool inside(std::int64_t square, const Vec2& p, const Inside& inside) const {
    return is_set(inside_, square) || (is_set(divided_, square) && inside(p));
  }

 private:
  using Bits = std::vector<std::uint64_t>;
  static bool is_set(const Bits& bits, std::int64_t i) {
    return bits[static_cast<std::size_t>(i / 64)] >> (i % 64) & 1;
  }
  static void set(Bits& bits, std::int64_t i) {
    bits[static_cast<std::size_t>(i / 64)] |= std::uint64_t{1} << (i % 64);
  }
  static void unset(Bits& bits, std::int64_t i) {
    bits[static_cast<std::size_t>(i / 64)] &= ~(std::uint64_t{1} << (i % 64));
  }
  std::int64_t column(const Vec2& p) const {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>((p.x() - low_.x()) / side_), 0, columns_ - 1);
  }
  std::int64_t row(const Vec2& p) const {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>((p.y() - low_.y()) / side_), 0, rows_ - 1);
  }

  // Calls use(square) for those at most `reach` from that of p.
  template <class Use>
  void around(const Vec2& p, std::int64_t reach, Use&& use) {
    for (std::int64_t j = std::max<std::int64_t>(0, row(p) - reach); j <= std::min(rows_ - 1, row(p) + reach); ++j)
      for (std::int64_t i = std::max<std::int64_t>(0, column(p) - reach);
           i <= std::min(columns_ - 1, column(p) + reach); ++i)
        use(j * columns_ + i);
  }

  Vec2 low_;
  double side_;
  std::int64_t columns_ = 0, rows_ = 0;
  Bits covered_, inside_, divided_;  // [row * columns + column]; inside: wholly; divided: perhaps, by an edge
};

// Throws unless some place is inside and keeps the margin.
void check_room(const Inside& inside, const Margin& margin) {
  constexpr int darts = 100000;
  Random random(0, 0);
  for (int i = 0; i < darts && margin.width() > 0; ++i)
    if (const Vec2 p = draw(inside.box(), random); inside(p) && margin(p)) return;
  if (margin.width() > 0)
    throw FieldError("margin", fmt::format("{:g} leaves no room inside the rim; lower it", margin.width()));
}

Points place_uniform(const Inside& inside, const Margin& margin, int count, Random& random) {
  Points points;
  while (static_cast<int>(points.size()) < count) {
    const Vec2 p = draw(inside.box(), random);
    if (inside(p) && margin(p)) points.push_back(p);
  }
  return points;
}

// Dart throwing with a falling radius: random sequential packing jams at a coverage of 0.547, which is a least distance
// of 0.83 spacings; start just below and shrink by 1 % whenever darts keep missing.
Points place_poisson_disk(const Rim& rim, const Inside& inside, const Margin& margin, int count, double spacing,
                          Random& random) {
  double distance = 0.82 * spacing;
  Neighbours neighbours(inside.box(), distance);
  for (const Vec2& p : rim.points) neighbours.add(p);
  Covered covered(rim, inside, distance / 3);
  Points points;
  const auto cover_again = [&] {
    covered.clear();
    for (const Vec2& p : rim.points) covered.add(p, distance);
    for (const Vec2& p : points) covered.add(p, distance);
  };
  cover_again();
  struct Dart {
    Vec2 p;
    std::int64_t square;
  };
  std::array<Dart, 32> darts;  // at once, because each falls anywhere and would wait for memory
  for (std::int64_t misses = 0;;) {
    for (Dart& dart : darts) {
      dart.p = draw(inside.box(), random);
      dart.square = covered.square_of(dart.p);
      covered.expect(dart.square);
    }
    for (const auto& [p, square] : darts) {
      if (static_cast<int>(points.size()) == count) return points;
      const bool miss = covered(square);
      if (!miss && !(covered.inside(square, p, inside) && margin(p))) continue;
      if (!miss && !neighbours.any_nearer(p, distance)) {
        neighbours.add(p);
        covered.add(p, distance);
        points.push_back(p);
      } else if (++misses > 20 * static_cast<std::int64_t>(count) + 1000) {
        distance *= 0.99;
        misses = 0;
        cover_again();
      }
    }
  }
}

Points triangular_lattice(const Rim& rim, const Inside& inside, const Margin& margin, double side) {
  const Box& box = inside.box();
  Neighbours on_rim(box, 0.6 * side);
  for (const Vec2& p : rim.points) on_rim.add(p);
  const Vec2 centre = (box.low + box.high) / 2;
  const double row = side * std::sqrt(3.0) / 2;
  const int rows = static_cast<int>(std::ceil((box.high.y() - box.low.y()) / 2 / row));
  const int columns = static_cast<int>(std::ceil((box.high.x() - box.low.x()) / 2 / side)) + 1;
  Points points;
  for (int j = -rows; j <= rows; ++j)
    for (int i = -columns; i <= columns; ++i) {
      const Vec2 p = centre + Vec2((i + (j % 2 != 0 ? 0.5 : 0.0)) * side, j * row);
      if (inside(p) && !on_rim.any_nearer(p, 0.6 * side) && margin(p)) points.push_back(p);
    }
  return points;
}

// The side whose lattice comes nearest to `count` points: the count falls with the side, so bisect.
Points place_triangular(const Rim& rim, const Inside& inside, const Margin& margin, int count, double spacing) {
  const double ideal = spacing * std::sqrt(2 / std::sqrt(3.0));
  double low = 0.6 * ideal, high = 1.6 * ideal;
  const auto lattice = [&](double side) { return triangular_lattice(rim, inside, margin, side); };
  Points best = lattice(ideal);
  const auto miss = [&](const Points& points) { return std::abs(static_cast<int>(points.size()) - count); };
  for (int i = 0; i < 30 && miss(best) > 0; ++i) {
    const double side = (low + high) / 2;
    Points points = lattice(side);
    (static_cast<int>(points.size()) > count ? low : high) = side;
    if (miss(points) < miss(best)) best = std::move(points);
  }
  return best;
}

}  // namespace

Points place_interior(const Rim& rim, Placement placement, const Spacing& wanted, Random& random) {
  if (wanted.count <= 0) return {};
  const Inside inside(rim);
  const Margin margin(rim, wanted.margin);
  check_room(inside, margin);
  switch (placement) {
    case Placement::uniform:
      return place_uniform(inside, margin, wanted.count, random);
    case Placement::poisson_disk:
      return place_poisson_disk(rim, inside, margin, wanted.count, wanted.spacing, random);
    case Placement::triangular:
      return place_triangular(rim, inside, margin, wanted.count, wanted.spacing);
  }
  return {};
}

Placement placement_from_name(const std::string& name) {
  if (name == "uniform") return Placement::uniform;
  if (name == "poisson_disk") return Placement::poisson_disk;
  if (name == "triangular") return Placement::triangular;
  throw FieldError("placement", "no placement is called '" + name + "'");
}

}  // namespace ricochet
