#pragma once
// The sweep over all springs of a body, written once for every law.

#include "force/lane.hpp"
#include "force/spring/linear.hpp"
#include "force/spring/quartic.hpp"
#include "lattice/lattice.hpp"

namespace ricochet {

/// Calls `use(law)` with the law of the lattice's springs: chosen once a sweep, never a spring.
template <class Use>
decltype(auto) with_spring_law(const Lattice& lattice, Use&& use) {
  constexpr double least = 1e-100;  // below it 1 + quartic x^2 is 1 for any stretch, and 1 / quartic may overflow
  return lattice.quartic < least ? use(Linear{}) : use(Quartic{lattice.quartic});
}

/// One force evaluation, kick and drift: v += kick F, x += drift v.
/// Springs are a half list by node, so F of a node is complete once its own row is done, and no later row needs its
/// position: kick and drift follow at once, while everything is in registers. `force` must hold what else acts on the
/// nodes (contact). `uniform`: every spring has the body's stiffness, which spares looking for its own.
template <bool uniform, int W, class Law>
[[gnu::noinline]] void kick_and_drift(Moving<W>& body, const Law law, const Lane<W>& kick, const Lane<W>& drift) {
  const Lattice& lattice = *body.lattice;
  const std::array<int, 2>* ends = lattice.spring.ends();
  const double *length = lattice.spring.length(), *strength = lattice.spring.stiffness();
  const int* first = lattice.first.data();
  Lane<W>*position = body.position.data(), *velocity = body.velocity.data(), *force = body.force.data();
  const Lane<W> stiffness = body.stiffness * law.scale(), kick_ = kick, drift_ = drift;
  Lane<W> pulse = Lane<W>::Zero();
  std::size_t s = 0;
  for (int i = 0, free = lattice.free; i < free; ++i) {
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
      const Lane<W> per_distance =
          1.0 / r;  // not tension / r: the divider would wait for the tension, which costs 15 %
      const Lane<W> stretch = r - length[s];
      Lane<W> of_spring;
      if constexpr (uniform)
        of_spring = stiffness;
      else
        of_spring = stiffness * strength[s];
      const Lane<W> pull = of_spring * law.scaled_tension(stretch) * per_distance;
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

/// The same for one or two impacts, whose springs fill the registers four or two at a time. Every number is made by the
/// same operations, and those of a node are summed in the same order, so the bits are those of a lane.
template <bool uniform, int W, class Law>
requires(W <= 2)
    [[gnu::noinline]] void kick_and_drift(Moving<W>& body, const Law law, const Lane<W>& kick, const Lane<W>& drift) {
  using Node = typename NodeVector<W>::Type;
  const Lattice& lattice = *body.lattice;
  const std::array<int, 2>* ends = lattice.spring.ends();
  const double *length = lattice.spring.length(), *strength = lattice.spring.stiffness();
  Node *position = reinterpret_cast<Node*>(body.position.data()),
       *velocity = reinterpret_cast<Node*>(body.velocity.data()), *force = reinterpret_cast<Node*>(body.force.data());
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
    if constexpr (!uniform)
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
  const Lane<4> all_stiffness = stiffness.template replicate<at_once, 1>();
  const std::size_t count = lattice.spring.size();
  std::size_t s = 0;
  for (; s + at_once <= count; s += at_once) pull_by(std::integral_constant<int, at_once>{}, s, all_stiffness);
  for (; s < count; ++s) pull_by(std::integral_constant<int, 1>{}, s, stiffness);
  Node pulse{};
  for (int i = 0, free = lattice.free; i < free; ++i) {
    velocity[i] += kick_ * force[i];
    position[i] += drift_ * velocity[i];
    force[i] = Node{};
    pulse += velocity[i];
  }
  for (int lane = 0; lane < W; ++lane) body.pulse[lane] = pulse[lane] + pulse[W + lane];
}

template <int W>
void kick_and_drift(Moving<W>& body, const Lane<W>& kick, const Lane<W>& drift) {
  with_spring_law(*body.lattice, [&](const auto& law) {
    body.lattice->uniform ? kick_and_drift<true>(body, law, kick, drift)
                          : kick_and_drift<false>(body, law, kick, drift);
  });
}

/// Potential energy of all springs, above that at rest. [m0 c^2]
template <int W>
Lane<W> spring_energy(const Moving<W>& body) {
  const Lattice& lattice = *body.lattice;
  const NodeVectors<W>& position = body.position;
  return with_spring_law(lattice, [&](const auto& law) {
    Lane<W> sum = Lane<W>::Zero();
    for (int i = 0; i < lattice.free; ++i)
      for (int s = lattice.first[i]; s < lattice.first[i + 1]; ++s) {
        const Spring spring = lattice.spring[s];
        const Lane<W> dx = position.x(spring.other) - position.x(i), dy = position.y(spring.other) - position.y(i);
        const Lane<W> stretch = (dx * dx + dy * dy).sqrt() - spring.length;
        sum += spring.stiffness * law.energy(stretch);
      }
    return Lane<W>(body.stiffness * (sum - lattice.rest_energy));
  });
}

}  // namespace ricochet
