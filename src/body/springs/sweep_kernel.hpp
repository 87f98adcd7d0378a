#pragma once
// The sweep in which an impact spends its time.

#include "body/shares.hpp"
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
    v.add_to(pulse);
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

/// Which ends of a spring are pulled.
enum class Pulled { both, first, second };

/// The springs of a body in one or two lanes in the plane, which fill the registers four or two at a time. Every number
/// is made by the same operations as in a lane, and those of a node are summed in the same order.
template <class Same, int W, class Law>
class PackedPulls {
 public:
  PackedPulls(Motion<W>& body, const Springs& springs, const Law& law)
      : ends_(springs.list.ends()),
        length_(springs.list.length()),
        strength_(springs.list.stiffness()),
        position_(reinterpret_cast<const Node*>(body.q.data())),
        force_(reinterpret_cast<Node*>(body.f.data())),
        law_(law),
        stiffness_(body.stiffness * law.scale()),
        all_stiffness_(repeated(stiffness_)) {}

  const std::array<int, 2>* ends() const { return ends_; }

  [[gnu::always_inline]] void pull(std::size_t from, std::size_t to) const {
    std::size_t s = from;
    for (; s + at_once <= to; s += at_once) pull_some<at_once, Pulled::both>(s, all_stiffness_);
    for (; s < to; ++s) pull_some<1, Pulled::both>(s, stiffness_);
  }
  template <Pulled which>
  [[gnu::always_inline]] void pull_one(std::size_t s) const {
    pull_some<1, which>(s, stiffness_);
  }

 private:
  using Node = typename NodeVector<W>::Type;
  static constexpr int at_once = 4 / W;

  template <int N, Pulled which>
  [[gnu::always_inline]] void pull_some(std::size_t s, const Lane<N * W>& stiffness) const {
    Node d[N];
    for (std::size_t k = 0; k < N; ++k) d[k] = position_[ends_[s + k][1]] - position_[ends_[s + k][0]];
    Lane<N * W> dx, dy, rest, of_spring = stiffness;
    for (int k = 0; k < N; ++k)
      for (int lane = 0; lane < W; ++lane) {
        dx[k * W + lane] = d[k][lane];
        dy[k * W + lane] = d[k][W + lane];
        rest[k * W + lane] = length_[s + static_cast<std::size_t>(k)];
      }
    if constexpr (!Same::stiffness)
      for (int k = 0; k < N; ++k)
        for (int lane = 0; lane < W; ++lane) of_spring[k * W + lane] *= strength_[s + static_cast<std::size_t>(k)];
    const Lane<N* W> r = (dx * dx + dy * dy).sqrt();
    const Lane<N* W> per_distance = 1.0 / r;
    const Lane<N* W> stretch = r - rest;
    const Lane<N* W> pull = of_spring * law_.scaled_tension(stretch) * per_distance;
    const Lane<N*W> px = pull * dx, py = pull * dy;
    for (int k = 0; k < N; ++k) {
      Node p;
      for (int lane = 0; lane < W; ++lane) {
        p[lane] = px[k * W + lane];
        p[W + lane] = py[k * W + lane];
      }
      const auto& [first, second] = ends_[s + static_cast<std::size_t>(k)];
      if constexpr (which != Pulled::second) force_[first] += p;
      if constexpr (which != Pulled::first) force_[second] -= p;
    }
  }

  const std::array<int, 2>* ends_;
  const double *length_, *strength_;
  const Node* position_;
  Node* force_;
  Law law_;
  Lane<W> stiffness_;
  Lane<4> all_stiffness_;
};

