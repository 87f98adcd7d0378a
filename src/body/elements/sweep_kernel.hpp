#pragma once
// The sweep in which an impact of elements spends its time.

#include "body/elements/sweep.hpp"

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

/// One force evaluation, kick and drift: v += kick F/m, x += drift v.
/// An element is held by its lowest node, so F of a node is complete once its own row is done, and no later row needs
/// its position: kick and drift follow at once, as in the sweep over springs. `f` must hold what else acts on the nodes
/// (contact). A body of revolution (`rings`) takes a sweep of its own, and so does one that yields, so that those of
/// elastic plane bodies stay as they are.
template <int W, bool rings, class Law>
[[gnu::noinline]] void sweep(Motion<W>& body, const Elements& elements, const Law& given, const Lane<W>& kick,
                             const Lane<W>& drift) {
  const std::array<int, 3>* nodes = elements.nodes.data();
  const ElementShape* shape = elements.shape.data();
  const EdgeMetric* metric = elements.metric.data();
  const double* per_mass = body.solid->mass.inverse().data();
  const int* first = elements.first.data();
  [[maybe_unused]] Lane<W> lost = Lane<W>::Zero();
  [[maybe_unused]] const double* off_axis = elements.off_axis.data();
  // What is in local variables is not reloaded after every store.
  Place<W, 2>*position = body.q.template places<2>(), *velocity = body.v.template places<2>(),
           *force = body.f.template places<2>();
  const Law law = given;
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
      ElementEdges<W> pulls;
      if constexpr (rings || Flows<Law, W>) {
        Lane<W> hoop = Lane<W>::Ones(), across;
        if constexpr (rings) hoop = (at.at[0] + position[j].at[0] + position[k].at[0]) * elements.ring[e].per_radii;
        if constexpr (Flows<Law, W>) {
          pulls = pulls_by_flow<W>(law, d, elements, e, hoop, body.flow->memory[e], lost, across);
        } else {
          const AxialTensor<Lane<W>> P = law.stress(AxialTensor<Lane<W>>(gradient_of<W>(d, shape[e]), hoop));
          pulls = pulls_of<W>(P.plane, shape[e]);
          across = P.zz;
        }
        if constexpr (rings) {
          const Lane<W> inwards = elements.ring[e].hoop * across;
          force[j].at[0] -= inwards;
          force[k].at[0] -= inwards;
          sum.at[0] -= inwards;
        }
      } else if constexpr (PullsEdges<Law, W>) {
        pulls = pulls_by_edges<W>(law, d, metric[e]);
      } else {
        pulls = pulls_of<W>(law.stress(gradient_of<W>(d, shape[e])), shape[e]);
      }
      force[j] -= pulls.first;
      force[k] -= pulls.second;
      sum += pulls.first + pulls.second;
    }
    Place<W, 2> v = velocity[i] + Lane<W>(kick_ * per_mass[i]) * sum;
    if constexpr (rings) v.at[0] *= off_axis[i];
    velocity[i] = v;
    position[i] = at + drift_ * v;
    force[i].set_zero();
    for (int k = 0; k < 2; ++k) pulse += v.at[k];
  }
  body.pulse = pulse;
  if constexpr (Flows<Law, W>) body.flow->lost += lost;
}

/// v += kick F/m, x += drift v.
template <int W>
void kick_and_drift(Motion<W>& body, const Elements& elements, const Lane<W>& kick, const Lane<W>& drift) {
  const auto sweep_by = [&](const auto& law) {
    if (body.solid->axisymmetric)
      sweep<W, true>(body, elements, law, kick, drift);
    else
      sweep<W, false>(body, elements, law, kick, drift);
  };
  if (body.flow)
    sweep_by(body.flow->law(elements.law, body.stiffness));
  else
    with_solid_law(elements.law, body.stiffness, sweep_by);
}

}  // namespace ricochet
