#include "body/elements/build.hpp"

#include <algorithm>
#include <map>

#include "core/error.hpp"

namespace ricochet {
namespace {

// [node] the modulus that the script gave, relative to the body's number; 1 where it gave none.
std::vector<double> moduli_of(const Body& body, const std::vector<int>& number) {
  std::vector<double> moduli(number.size(), 1.0);
  for (std::size_t i = 0; i < body.node_stiffness.size(); ++i)
    moduli[at(number[i])] = body.node_stiffness[i] / body.numbers.stiffness;
  return moduli;
}

// The mean of a triangle's corners; of equal ones that number itself, to the last bit.
double mean_of(const std::array<double, 3>& corners) {
  return corners[0] + ((corners[1] - corners[0]) + (corners[2] - corners[0])) / 3;
}

// [element] where nu depends on the place.
std::vector<Lame> constants_of(const Body& body, const std::vector<int>& number, const Elements& elements) {
  if (body.node_nu.empty()) return {};
  std::vector<double> nu(number.size());
  for (std::size_t i = 0; i < number.size(); ++i) nu[at(number[i])] = body.node_nu[i];
  std::vector<Lame> constants;
  for (const auto& [i, j, k] : elements.nodes)
    constants.push_back(lame_of(mean_of({nu[at(i)], nu[at(j)], nu[at(k)]}), body.numbers.state));
  return constants;
}

// Of the edges d1, d2 at rest.
ElementShape shape_of(const Vec2& d1, const Vec2& d2, double weight) {
  const double twice_area = cross(d1, d2);
  ElementShape shape{{d2.y() / twice_area, -d2.x() / twice_area, -d1.y() / twice_area, d1.x() / twice_area}, {}};
  for (std::size_t k = 0; k < shape.inverse.size(); ++k) shape.of_area[k] = weight * shape.inverse[k];
  return shape;
}

EdgeMetric metric_of(const Vec2& d1, const Vec2& d2, double weight) {
  const double twice_area = cross(d1, d2), share = weight / (twice_area * twice_area);
  return {share * d2.squaredNorm(), -share * d1.dot(d2), share * d1.squaredNorm(), 1 / twice_area, weight / twice_area};
}

RingShape ring_of(const Solid& solid, const std::array<int, 3>& nodes, double weight) {
  double radii = 0;
  for (const int node : nodes) radii += solid.points[at(node)].x();
  return {1 / radii, weight / radii};
}

// By rising number, those that move.
std::vector<std::array<int, 3>> moving_triangles(const Solid& solid) {
  std::vector<std::array<int, 3>> triangles;
  for (Triangle t : solid.cells) {
    std::sort(t.begin(), t.end());
    if (t[0] < solid.free) triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// Numbers the edges as they come.
void number_edges(Elements& elements) {
  std::map<std::array<int, 2>, int> known;
  for (const auto& [i, j, k] : elements.nodes) {
    std::array<int, 3>& edges = elements.edges.emplace_back();
    const std::array<std::array<int, 2>, 3> ends{{{i, j}, {i, k}, {j, k}}};
    for (std::size_t n = 0; n < ends.size(); ++n) {
      const auto [entry, fresh] = known.try_emplace(ends[n], static_cast<int>(elements.edge.size()));
      if (fresh) elements.edge.push_back(ends[n]);
      edges[n] = entry->second;
    }
  }
}

}  // namespace

Elements build_elements(const Body& body, const JoinedNodes& joined) {
  const Solid& solid = *joined.solid;
  if (solid.mass.uniform())
    throw FieldError("mass", "is for springs: nodes of elements weigh their shares of the area; give density");
  Elements elements;
  elements.law = solid_law(body.numbers.law, lame_of(body.numbers.nu, body.numbers.state));
  elements.nodes = moving_triangles(solid);
  elements.lame = constants_of(body, joined.number, elements);
  elements.first.assign(at(solid.nodes()) + 1, 0);
  const std::vector<double> moduli = moduli_of(body, joined.number);
  for (const auto& [i, j, k] : elements.nodes) {
    const Vec2 d1 = solid.points[at(j)] - solid.points[at(i)], d2 = solid.points[at(k)] - solid.points[at(i)];
    const double weight = measure_at_rest(solid, {i, j, k}) * ((moduli[at(i)] + moduli[at(j)] + moduli[at(k)]) / 3);
    elements.weight.push_back(weight);
    elements.shape.push_back(shape_of(d1, d2, weight));
    elements.metric.push_back(metric_of(d1, d2, weight));
    if (solid.axisymmetric) elements.ring.push_back(ring_of(solid, {i, j, k}, weight));
    ++elements.first[at(i) + 1];
  }
  for (std::size_t i = 0; i + 1 < elements.first.size(); ++i) elements.first[i + 1] += elements.first[i];
  number_edges(elements);
  if (solid.axisymmetric)
    for (const Vec2& p : solid.points) elements.off_axis.push_back(p.x() == 0 ? 0 : 1);
  return elements;
}

}  // namespace ricochet
