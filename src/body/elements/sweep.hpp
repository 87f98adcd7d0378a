#pragma once
// Sweeps over all elements of a body, written once for every law.

#include "body/elements/elements.hpp"
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

/// Calls `use(law, e, F)` for every element, by rising e: law of the lanes' own moduli.
template <int W, class Use>
void each_element(const Motion<W>& body, const Elements& elements, Use&& use) {
  const Place<W, 2>* position = body.q.template places<2>();
  with_solid_law(elements.law, body.stiffness, [&](const auto& law) {
    for (int e = 0; e < elements.size(); ++e) {
      const auto& [i, j, k] = elements.nodes[static_cast<std::size_t>(e)];
      const ElementEdges<W> d{position[j] - position[i], position[k] - position[i]};
      use(law, static_cast<std::size_t>(e), gradient_of<W>(d, elements.shape[static_cast<std::size_t>(e)]));
    }
  });
}

/// Potential energy of all elements. [m0 c^2]
template <int W>
Lane<W> element_energy(const Motion<W>& body, const Elements& elements) {
  Lane<W> sum = Lane<W>::Zero();
  each_element(body, elements, [&](const auto& law, std::size_t e, const Tensor<Lane<W>>& F) {
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

/// force += F of the elements. [m0 c^2/R]
template <int W>
void add_element_forces(const Motion<W>& body, const Elements& elements, Coordinates<W>& force) {
  Place<W, 2>* sum = force.template places<2>();
  each_element(body, elements, [&](const auto& law, std::size_t e, const Tensor<Lane<W>>& F) {
    take_pulls<W>(elements, e, law.stress(F), sum);
  });
}

/// product += K w: K the second derivatives of the elements' energy where the nodes are; held nodes count as 0.
template <int W>
void add_stiffness_times(const Motion<W>& body, const Elements& elements, const Coordinates<W>& w,
                         Coordinates<W>& product) {
  const Place<W, 2>* given = w.template places<2>();
  const auto moved = [&](int node) {
    Place<W, 2> by;
    by.set_zero();
    if (node < body.solid->free) by += given[node];
    return by;
  };
  Coordinates<W> pulled;
  pulled.resize(product.size());
  each_element(body, elements, [&](const auto& law, std::size_t e, const Tensor<Lane<W>>& F) {
    const auto& [i, j, k] = elements.nodes[e];
    const ElementEdges<W> d{moved(j) - moved(i), moved(k) - moved(i)};
    take_pulls<W>(elements, e, law.tangent(F, gradient_of<W>(d, elements.shape[e])), pulled.template places<2>());
  });
  for (int c = 0; c < product.size(); ++c) product[c] -= pulled[c];
}

}  // namespace ricochet
