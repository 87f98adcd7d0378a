#pragma once
// Sweeps over all elements of a body, written once for every law.

#include "body/elements/laws.hpp"
#include "body/motion.hpp"

namespace ricochet {

/// v += kick F/m, x += drift v of the free nodes, in one sweep over the elements; F holds what `f` held, and empties
/// it. Compiled by itself (sweep.cpp): its time is that of an impact. Its definition: sweep_kernel.hpp.
template <int W>
void kick_and_drift(Motion<W>& body, const Elements& elements, const Lane<W>& kick, const Lane<W>& drift);

/// The edges of an element from its lowest node, of places or of displacements.
template <int W>
struct ElementEdges {
  Place<W, 2> first, second;
};

/// [d1 d2] inverse: the deformation gradient of edges, or its change of their displacements.
template <int W>
[[gnu::always_inline]] inline Tensor<Lane<W>> gradient_of(const ElementEdges<W>& d, const ElementShape& shape) {
  const auto& [a, b, c, e] = shape.inverse;
  Tensor<Lane<W>> F;
  F.xx = d.first.at[0] * a + d.second.at[0] * c;
  F.xy = d.first.at[0] * b + d.second.at[0] * e;
  F.yx = d.first.at[1] * a + d.second.at[1] * c;
  F.yy = d.first.at[1] * b + d.second.at[1] * e;
  return F;
}

/// P of_area^T: what pulls the ends of an element's edges back; the sum of both pulls its lowest node.
template <int W>
[[gnu::always_inline]] inline ElementEdges<W> pulls_of(const Tensor<Lane<W>>& P, const ElementShape& shape) {
  const auto& [a, b, c, e] = shape.of_area;
  ElementEdges<W> pulls;
  pulls.first.at[0] = P.xx * a + P.xy * b;
  pulls.first.at[1] = P.yx * a + P.yy * b;
  pulls.second.at[0] = P.xx * c + P.xy * e;
  pulls.second.at[1] = P.yx * c + P.yy * e;
  return pulls;
}

/// The deformation gradient of a plane element, or its change, at its corners' places or displacements.
template <int W>
struct PlaneGradient {
  using Gradient = Tensor<Lane<W>>;
  static Gradient of(const Elements& elements, std::size_t e, const Place<W, 2>& i, const Place<W, 2>& j,
                     const Place<W, 2>& k) {
    return gradient_of<W>(ElementEdges<W>{j - i, k - i}, elements.shape[e]);
  }
};

/// The same of a ring of a body of revolution.
template <int W>
struct RingGradient {
  using Gradient = AxialTensor<Lane<W>>;
  static Gradient of(const Elements& elements, std::size_t e, const Place<W, 2>& i, const Place<W, 2>& j,
                     const Place<W, 2>& k) {
    return {gradient_of<W>(ElementEdges<W>{j - i, k - i}, elements.shape[e]),
            Lane<W>((i.at[0] + j.at[0] + k.at[0]) * elements.ring[e].per_radii)};
  }
};

/// Calls `use(kind)`, kind: PlaneGradient or RingGradient, as the body is; chosen once a sweep.
template <int W, class Use>
void with_gradient(const Solid& solid, Use&& use) {
  if (solid.axisymmetric)
    use(RingGradient<W>{});
  else
    use(PlaneGradient<W>{});
}

/// Calls `use(law, e, F, kind)` for every element, by rising e: law of the lanes' and its own moduli, and of what it
/// remembers;
/// kind as above.
template <int W, class Use>
void each_element(const Motion<W>& body, const Elements& elements, Use&& use) {
  const Place<W, 2>* position = body.q.template places<2>();
  with_gradient<W>(*body.solid, [&](const auto& kind) {
    const auto gradient = [&](std::size_t e) {
      const auto& [i, j, k] = elements.nodes[e];
      return kind.of(elements, e, position[i], position[j], position[k]);
    };
    if (const Flow<W>* flow = body.flow) {
      with_laws<W>(elements, flow->law(elements.law, body.stiffness), body.stiffness, [&](const auto& laws) {
        for (std::size_t e = 0; e < elements.nodes.size(); ++e)
          use(RememberingLaw<W>{laws.of(e), flow->memory[e]}, e, gradient(e), kind);
      });
      return;
    }
    with_solid_law(elements.law, body.stiffness, [&](const auto& law) {
      with_laws<W>(elements, law, body.stiffness, [&](const auto& laws) {
        for (std::size_t e = 0; e < elements.nodes.size(); ++e) use(laws.of(e), e, gradient(e), kind);
      });
    });
  });
}

/// Potential energy of all elements. [m0 c^2]
template <int W>
Lane<W> element_energy(const Motion<W>& body, const Elements& elements) {
  Lane<W> sum = Lane<W>::Zero();
  each_element(body, elements, [&](const auto& law, std::size_t e, const auto& F, const auto&) {
    sum += elements.weight[e] * law.energy(F);
  });
  return sum;
}

/// sum -= P of_area^T at the nodes of an element.
template <int W>
void take_pulls(const Elements& elements, std::size_t e, const Tensor<Lane<W>>& P, Place<W, 2>* sum) {
  const auto& [i, j, k] = elements.nodes[e];
  const ElementEdges<W> pulls = pulls_of<W>(P, elements.shape[e]);
  sum[i] += pulls.first + pulls.second;
  sum[j] -= pulls.first;
  sum[k] -= pulls.second;
}

template <int W>
void take_pulls(const Elements& elements, std::size_t e, const AxialTensor<Lane<W>>& P, Place<W, 2>* sum) {
  take_pulls<W>(elements, e, P.plane, sum);
  const Lane<W> inwards = elements.ring[e].hoop * P.zz;
  for (const int node : elements.nodes[e]) sum[node].at[0] -= inwards;
}

/// force += F of the elements; across its axis a node of it feels none. [m0 c^2/R]
template <int W>
void add_element_forces(const Motion<W>& body, const Elements& elements, Coordinates<W>& force) {
  Place<W, 2>* sum = force.template places<2>();
  each_element(body, elements, [&](const auto& law, std::size_t e, const auto& F, const auto&) {
    take_pulls<W>(elements, e, law.stress(F), sum);
  });
  for (std::size_t i = 0; i < elements.off_axis.size(); ++i) sum[i].at[0] *= elements.off_axis[i];
}

/// product += K w: K the second derivatives of the elements' energy where the nodes are; held nodes count as 0, and so
/// does what would take a node off its axis.
template <int W>
void add_stiffness_times(const Motion<W>& body, const Elements& elements, const Coordinates<W>& w,
                         Coordinates<W>& product) {
  const Place<W, 2>* given = w.template places<2>();
  const auto moved = [&](int node) {
    Place<W, 2> by;
    by.set_zero();
    if (node < body.solid->free) by += given[node];
    if (body.solid->axisymmetric) by.at[0] *= elements.off_axis[static_cast<std::size_t>(node)];
    return by;
  };
  Coordinates<W> pulled;
  pulled.resize(product.size());
  each_element(body, elements, [&](const auto& law, std::size_t e, const auto& F, const auto& kind) {
    const auto& [i, j, k] = elements.nodes[e];
    take_pulls<W>(elements, e, law.tangent(F, kind.of(elements, e, moved(i), moved(j), moved(k))),
                  pulled.template places<2>());
  });
  for (std::size_t i = 0; i < elements.off_axis.size(); ++i)
    pulled.template places<2>()[i].at[0] *= elements.off_axis[i];
  for (int c = 0; c < product.size(); ++c) product[c] -= pulled[c];
}

}  // namespace ricochet
