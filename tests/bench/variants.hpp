#pragma once
// Other ways to write the spring sweep, for bench_springs: each does what kick_and_drift does, and was slower or no
// faster. The bodies are those of bench_springs: one law, one stiffness, one mass.

#ifdef __AVX512F__
#include <immintrin.h>
#endif

#include <numeric>

#include "body/springs/sweep.hpp"
#include "core/rng.hpp"

namespace ricochet::variants {

/// What a way to sweep reads and writes. Pointers in local variables are not reloaded after every store.
template <int W>
struct Arrays {
  const std::array<int, 2>* ends;
  const double* length;
  const int* first;
  Lane<W>*position, *velocity, *force;  ///< x of node i at 2 i, y behind it
};

template <int W>
Arrays<W> arrays(Motion<W>& body) {
  const Springs& springs = *body.solid->springs();
  return {springs.list.ends(), springs.list.length(), springs.first.data(),
          body.q.data(),       body.v.data(),         body.f.data()};
}

template <int W>
Quartic law_of(const Motion<W>& body) {
  return {body.solid->springs()->law.quartic};
}

/// By coordinates, x and y of a node as numbers of their own: as the sweep was before nodes had a value, and what it is
/// held against.
template <int W>
[[gnu::noinline]] void raw(Motion<W>& body, const Lane<W>& kick, const Lane<W>& drift) {
  const auto [ends, length, first, position, velocity, force] = arrays(body);
  const Quartic law = law_of(body);
  const Lane<W> stiffness = body.stiffness * law.scale(), kick_ = kick / body.solid->mass.each(), drift_ = drift;
  Lane<W> pulse = Lane<W>::Zero();
  std::size_t s = 0;
  for (int i = 0, free = body.solid->free; i < free; ++i) {
    // Assigned, not copied: GCC copies an Eigen array in halves, and the full load that follows waits for both.
    Lane<W> xi, yi, fx, fy;
    xi = position[2 * i];
    yi = position[2 * i + 1];
    fx = force[2 * i];
    fy = force[2 * i + 1];
    for (int n = first[i + 1] - first[i]; n > 0; --n, ++s) {
      const std::size_t j = 2 * static_cast<std::size_t>(ends[s][1]);
      const Lane<W> dx = position[j] - xi, dy = position[j + 1] - yi;
      const Lane<W> r = (dx * dx + dy * dy).sqrt();
      const Lane<W> per_distance = 1.0 / r;
      const Lane<W> stretch = r - length[s];
      const Lane<W> pull = stiffness * law.scaled_tension(stretch) * per_distance;
      const Lane<W> px = pull * dx, py = pull * dy;
      fx += px;
      fy += py;
      force[j] -= px;
      force[j + 1] -= py;
    }
    const Lane<W> vx = velocity[2 * i] + kick_ * fx, vy = velocity[2 * i + 1] + kick_ * fy;
    velocity[2 * i] = vx;
    velocity[2 * i + 1] = vy;
    position[2 * i] = xi + drift_ * vx;
    position[2 * i + 1] = yi + drift_ * vy;
    force[2 * i].setZero();
    force[2 * i + 1].setZero();
    pulse += vx;
    pulse += vy;
  }
  body.pulse = pulse;
}

/// Place (core/place.hpp) with the copy constructor that the compiler makes.
template <int W>
struct Copied {
  Lane<W> at[2];

