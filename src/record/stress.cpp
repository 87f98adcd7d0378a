#include "record/stress.hpp"

#include <algorithm>

#include "body/elements/sweep.hpp"
#include "material/mean_stress.hpp"
#include "shape/closest.hpp"

namespace ricochet {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }
Lane<1> one(double value) { return Lane<1>::Constant(value); }

// What elements that have yielded remember; what flowed has done so.
Flow<1> flow_of(const BodyShot& shot) {
  Flow<1> flow;
  flow.yield = 1e300;
  for (const auto& [xx, xy, yy, zz, strain] : shot.plastic)
    flow.memory.push_back({one(xx), one(xy), one(yy), one(zz), one(strain)});
  return flow;
}

Tensor<double> alone(const Tensor<Lane<1>>& of) { return {of.xx[0], of.xy[0], of.yx[0], of.yy[0]}; }
AxialTensor<double> alone(const AxialTensor<Lane<1>>& of) { return {alone(of.plane), of.zz[0]}; }

// [node]
std::vector<MeanStress> stresses_of(const Motion<1>& body, const Elements& elements) {
  std::vector<MeanStress> sums(index(body.solid->nodes()));
  each_element(body, elements, [&](const auto& law, std::size_t e, const auto& F, const auto&) {
    const auto& [i, j, k] = elements.nodes[e];
    const auto edge = [&, first = i](int to) {
      return Vec2(body.solid->points[index(to)] - body.solid->points[index(first)]);
    };
    const auto now = [&, first = i](int to) { return Vec2(body.q.at(to, 0) - body.q.at(first, 0)); };
    const double rest = std::abs(cross(edge(j), edge(k))) / 2, area = std::abs(cross(now(j), now(k))) / 2;
    const double relative = elements.weight[e] / measure_at_rest(*body.solid, elements.nodes[e]);  // E of its place
    for (const int node : elements.nodes[e]) {
      sums[index(node)].area += area;
      sums[index(node)].add(alone(law.stress(F)), alone(F), relative * rest);
    }
  });
  return sums;
}

double depth_of(const Solid& solid, const Vec2& place) {
  const auto& mesh = std::get<Mesh<2>>(solid.surface);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : mesh.cell)
    least = std::min(
        least,
        closest(place, solid.points[index(mesh.node[index(a)])], solid.points[index(mesh.node[index(b)])]).distance);
  return least;
}

}  // namespace

GreatestStress greatest_stress(const Solid& of, double E, const BodyShot& shot) {
  const Solid& solid = of.joined();
  const Elements* elements = solid.elements();
  GreatestStress greatest;
  if (!elements || elements->nodes.empty()) return greatest;
  Motion<1> body = at_rest<1>(solid);
  for (int i = 0; i < solid.nodes(); ++i) body.q.set(i, 0, shot.place[index(i)]);
  body.stiffness = one(E);
  Flow<1> flow = flow_of(shot);
  if (!shot.plastic.empty()) body.flow = &flow;
  const std::vector<MeanStress> stresses = stresses_of(body, *elements);
  std::size_t most = 0;
  for (std::size_t i = 0; i < stresses.size(); ++i) {
    if (stresses[i].area == 0) continue;
    greatest.pressure = std::fmax(greatest.pressure, stresses[i].pressure(solid.axisymmetric));
    if (stresses[i].von_mises() > stresses[most].von_mises()) most = i;
  }
  greatest.von_mises = stresses[most].von_mises();
  greatest.von_mises_depth = depth_of(solid, solid.points[most]);
  return greatest;
}

}  // namespace ricochet
