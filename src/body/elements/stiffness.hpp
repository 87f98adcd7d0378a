#pragma once
// The second derivatives of the energy of a body of elements, node by node.

#include "body/elements/sweep.hpp"

namespace ricochet {

/// Of two nodes, or of one: the force on the first is minus this times a small displacement of the second.
/// [m0 c^2/R^2]
template <int W>
using NodeStiffness = Tensor<Lane<W>>;

/// K_ab of the nodes of one element. Its columns are the pulls by a small displacement of node b along x and along y.
template <int W>
struct ElementStiffness {
  NodeStiffness<W> of_00, of_01, of_02, of_11, of_12, of_22;
};

/// Of a plane element: those of its lowest node follow from the others, as a translation strains nothing.
template <int W, class Law>
ElementStiffness<W> element_stiffness(const Law& law, const Tensor<Lane<W>>& F, const Elements& elements,
                                      std::size_t element) {
  const ElementShape& shape = elements.shape[element];
  const auto& [a, b, c, e] = shape.inverse;
  const Lane<W> none = Lane<W>::Zero();
  const auto lane = [](double value) { return Lane<W>(Lane<W>::Constant(value)); };
  // The pulls by a displacement of the end of an edge, whose row of the inverse is (p, q).
  const auto pulls = [&](double p, double q, bool along_y) {
    const Tensor<Lane<W>> dF =
        along_y ? Tensor<Lane<W>>(none, none, lane(p), lane(q)) : Tensor<Lane<W>>(lane(p), lane(q), none, none);
    return pulls_of<W>(law.tangent(F, dF), shape);
  };
  const ElementEdges<W> x1 = pulls(a, b, false), y1 = pulls(a, b, true), x2 = pulls(c, e, false),
                        y2 = pulls(c, e, true);
  ElementStiffness<W> K;
  const auto columns = [](const Place<W, 2>& x, const Place<W, 2>& y) {
    return NodeStiffness<W>(x.at[0], y.at[0], x.at[1], y.at[1]);
  };
  const auto of_lowest = [&](const ElementEdges<W>& x, const ElementEdges<W>& y) {
    return columns(-1.0 * (x.first + x.second), -1.0 * (y.first + y.second));
  };
  K.of_11 = columns(x1.first, y1.first);
  K.of_12 = columns(x2.first, y2.first);
  K.of_22 = columns(x2.second, y2.second);
  K.of_01 = of_lowest(x1, y1);
  K.of_02 = of_lowest(x2, y2);
  K.of_00 = {-(K.of_01.xx + K.of_02.xx), -(K.of_01.xy + K.of_02.xy), -(K.of_01.yx + K.of_02.yx),
             -(K.of_01.yy + K.of_02.yy)};
  return K;
}

/// Of a ring, which a translation along x strains.
template <int W, class Law>
ElementStiffness<W> element_stiffness(const Law& law, const AxialTensor<Lane<W>>& F, const Elements& elements,
                                      std::size_t element) {
  const auto& [a, b, c, e] = elements.shape[element].inverse;
  const RingShape& ring = elements.ring[element];
  const std::array<std::array<double, 2>, 3> slopes{{{-(a + c), -(b + e)}, {a, b}, {c, e}}};  // of the corners' shares
  const Lane<W> none = Lane<W>::Zero();
  const auto lane = [](double value) { return Lane<W>(Lane<W>::Constant(value)); };
  std::array<NodeStiffness<W>, 9> blocks;
  for (std::size_t of = 0; of < 3; ++of) {
    const auto& [p, q] = slopes[of];
    std::array<Place<W, 2>, 3> along_x, along_y;
    const auto pulls = [&](const AxialTensor<Lane<W>>& dF, std::array<Place<W, 2>, 3>& on) {
      const AxialTensor<Lane<W>> dP = law.tangent(F, dF);
      const ElementEdges<W> ends = pulls_of<W>(dP.plane, elements.shape[element]);
      on = {-1.0 * (ends.first + ends.second), ends.first, ends.second};
      for (Place<W, 2>& pull : on) pull.at[0] += ring.hoop * dP.zz;
    };
    pulls({Tensor<Lane<W>>(lane(p), lane(q), none, none), lane(ring.per_radii)}, along_x);
    pulls({Tensor<Lane<W>>(none, none, lane(p), lane(q)), none}, along_y);
    for (std::size_t on = 0; on < 3; ++on)
      blocks[3 * on + of] =
          NodeStiffness<W>(along_x[on].at[0], along_y[on].at[0], along_x[on].at[1], along_y[on].at[1]);
  }
  return {blocks[0], blocks[1], blocks[2], blocks[4], blocks[5], blocks[8]};
}

/// Calls `use(e, stiffness)` for every element, by rising e.
template <int W, class Use>
void each_element_stiffness(const Motion<W>& body, const Elements& elements, Use&& use) {
  each_element(body, elements, [&](const auto& law, std::size_t e, const auto& F, const auto&) {
    use(e, element_stiffness<W>(law, F, elements, e));
  });
}

/// The sums over all elements; 0 along and across what would take a node off its axis.
template <int W>
struct AssembledStiffness {
  std::vector<NodeStiffness<W>> diagonal;      ///< [node]
  std::vector<NodeStiffness<W>> off_diagonal;  ///< [edge] rows of its first end, columns of its second

  void assemble(const Motion<W>& body, const Elements& elements) {
    const Lane<W> none = Lane<W>::Zero();
    const NodeStiffness<W> zero(none, none, none, none);
    diagonal.assign(static_cast<std::size_t>(body.solid->nodes()), zero);
    off_diagonal.assign(elements.edge.size(), zero);
    each_element_stiffness(body, elements, [&](std::size_t e, const ElementStiffness<W>& K) {
      const auto& [i, j, k] = elements.nodes[e];
      add(diagonal[static_cast<std::size_t>(i)], K.of_00);
      add(diagonal[static_cast<std::size_t>(j)], K.of_11);
      add(diagonal[static_cast<std::size_t>(k)], K.of_22);
      add(off_diagonal[static_cast<std::size_t>(elements.edges[e][0])], K.of_01);
      add(off_diagonal[static_cast<std::size_t>(elements.edges[e][1])], K.of_02);
      add(off_diagonal[static_cast<std::size_t>(elements.edges[e][2])], K.of_12);
    });
    if (body.solid->axisymmetric) hold_axis(elements);
  }

 private:
  void hold_axis(const Elements& elements) {
    const auto off = [&](int node) { return elements.off_axis[static_cast<std::size_t>(node)]; };
    const auto hold = [](NodeStiffness<W>& K, double first, double second) {
      K.xx *= first * second;
      K.xy *= first;
      K.yx *= second;
    };
    for (std::size_t i = 0; i < diagonal.size(); ++i) hold(diagonal[i], elements.off_axis[i], elements.off_axis[i]);
    for (std::size_t s = 0; s < off_diagonal.size(); ++s)
      hold(off_diagonal[s], off(elements.edge[s][0]), off(elements.edge[s][1]));
  }
  static void add(NodeStiffness<W>& sum, const NodeStiffness<W>& more) {
    sum.xx += more.xx;
    sum.xy += more.xy;
    sum.yx += more.yx;
    sum.yy += more.yy;
  }
};

}  // namespace ricochet
