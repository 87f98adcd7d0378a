#pragma once
// Other ways to write the spring sweep, for bench_springs: each does what kick_and_drift does, and was slower or no
// faster.

#ifdef __AVX512F__
#include <immintrin.h>
#endif

#include <numeric>

#include "body/springs/sweep.hpp"
#include "core/rng.hpp"

namespace ricochet::variants {

/// One flat loop over springs that scatters to both ends, then one over nodes that kicks and drifts.
template <int W>
void edge_list(Motion<W>& body, const Lane<W>& kick, const Lane<W>& drift) {
  const Solid& lattice = *body.lattice;
  const Quartic law{lattice.quartic};
  const auto* ends = lattice.springs()->list.ends();
  const double* length = lattice.springs()->list.length();
  Lane<W>*position = body.position.data(), *velocity = body.velocity.data(), *force = body.force.data();
  const Lane<W> stiffness = body.stiffness * law.scale();
  for (std::size_t s = 0, count = lattice.springs()->list.size(); s < count; ++s) {
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
  for (std::size_t i = 0, free = 2 * static_cast<std::size_t>(lattice.free); i < free; ++i) {
    velocity[i] += kick * force[i];
    position[i] += drift * velocity[i];
    force[i].setZero();
  }
}

/// Positions as displacements from rest; the stretch without cancellation, (2 d.u + u^2) / (r + L) with rest vector d.
/// rest[spring]: d.
template <int W>
void displacements(Motion<W>& body, const std::vector<Vec2>& rest, const Lane<W>& kick, const Lane<W>& drift) {
  const Solid& lattice = *body.lattice;
  const Quartic law{lattice.quartic};
  const auto* ends = lattice.springs()->list.ends();
  const double* length = lattice.springs()->list.length();
  Lane<W>*position = body.position.data(), *velocity = body.velocity.data(), *force = body.force.data();
  const Lane<W> stiffness = body.stiffness * law.scale();
  std::size_t s = 0;
  for (int i = 0; i < lattice.free; ++i) {
    Lane<W> xi, yi, fx, fy;
    xi = position[2 * i];
    yi = position[2 * i + 1];
    fx = force[2 * i];
    fy = force[2 * i + 1];
    for (int n = lattice.first[i + 1] - lattice.first[i]; n > 0; --n, ++s) {
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
    const Lane<W> vx = velocity[2 * i] + kick * fx, vy = velocity[2 * i + 1] + kick * fy;
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
  const Solid& lattice = *body.lattice;
  const Quartic law{lattice.quartic};
  const auto* ends = lattice.springs()->list.ends();
  const double* length = lattice.springs()->list.length();
  Lane<W>*position = body.position.data(), *velocity = body.velocity.data(), *force = body.force.data();
  const Lane<W> stiffness = body.stiffness * law.scale();
  const std::size_t last = lattice.springs()->list.size() - 1;
  std::size_t s = 0;
  for (int i = 0; i < lattice.free; ++i) {
    Lane<W> xi, yi, fx, fy;
    xi = position[2 * i];
    yi = position[2 * i + 1];
    fx = force[2 * i];
    fy = force[2 * i + 1];
    for (int n = lattice.first[i + 1] - lattice.first[i]; n > 0; --n, ++s) {
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
    const Lane<W> vx = velocity[2 * i] + kick * fx, vy = velocity[2 * i + 1] + kick * fy;
    velocity[2 * i] = vx;
    velocity[2 * i + 1] = vy;
    position[2 * i] = xi + drift * vx;
    position[2 * i + 1] = yi + drift * vy;
    force[2 * i].setZero();
    force[2 * i + 1].setZero();
  }
}

/// The lattice with its free nodes renumbered: `number[old]` is the new one.
inline Solid renumbered(const Solid& lattice, const std::vector<int>& number) {
  Solid other = lattice;
  for (int i = 0; i < lattice.nodes(); ++i)
    other.points[static_cast<std::size_t>(number[static_cast<std::size_t>(i)])] =
        lattice.points[static_cast<std::size_t>(i)];
  std::vector<Spring> springs;
  for (std::size_t s = 0; s < lattice.springs()->list.size(); ++s) {
    Spring spring = lattice.springs()->list[s];
    const int a = number[static_cast<std::size_t>(spring.node)], b = number[static_cast<std::size_t>(spring.other)];
    spring.node = std::min(a, b);
    spring.other = std::max(a, b);
    springs.push_back(spring);
  }
  std::sort(springs.begin(), springs.end(),
            [](const Spring& a, const Spring& b) { return std::pair(a.node, a.other) < std::pair(b.node, b.other); });
  other.spring = {};
  other.first.assign(lattice.first.size(), 0);
  for (const Spring& spring : springs) {
    other.spring.push_back(spring);
    ++other.first[static_cast<std::size_t>(spring.node) + 1];
  }
  std::partial_sum(other.first.begin(), other.first.end(), other.first.begin());
  return other;
}

/// Numbers of nodes at random.
inline std::vector<int> at_random(const Solid& lattice) {
  std::vector<int> number(static_cast<std::size_t>(lattice.nodes()));
  std::iota(number.begin(), number.end(), 0);
  Random random(1, 0);
  for (std::size_t i = static_cast<std::size_t>(lattice.free); i > 1; --i)
    std::swap(number[i - 1], number[static_cast<std::size_t>(random.uniform(0, static_cast<double>(i)))]);
  return number;
}

/// Numbers of nodes by rows of their height, a tenth of a radius each.
inline std::vector<int> by_rows(const Solid& lattice) {
  std::vector<int> order(static_cast<std::size_t>(lattice.nodes())), number(order.size());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int i) {
    return std::pair(std::floor(10 * lattice.points[static_cast<std::size_t>(i)].y()),
                     lattice.points[static_cast<std::size_t>(i)].x());
  };
  std::sort(order.begin(), order.begin() + lattice.free, [&](int a, int b) { return place(a) < place(b); });
  for (std::size_t k = 0; k < order.size(); ++k) number[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  return number;
}

}  // namespace ricochet::variants
