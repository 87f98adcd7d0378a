#pragma once
// The sweep in which an impact of elements spends its time.

#include <utility>

#include "body/elements/sweep.hpp"
#include "body/shares.hpp"

namespace ricochet {

/// Whether a law finds what pulls edges back without the deformation gradient.
template <class Law, int W>
concept PullsEdges = requires(const Law& law, const Tensor<Lane<W>>& D, const EdgeMetric& metric) {
  law.edge_pulls(D, metric);
};

/// Whether it lets elements yield, and changes what they remember.
template <class Law, int W>
concept Flows = std::same_as<Law, HenckyFlow<W>>;

template <int W, class Law>
[[gnu::always_inline]] inline ElementEdges<W> pulls_by_edges(const Law& law, const ElementEdges<W>& d,
                                                             const EdgeMetric& metric) {
  Tensor<Lane<W>> D;
  D.xx = d.first.at[0];
  D.xy = d.second.at[0];
  D.yx = d.first.at[1];
  D.yy = d.second.at[1];
  const Tensor<Lane<W>> H = law.edge_pulls(D, metric);
  return {Place<W, 2>(H.xx, H.yx), Place<W, 2>(H.xy, H.yy)};
}

/// The same of an element that yields: weight tau D^-T. It remembers what flows; what that loses adds to `lost`, and
/// `across` becomes P_zz.
template <int W>
[[gnu::always_inline]] inline ElementEdges<W> pulls_by_flow(const HenckyFlow<W>& law, const ElementEdges<W>& d,
                                                            const Elements& elements, std::size_t e,
                                                            const Lane<W>& hoop, PlasticMemory<W>& memory,
                                                            Lane<W>& lost, Lane<W>& across) {
  const AxialTensor<Lane<W>> F(gradient_of<W>(d, elements.shape[e]), hoop);
  const Lane<W> area = d.first.at[0] * d.second.at[1] - d.first.at[1] * d.second.at[0];
  Lane<W> of_volume = Lane<W>::Zero();
  const AxialTensor<Lane<W>> tau = law.flowed(F, area * elements.metric[e].per_rest_area, memory, of_volume);
  lost += elements.weight[e] * of_volume;
  across = tau.zz / hoop;
  const Lane<W> share = elements.weight[e] / area;
  const Lane<W> xx = share * tau.plane.xx, xy = share * tau.plane.xy, yy = share * tau.plane.yy;
  ElementEdges<W> pulls;
  pulls.first.at[0] = xx * d.second.at[1] - xy * d.second.at[0];
  pulls.first.at[1] = xy * d.second.at[1] - yy * d.second.at[0];
  pulls.second.at[0] = xy * d.first.at[0] - xx * d.first.at[1];
  pulls.second.at[1] = yy * d.first.at[0] - xy * d.first.at[1];
  return pulls;
}

/// What an element that does not yield pulls its nodes with.
template <int W>
struct ElementPull {
  ElementEdges<W> edges;
  Lane<W> inwards;  ///< of a ring: towards the axis, each corner
};

/// Of an element with these edges; `radii`: of a ring, the sum of its corners' x.
template <int W, bool rings, class Law>
[[gnu::always_inline]] inline ElementPull<W> pull_of(const Law& law, const Elements& elements, std::size_t e,
                                                     const ElementEdges<W>& d, const Lane<W>& radii) {
  const ElementShape* shape = elements.shape.data();
  if constexpr (rings) {
    const RingShape& ring = elements.ring[e];
    const AxialTensor<Lane<W>> P =
        law.stress(AxialTensor<Lane<W>>(gradient_of<W>(d, shape[e]), Lane<W>(radii * ring.per_radii)));
    return {pulls_of<W>(P.plane, shape[e]), ring.hoop * P.zz};
  } else if constexpr (PullsEdges<Law, W>) {
    return {pulls_by_edges<W>(law, d, elements.metric.data()[e]), radii};
  } else {
    return {pulls_of<W>(law.stress(gradient_of<W>(d, shape[e])), shape[e]), radii};
  }
}

/// One force evaluation, kick and drift: v += kick F/m, x += drift v.
/// An element is held by its lowest node, so F of a node is complete once its own row is done, and no later row needs
/// its position: kick and drift follow at once, as in the sweep over springs. `f` must hold what else acts on the nodes
/// (contact). A body of revolution (`rings`) takes a sweep of its own, and so does one that yields, so that those of
/// elastic plane bodies stay as they are.
template <int W, bool rings, class Laws>
[[gnu::noinline]] void sweep(Motion<W>& body, const Elements& elements, const Laws& given, const Lane<W>& kick,
                             const Lane<W>& drift) {
  using Law = typename Laws::Law;
  const std::array<int, 3>* nodes = elements.nodes.data();
  const double* per_mass = body.solid->mass.inverse().data();
  const int* first = elements.first.data();
  [[maybe_unused]] Lane<W> lost = Lane<W>::Zero();
  [[maybe_unused]] const double* off_axis = elements.off_axis.data();
  // What is in local variables is not reloaded after every store.
  Place<W, 2>*position = body.q.template places<2>(), *velocity = body.v.template places<2>(),
           *force = body.f.template places<2>();
  const Laws laws = given;
  const Lane<W> kick_ = kick, drift_ = drift;
  Lane<W> pulse = Lane<W>::Zero();
  std::size_t e = 0;
  for (int i = 0, free = body.solid->free; i < free; ++i) {
    Place<W, 2> at, sum;
    at = position[i];
    sum = force[i];
    for (int n = first[i + 1] - first[i]; n > 0; --n, ++e) {
      const std::size_t j = static_cast<std::size_t>(nodes[e][1]), k = static_cast<std::size_t>(nodes[e][2]);
      const ElementEdges<W> d{position[j] - at, position[k] - at};
      Lane<W> radii;
      if constexpr (rings) radii = at.at[0] + position[j].at[0] + position[k].at[0];
      const auto& law = laws.of(e);
      ElementPull<W> pull;
      if constexpr (Flows<Law, W>) {
        Lane<W> hoop = Lane<W>::Ones(), across;
        if constexpr (rings) hoop = radii * elements.ring[e].per_radii;
        pull.edges = pulls_by_flow<W>(law, d, elements, e, hoop, body.flow->memory[e], lost, across);
        if constexpr (rings) pull.inwards = elements.ring[e].hoop * across;
      } else {
        pull = pull_of<W, rings>(law, elements, e, d, radii);
      }
      if constexpr (rings) {
        force[j].at[0] -= pull.inwards;
        force[k].at[0] -= pull.inwards;
        sum.at[0] -= pull.inwards;
      }
      force[j] -= pull.edges.first;
      force[k] -= pull.edges.second;
      sum += pull.edges.first + pull.edges.second;
    }
    Place<W, 2> v = velocity[i] + Lane<W>(kick_ * per_mass[i]) * sum;
    if constexpr (rings) v.at[0] *= off_axis[i];
    velocity[i] = v;
    position[i] = at + drift_ * v;
    force[i].set_zero();
    v.add_to(pulse);
  }
  body.pulse = pulse;
  if constexpr (Flows<Law, W>) body.flow->lost += lost;
}

/// The forces that a share of a body sums: left in `f`.
template <bool rings, class Laws>
[[gnu::noinline]] void pull_share(Motion<1>& body, const Elements& elements, const Laws& laws, const Share& share) {
  const auto row = [&](int node) { return static_cast<std::size_t>(elements.first[static_cast<std::size_t>(node)]); };
  const Place<1, 2>* position = body.q.places<2>();
  Place<1, 2>* force = body.f.places<2>();
  const auto pull = [&](std::size_t e) {
    const auto& [i, j, k] = elements.nodes[e];
    const ElementEdges<1> d{position[j] - position[i], position[k] - position[i]};
    const Lane<1> radii = position[i].at[0] + position[j].at[0] + position[k].at[0];
    const ElementPull<1> of_element = pull_of<1, rings>(laws.of(e), elements, e, d, radii);
    for (const auto& [node, edge] : {std::pair(j, &of_element.edges.first), std::pair(k, &of_element.edges.second)}) {
      if (node < share.begin || node >= share.limit) continue;
      if constexpr (rings) force[node].at[0] -= of_element.inwards;
      force[node] -= *edge;
    }
    return of_element;
  };
  for (const int e : share.from_before) pull(static_cast<std::size_t>(e));
  for (int i = share.begin; i < share.end; ++i)
    for (std::size_t e = row(i); e < row(i + 1); ++e) {
      const ElementPull<1> of_node = pull(e);
      if constexpr (rings) force[i].at[0] -= of_node.inwards;
      force[i] += of_node.edges.first + of_node.edges.second;
    }
}

/// Kick and drift of a share's nodes; the sum of their velocities.
template <bool rings>
Lane<1> move_share(Motion<1>& body, const Elements& elements, const Lane<1>& kick, const Lane<1>& drift,
                   const Share& share) {
  const double* per_mass = body.solid->mass.inverse().data();
  Place<1, 2>*position = body.q.places<2>(), *velocity = body.v.places<2>(), *force = body.f.places<2>();
  Lane<1> pulse = Lane<1>::Zero();
  for (int i = share.begin; i < share.end; ++i) {
    Place<1, 2> v = velocity[i] + Lane<1>(kick * per_mass[i]) * force[i];
    if constexpr (rings) v.at[0] *= elements.off_axis[static_cast<std::size_t>(i)];
    velocity[i] = v;
    position[i] = position[i] + drift * v;
    force[i].set_zero();
    v.add_to(pulse);
  }
  return pulse;
}

/// The sweep by all threads of a team.
template <bool rings, class Laws>
void sweep_together(Motion<1>& body, const Elements& elements, const Laws& laws, const Lane<1>& kick,
                    const Lane<1>& drift) {
  const Sharing& sharing = *body.sharing;
  std::vector<Lane<1>> pulses(sharing.shares.size());
  sharing.team->run([&](int part) {
    const Share& share = sharing.shares[static_cast<std::size_t>(part)];
    pull_share<rings>(body, elements, laws, share);
    sharing.team->meet();
    pulses[static_cast<std::size_t>(part)] = move_share<rings>(body, elements, kick, drift, share);
  });
  body.pulse.setZero();
  for (const Lane<1>& pulse : pulses) body.pulse += pulse;
}

/// v += kick F/m, x += drift v.
template <int W>
void kick_and_drift(Motion<W>& body, const Elements& elements, const Lane<W>& kick, const Lane<W>& drift) {
  const auto sweep_by = [&]<class Laws>(const Laws& laws) {
    if constexpr (W == 1 && !Flows<typename Laws::Law, W>)
      if (body.sharing)
        return body.solid->axisymmetric ? sweep_together<true>(body, elements, laws, kick, drift)
                                        : sweep_together<false>(body, elements, laws, kick, drift);
    if (body.solid->axisymmetric)
      sweep<W, true>(body, elements, laws, kick, drift);
    else
      sweep<W, false>(body, elements, laws, kick, drift);
  };
  const auto by_laws = [&](const auto& law) { with_laws<W>(elements, law, body.stiffness, sweep_by); };
  if (body.flow)
    by_laws(body.flow->law(elements.law, body.stiffness));
  else
    with_solid_law(elements.law, body.stiffness, by_laws);
}

}  // namespace ricochet
