#pragma once
#include <boost/align/aligned_allocator.hpp>
#include <vector>

#include "core/place.hpp"
#include "core/vec2.hpp"

namespace ricochet {

/// Coordinates of a body, or velocities or forces along them, in W lanes: [coordinate][lane]. Who moves them needs not
/// know what they are. Where they are places of nodes in D dimensions, node i owns D i ... D i + D - 1.
template <int W>
class Coordinates {
 public:
  /// To 0.
  void resize(int count) { values_.assign(static_cast<std::size_t>(count), Lane<W>::Zero()); }
  int size() const { return static_cast<int>(values_.size()); }
  Lane<W>& operator[](int c) { return values_[static_cast<std::size_t>(c)]; }
  const Lane<W>& operator[](int c) const { return values_[static_cast<std::size_t>(c)]; }
  Lane<W>* data() { return values_.data(); }
  const Lane<W>* data() const { return values_.data(); }

  /// The same, read as places: [node].
  template <int D>
  Place<W, D>* places() {
    return reinterpret_cast<Place<W, D>*>(values_.data());
  }
  template <int D>
  const Place<W, D>* places() const {
    return reinterpret_cast<const Place<W, D>*>(values_.data());
  }

  /// One node of one lane, in the plane.
  Vec2 at(int node, int lane) const { return {(*this)[2 * node][lane], (*this)[2 * node + 1][lane]}; }
  void set(int node, int lane, const Vec2& v) {
    (*this)[2 * node][lane] = v.x();
    (*this)[2 * node + 1][lane] = v.y();
  }
  void add(int node, int lane, const Vec2& v) {
    (*this)[2 * node][lane] += v.x();
    (*this)[2 * node + 1][lane] += v.y();
  }

 private:
  // From the beginning of a cache line on: no node of two or four lanes lies in two.
  std::vector<Lane<W>, boost::alignment::aligned_allocator<Lane<W>, 64>> values_;
};

}  // namespace ricochet
