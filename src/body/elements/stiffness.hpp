#pragma once
// The second derivatives of the energy of a body of elements, node by node.

#include "body/elements/sweep.hpp"

namespace ricochet {

/// Of two nodes, or of one: the force on the first is minus this times a small displacement of the second.
/// [m0 c^2/R^2]
template <int W>
using NodeStiffness = Tensor<Lane<W>>;

/// K_ab of the nodes of one element. Its columns are the pulls by a small displacement of node b along x and along y;
/// those of its lowest node follow from the others, as a translation strains nothing.
template <int W>
struct ElementStiffness {
  NodeStiffness<W> of_01, of_02, of_11, of_12, of_22;

  NodeStiffness<W> of_00() const {
    return {-(of_01.xx + of_02.xx), -(of_01.xy + of_02.xy), -(of_01.yx + of_02.yx), -(of_01.yy + of_02.yy)};
  }
};

template <int W, class Law>
ElementStiffness<W> element_stiffness(const Law& law, const Tensor<Lane<W>>& F, const ElementShape& shape) {
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
  return K;
}

/// Calls `use(e, stiffness)` for every element, by rising e.
template <int W, class Use>
void each_element_stiffness(const Motion<W>& body, const Elements& elements, Use&& use) {
  each_element(body, elements, [&](const auto& law, std::size_t e, const Tensor<Lane<W>>& F) {
    use(e, element_stiffness<W>(law, F, elements.shape[e]));
  });
}

/// The sums over all elements.
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
      add(diagonal[static_cast<std::size_t>(i)], K.of_00());
      add(diagonal[static_cast<std::size_t>(j)], K.of_11);
      add(diagonal[static_cast<std::size_t>(k)], K.of_22);
      add(off_diagonal[static_cast<std::size_t>(elements.edges[e][0])], K.of_01);
      add(off_diagonal[static_cast<std::size_t>(elements.edges[e][1])], K.of_02);
      add(off_diagonal[static_cast<std::size_t>(elements.edges[e][2])], K.of_12);
    });
  }

 private:
  static void add(NodeStiffness<W>& sum, const NodeStiffness<W>& more) {
    sum.xx += more.xx;
    sum.xy += more.xy;
    sum.yx += more.yx;
    sum.yy += more.yy;
  }
};

}  // namespace ricochet
