#pragma once
// The sweep in which an impact spends its time.

#include "body/springs/sweep.hpp"

namespace ricochet {

/// What a sweep need not look up: every spring has the body's stiffness; every node has the same mass, by which the
/// kick was divided beforehand.
template <bool one_stiffness, bool one_mass>
struct Same {
  static constexpr bool stiffness = one_stiffness, mass = one_mass;
};

/// One force evaluation, kick and drift: v += kick F, x += drift v.
/// Springs are a half list by node, so F of a node is complete once its own row is done, and no later row needs its
/// position: kick and drift follow at once, while everything is in registers. `f` must hold what else acts on the
/// nodes (contact).
template <int D, class Same, int W, class Law>
[[gnu::noinline]] void sweep(Motion<W>& body, const Springs& springs, const Law law, const Lane<W>& kick,
                             const Lane<W>& drift) {
  const std::array<int, 2>* ends = springs.list.ends();
  const double *length = springs.list.length(), *strength = springs.list.stiffness();
  const double* per_mass = body.solid->mass.inverse().data();
  const int* first = springs.first.data();
  // Pointers in local variables are not reloaded after every store.
  Place<W, D>*position = body.q.template places<D>(), *velocity = body.v.template places<D>(),
           *force = body.f.template places<D>();
  const Lane<W> stiffness = body.stiffness * law.scale(), kick_ = kick, drift_ = drift;
  Lane<W> pulse = Lane<W>::Zero();
  std::size_t s = 0;
  for (int i = 0, free = body.solid->free; i < free; ++i) {
    Place<W, D> at, sum;
    at = position[i];
    sum = force[i];
    for (int n = first[i + 1] - first[i]; n > 0; --n, ++s) {
      const std::size_t j = static_cast<std::size_t>(ends[s][1]);
      const Place<W, D> d = position[j] - at;
      const Lane<W> r = dot(d, d).sqrt();
      // Not tension / r: the divider would wait for the tension, which costs 15 %.
      const Lane<W> per_distance = 1.0 / r;
      const Lane<W> stretch = r - length[s];
      Lane<W> of_spring;
      if constexpr (Same::stiffness)
        of_spring = stiffness;
      else
        of_spring = stiffness * strength[s];
      const Lane<W> pull = of_spring * law.scaled_tension(stretch) * per_distance;
      const Place<W, D> pulled = pull * d;
      sum += pulled;
      force[j] -= pulled;
    }
    Lane<W> gain;
    if constexpr (Same::mass)
      gain = kick_;
    else
      gain = kick_ * per_mass[i];
    const Place<W, D> v = velocity[i] + gain * sum;
    velocity[i] = v;
    position[i] = at + drift_ * v;
    force[i].set_zero();
    for (int k = 0; k < D; ++k) pulse += v.at[k];
  }
  body.pulse = pulse;
}

/// x and y of a node in one or two lanes: x of each lane, then y. GCC's own vectors: it spreads Eigen's over two
/// registers.
template <int W>
struct NodeVector;
template <>
struct NodeVector<1> {
  using Type = double __attribute__((vector_size(16), may_alias));
};
template <>
struct NodeVector<2> {
  using Type = double __attribute__((vector_size(32), aligned(16), may_alias));
};

/// A register full of the lanes' numbers, over and over.
template <int W>
Lane<4> repeated(const Lane<W>& numbers) {
  Lane<4> full;
  for (int k = 0; k < 4; ++k) full[k] = numbers[k % W];
  return full;
}

/// The same for one or two impacts in the plane, whose springs fill the registers four or two at a time. Every number
/// is made by the same operations, and those of a node are summed in the same order, so the bits are those of a lane.
template <int D, class Same, int W, class Law>
requires(W <= 2 && D == 2) [[gnu::noinline]] void sweep(Motion<W>& body, const Springs& springs, const Law law,
                                                        const Lane<W>& kick, const Lane<W>& drift) {
  using Node = typename NodeVector<W>::Type;
  const std::array<int, 2>* ends = springs.list.ends();
  const double *length = springs.list.length(), *strength = springs.list.stiffness();
  Node *position = reinterpret_cast<Node*>(body.q.data()), *velocity = reinterpret_cast<Node*>(body.v.data()),
       *force = reinterpret_cast<Node*>(body.f.data());
  Node kick_, drift_;
  for (int lane = 0; lane < W; ++lane) {
    kick_[lane] = kick_[W + lane] = kick[lane];
    drift_[lane] = drift_[W + lane] = drift[lane];
  }
  const auto pull_by = [&]<int N>(std::integral_constant<int, N>, std::size_t s, const Lane<N * W>& stiffness) {
    Node d[N];
    for (std::size_t k = 0; k < N; ++k) d[k] = position[ends[s + k][1]] - position[ends[s + k][0]];
    Lane<N * W> dx, dy, rest, of_spring = stiffness;
    for (int k = 0; k < N; ++k)
      for (int lane = 0; lane < W; ++lane) {
        dx[k * W + lane] = d[k][lane];
        dy[k * W + lane] = d[k][W + lane];
        rest[k * W + lane] = length[s + static_cast<std::size_t>(k)];
      }
    if constexpr (!Same::stiffness)
      for (int k = 0; k < N; ++k)
        for (int lane = 0; lane < W; ++lane) of_spring[k * W + lane] *= strength[s + static_cast<std::size_t>(k)];
    const Lane<N* W> r = (dx * dx + dy * dy).sqrt();
    const Lane<N* W> per_distance = 1.0 / r;
    const Lane<N* W> stretch = r - rest;
    const Lane<N* W> pull = of_spring * law.scaled_tension(stretch) * per_distance;
    const Lane<N*W> px = pull * dx, py = pull * dy;
    for (int k = 0; k < N; ++k) {
      Node p;
      for (int lane = 0; lane < W; ++lane) {
        p[lane] = px[k * W + lane];
        p[W + lane] = py[k * W + lane];
      }
      force[ends[s + static_cast<std::size_t>(k)][0]] += p;
      force[ends[s + static_cast<std::size_t>(k)][1]] -= p;
    }
  };
  constexpr int at_once = 4 / W;
  const Lane<W> stiffness = body.stiffness * law.scale();
  const Lane<4> all_stiffness = repeated(stiffness);
  const std::size_t count = springs.list.size();
  std::size_t s = 0;
  for (; s + at_once <= count; s += at_once) pull_by(std::integral_constant<int, at_once>{}, s, all_stiffness);
  for (; s < count; ++s) pull_by(std::integral_constant<int, 1>{}, s, stiffness);
  Node pulse{};
  for (int i = 0, free = body.solid->free; i < free; ++i) {
    if constexpr (Same::mass)
      velocity[i] += kick_ * force[i];
    else
      velocity[i] += kick_ * body.solid->mass.inverse()[static_cast<std::size_t>(i)] * force[i];
    position[i] += drift_ * velocity[i];
    force[i] = Node{};
    pulse += velocity[i];
  }
  for (int lane = 0; lane < W; ++lane) body.pulse[lane] = pulse[lane] + pulse[W + lane];
}

/// v += kick F/m, x += drift v.
template <int D, int W>
void kick_and_drift(Motion<W>& body, const Springs& springs, const Lane<W>& kick, const Lane<W>& drift) {
  const Masses& mass = body.solid->mass;
  with_spring_law(springs.law, [&](const auto& law) {
    if (!mass.uniform()) return sweep<D, Same<false, false>>(body, springs, law, kick, drift);
    const Lane<W> per_mass = kick / mass.each();
    if (springs.uniform)
      sweep<D, Same<true, true>>(body, springs, law, per_mass, drift);
    else
      sweep<D, Same<false, true>>(body, springs, law, per_mass, drift);
  });
}

}  // namespace ricochet