  [[gnu::always_inline]] Copied() {}
  [[gnu::always_inline]] Copied(const Lane<W>& x, const Lane<W>& y) : at{x, y} {}
  Copied(const Copied&) = default;
  Copied& operator=(const Copied&) = default;
  [[gnu::always_inline]] void set_zero() {
    at[0].setZero();
    at[1].setZero();
  }
  [[gnu::always_inline]] Copied& operator+=(const Copied& other) {
    at[0] += other.at[0];
    at[1] += other.at[1];
    return *this;
  }
  [[gnu::always_inline]] Copied& operator-=(const Copied& other) {
    at[0] -= other.at[0];
    at[1] -= other.at[1];
    return *this;
  }
  [[gnu::always_inline]] Copied& operator*=(const Lane<W>& by) {
    at[0] *= by;
    at[1] *= by;
    return *this;
  }
};

template <int W>
[[gnu::always_inline]] inline Copied<W> operator+(Copied<W> a, const Copied<W>& b) {
  return a += b;
}
template <int W>
[[gnu::always_inline]] inline Copied<W> operator-(Copied<W> a, const Copied<W>& b) {
  return a -= b;
}
template <int W>
[[gnu::always_inline]] inline Copied<W> operator*(const Lane<W>& by, Copied<W> a) {
  return a *= by;
}
template <int W>
[[gnu::always_inline]] inline Lane<W> dot(const Copied<W>& a, const Copied<W>& b) {
  return a.at[0] * b.at[0] + a.at[1] * b.at[1];
}

/// kick_and_drift with another value of a node, which begins as a copy: with Place<W, 2> it takes as long as what is
/// shipped.
template <class Place, int W>
[[gnu::noinline]] void by_place(Motion<W>& body, const Lane<W>& kick, const Lane<W>& drift) {
  const auto [ends, length, first, position_, velocity_, force_] = arrays(body);
  Place* position = reinterpret_cast<Place*>(position_);
  Place* velocity = reinterpret_cast<Place*>(velocity_);
  Place* force = reinterpret_cast<Place*>(force_);
  const Quartic law = law_of(body);
  const Lane<W> stiffness = body.stiffness * law.scale(), kick_ = kick / body.solid->mass.each(), drift_ = drift;
  Lane<W> pulse = Lane<W>::Zero();
  std::size_t s = 0;
  for (int i = 0, free = body.solid->free; i < free; ++i) {
    Place at = position[i], sum = force[i];
    for (int n = first[i + 1] - first[i]; n > 0; --n, ++s) {
      const std::size_t j = static_cast<std::size_t>(ends[s][1]);
      const Place d = position[j] - at;
      const Lane<W> r = dot(d, d).sqrt();
      const Lane<W> per_distance = 1.0 / r;
      const Lane<W> stretch = r - length[s];
      const Lane<W> pull = stiffness * law.scaled_tension(stretch) * per_distance;
      const Place pulled = pull * d;
      sum += pulled;
      force[j] -= pulled;
    }
    const Place v = velocity[i] + kick_ * sum;
    velocity[i] = v;
    position[i] = at + drift_ * v;
    force[i].set_zero();
    pulse += v.at[0];
    pulse += v.at[1];
  }
  body.pulse = pulse;
}

/// One flat loop over springs that scatters to both ends, then one over nodes that kicks and drifts.
template <int W>
void edge_list(Motion<W>& body, const Lane<W>& kick, const Lane<W>& drift) {
  const Springs& springs = *body.solid->springs();
  const auto* ends = springs.list.ends();
  const double* length = springs.list.length();
  Lane<W>*position = body.q.data(), *velocity = body.v.data(), *force = body.f.data();
  const Quartic law = law_of(body);
  const Lane<W> stiffness = body.stiffness * law.scale(), kick_ = kick / body.solid->mass.each();
  for (std::size_t s = 0, count = springs.list.size(); s < count; ++s) {
    const std::size_t i = 2 * static_cast<std::size_t>(ends[s][0]), j = 2 * static_cast<std::size_t>(ends[s][1]);
    const Lane<W> dx = position[j] - position[i], dy = position[j + 1] - position[i + 1];
    const Lane<W> r = (dx * dx + dy * dy).sqrt();
    const Lane<W> per_distance = 1.0 / r;
    const Lane<W> pull = stiffness * law.scaled_tension(Lane<W>(r - length[s])) * per_distance;
    const Lane<W> px = pull * dx, py = pull * dy;
    force[i] += px;
    force[i + 1] += py;
    force[j] -= px;
    force[j + 1] -= py;
  }
  for (std::size_t i = 0, free = 2 * static_cast<std::size_t>(body.solid->free); i < free; ++i) {
    velocity[i] += kick_ * force[i];
    position[i] += drift * velocity[i];
    force[i].setZero();
  }
}

/// Positions as displacements from rest; the stretch without cancellation, (2 d.u + u^2) / (r + L) with rest vector d.
/// rest[spring]: d.
template <int W>
void displacements(Motion<W>& body, const std::vector<Vec2>& rest, const Lane<W>& kick, const Lane<W>& drift) {
  const auto [ends, length, first, position, velocity, force] = arrays(body);
  const Quartic law = law_of(body);
  const Lane<W> stiffness = body.stiffness * law.scale(), kick_ = kick / body.solid->mass.each();
  std::size_t s = 0;
  for (int i = 0, free = body.solid->free; i < free; ++i) {
    Lane<W> xi, yi, fx, fy;
    xi = position[2 * i];
    yi = position[2 * i + 1];
    fx = force[2 * i];
    fy = force[2 * i + 1];
    for (int n = first[i + 1] - first[i]; n > 0; --n, ++s) {
      const std::size_t j = 2 * static_cast<std::size_t>(ends[s][1]);
      const Lane<W> ux = position[j] - xi, uy = position[j + 1] - yi;
      const Lane<W> dx = rest[s].x() + ux, dy = rest[s].y() + uy;
      const Lane<W> r = (dx * dx + dy * dy).sqrt();
      const Lane<W> stretch = (ux * (dx + rest[s].x()) + uy * (dy + rest[s].y())) / (r + length[s]);
      const Lane<W> pull = stiffness * law.scaled_tension(stretch) / r;
      const Lane<W> px = pull * dx, py = pull * dy;
      fx += px;
      fy += py;
      force[j] -= px;
      force[j + 1] -= py;
    }
    const Lane<W> vx = velocity[2 * i] + kick_ * fx, vy = velocity[2 * i + 1] + kick_ * fy;
    velocity[2 * i] = vx;
    velocity[2 * i + 1] = vy;
    position[2 * i] = xi + drift * vx;
    position[2 * i + 1] = yi + drift * vy;
    force[2 * i].setZero();
    force[2 * i + 1].setZero();
  }
}

/// Distance and its inverse from the squared distance, by the processor's root and division.
struct Divider {
  template <int W>
  void operator()(const Lane<W>& squared, Lane<W>& r, Lane<W>& inverse) const {
    r = squared.sqrt();
    inverse = 1.0 / r;
  }
};

/// The same to 2 ulp without root or division: Newton's steps for the inverse root from an integer guess (Lomont 2003;
/// its constant for doubles: Robertson 2012), with the same bits on every processor.
struct Newton {
  void operator()(const Lane<4>& squared, Lane<4>& r, Lane<4>& inverse) const {
    using Bits = long long __attribute__((vector_size(32), may_alias));
    const Lane<4> half = 0.5 * squared;
    *reinterpret_cast<Bits*>(inverse.data()) =
        0x5fe6eb50c7b537a9 - (*reinterpret_cast<const Bits*>(squared.data()) >> 1);
    for (int step = 0; step < 3; ++step) inverse = inverse * (1.5 - half * inverse * inverse);
    inverse += inverse * (0.5 - half * inverse * inverse);
    r = squared * inverse;
  }
};

#ifdef __AVX512F__
/// The processor's bits without its root: an estimate to 14 bits, two of Goldschmidt's steps, and Markstein's last one,
/// which rounds right.
struct Estimate {
  void operator()(const Lane<8>& squared, Lane<8>& r, Lane<8>& inverse) const {
    const __m512d a = _mm512_load_pd(squared.data()), half = _mm512_set1_pd(0.5), guess = _mm512_rsqrt14_pd(a);
    __m512d g = _mm512_mul_pd(a, guess), h = _mm512_mul_pd(guess, half);
    for (int step = 0; step < 2; ++step) {
      const __m512d rest = _mm512_fnmadd_pd(g, h, half);
      g = _mm512_fmadd_pd(g, rest, g);
      h = _mm512_fmadd_pd(h, rest, h);
    }
    _mm512_store_pd(r.data(), _mm512_fmadd_pd(_mm512_fnmadd_pd(g, g, a), h, g));
    inverse = 1.0 / r;
  }
};
#endif

/// kick_and_drift by another root, or with the far ends of springs `ahead` of the current one fetched into the cache.
template <int ahead, class Root, int W>
void by_node(Motion<W>& body, const Lane<W>& kick, const Lane<W>& drift) {
  const auto [ends, length, first, position, velocity, force] = arrays(body);
  const Quartic law = law_of(body);
  const Lane<W> stiffness = body.stiffness * law.scale(), kick_ = kick / body.solid->mass.each();
  const std::size_t last = body.solid->springs()->list.size() - 1;
  std::size_t s = 0;
  for (int i = 0, free = body.solid->free; i < free; ++i) {
    Lane<W> xi, yi, fx, fy;
    xi = position[2 * i];
    yi = position[2 * i + 1];
    fx = force[2 * i];
    fy = force[2 * i + 1];
    for (int n = first[i + 1] - first[i]; n > 0; --n, ++s) {
      const std::size_t j = 2 * static_cast<std::size_t>(ends[s][1]);
      if constexpr (ahead > 0) {
        const std::size_t soon = 2 * static_cast<std::size_t>(ends[std::min(s + ahead, last)][1]);
        __builtin_prefetch(&position[soon]);
        __builtin_prefetch(&force[soon], 1);
      }
      const Lane<W> dx = position[j] - xi, dy = position[j + 1] - yi, squared = dx * dx + dy * dy;
      Lane<W> r, per_distance;
      Root{}(squared, r, per_distance);
      const Lane<W> pull = stiffness * law.scaled_tension(Lane<W>(r - length[s])) * per_distance;
      const Lane<W> px = pull * dx, py = pull * dy;
      fx += px;
      fy += py;
      force[j] -= px;
      force[j + 1] -= py;
    }
    const Lane<W> vx = velocity[2 * i] + kick_ * fx, vy = velocity[2 * i + 1] + kick_ * fy;
    velocity[2 * i] = vx;
    velocity[2 * i + 1] = vy;
    position[2 * i] = xi + drift * vx;
    position[2 * i + 1] = yi + drift * vy;
    force[2 * i].setZero();
    force[2 * i + 1].setZero();
  }
}

/// The solid with its free nodes renumbered, as far as a sweep looks at it: `number[old]` is the new one.
inline Solid renumbered(const Solid& solid, const std::vector<int>& number) {
  Solid other = solid;
  const auto new_number = [&](int node) { return number[static_cast<std::size_t>(node)]; };
  for (int i = 0; i < solid.nodes(); ++i)
    other.points[static_cast<std::size_t>(new_number(i))] = solid.points[static_cast<std::size_t>(i)];
  const Springs& old = *solid.springs();
  std::vector<Spring> list;
  for (std::size_t s = 0; s < old.list.size(); ++s) {
    Spring spring = old.list[s];
    const int a = new_number(spring.node), b = new_number(spring.other);
    spring.node = std::min(a, b);
    spring.other = std::max(a, b);
    list.push_back(spring);
  }
  std::sort(list.begin(), list.end(),
            [](const Spring& a, const Spring& b) { return std::pair(a.node, a.other) < std::pair(b.node, b.other); });
  Springs springs = old;
  springs.list = {};
  springs.first.assign(old.first.size(), 0);
  for (const Spring& spring : list) {
    springs.list.push_back(spring);
    ++springs.first[static_cast<std::size_t>(spring.node) + 1];
  }
  std::partial_sum(springs.first.begin(), springs.first.end(), springs.first.begin());
  other.interior = springs;
  return other;
}

/// Numbers of nodes at random.
inline std::vector<int> at_random(const Solid& solid) {
  std::vector<int> number(static_cast<std::size_t>(solid.nodes()));
  std::iota(number.begin(), number.end(), 0);
  Random random(1, 0);
  for (std::size_t i = static_cast<std::size_t>(solid.free); i > 1; --i)
    std::swap(number[i - 1], number[static_cast<std::size_t>(random.uniform(0, static_cast<double>(i)))]);
  return number;
}

/// Numbers of nodes by rows of their height, a tenth of a radius each.
inline std::vector<int> by_rows(const Solid& solid) {
  std::vector<int> order(static_cast<std::size_t>(solid.nodes())), number(order.size());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int i) {
    return std::pair(std::floor(10 * solid.points[static_cast<std::size_t>(i)].y()),
                     solid.points[static_cast<std::size_t>(i)].x());
  };
  std::sort(order.begin(), order.begin() + solid.free, [&](int a, int b) { return place(a) < place(b); });
  for (std::size_t k = 0; k < order.size(); ++k) number[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  return number;
}

}  // namespace ricochet::variants