/// Kick and drift of the nodes from ... to - 1; the sum of their velocities.
template <class Same, int W>
[[gnu::always_inline]] inline Lane<W> move_nodes(Motion<W>& body, const Lane<W>& kick, const Lane<W>& drift, int from,
                                                 int to) {
  using Node = typename NodeVector<W>::Type;
  Node *position = reinterpret_cast<Node*>(body.q.data()), *velocity = reinterpret_cast<Node*>(body.v.data()),
       *force = reinterpret_cast<Node*>(body.f.data());
  const double* per_mass = body.solid->mass.inverse().data();
  Node kick_, drift_, pulse{};
  for (int lane = 0; lane < W; ++lane) {
    kick_[lane] = kick_[W + lane] = kick[lane];
    drift_[lane] = drift_[W + lane] = drift[lane];
  }
  for (int i = from; i < to; ++i) {
    if constexpr (Same::mass)
      velocity[i] += kick_ * force[i];
    else
      velocity[i] += kick_ * per_mass[i] * force[i];
    position[i] += drift_ * velocity[i];
    force[i] = Node{};
    pulse += velocity[i];
  }
  Lane<W> sum;
  for (int lane = 0; lane < W; ++lane) sum[lane] = pulse[lane] + pulse[W + lane];
  return sum;
}

/// The sweep for one or two impacts in the plane.
template <int D, class Same, int W, class Law>
requires(W <= 2 && D == 2) [[gnu::noinline]] void sweep(Motion<W>& body, const Springs& springs, const Law law,
                                                        const Lane<W>& kick, const Lane<W>& drift) {
  PackedPulls<Same, W, Law>(body, springs, law).pull(0, springs.list.size());
  body.pulse = move_nodes<Same>(body, kick, drift, 0, body.solid->free);
}

/// The forces that a share of a body sums.
template <class Same, int W, class Law>
[[gnu::noinline]] void pull_share(const PackedPulls<Same, W, Law> pulls, const Springs& springs, const Share& share) {
  const auto row = [&](int node) { return static_cast<std::size_t>(springs.first[static_cast<std::size_t>(node)]); };
  for (const int s : share.from_before) pulls.template pull_one<Pulled::second>(static_cast<std::size_t>(s));
  pulls.pull(row(share.begin), row(share.crossing));
  for (std::size_t s = row(share.crossing); s < row(share.end); ++s)
    if (pulls.ends()[s][1] < share.limit)
      pulls.template pull_one<Pulled::both>(s);
    else
      pulls.template pull_one<Pulled::first>(s);
}

/// The sweep by all threads of a team.
template <class Same, int W, class Law>
[[gnu::noinline]] void sweep_together(Motion<W>& body, const Springs& springs, const Law& law, const Lane<W>& kick,
                                      const Lane<W>& drift) {
  const Sharing& sharing = *body.sharing;
  std::vector<Lane<W>> pulses(sharing.shares.size());
  const PackedPulls<Same, W, Law> pulls(body, springs, law);
  sharing.team->run([&](int part) {
    const Share& share = sharing.shares[static_cast<std::size_t>(part)];
    pull_share(pulls, springs, share);
    sharing.team->meet();
    pulses[static_cast<std::size_t>(part)] = move_nodes<Same>(body, kick, drift, share.begin, share.end);
  });
  body.pulse.setZero();
  for (const Lane<W>& pulse : pulses) body.pulse += pulse;
}

/// v += kick F/m, x += drift v.
template <int D, int W>
void kick_and_drift(Motion<W>& body, const Springs& springs, const Lane<W>& kick, const Lane<W>& drift) {
  const Masses& mass = body.solid->mass;
  with_spring_law(springs.law, [&](const auto& law) {
    const auto sweep_by = [&]<class Same>(Same, const Lane<W>& by) {
      if constexpr (W == 1 && D == 2)
        if (body.sharing) return sweep_together<Same>(body, springs, law, by, drift);
      sweep<D, Same>(body, springs, law, by, drift);
    };
    if (!mass.uniform()) return sweep_by(Same<false, false>{}, kick);
    const Lane<W> per_mass = kick / mass.each();
    if (springs.uniform)
      sweep_by(Same<true, true>{}, per_mass);
    else
      sweep_by(Same<false, true>{}, per_mass);
  });
}

}  // namespace ricochet
