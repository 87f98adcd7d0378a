#include "record/whole_section.hpp"

#include <algorithm>

namespace ricochet {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// The nodes of one body among vectors that lie flat, and behind them their mirror images; all times `share`.
template <class Number>
void append_both(std::vector<Number>& all, const std::vector<Number>& of_halves, const BodyMesh& body, Number share) {
  const auto first = of_halves.begin() + 2 * body.first, last = first + 2 * body.nodes;
  if (!body.axisymmetric) {
    all.insert(all.end(), first, last);
    return;
  }
  for (const Number side : {Number(1), Number(-1)})
    for (auto x = first; x != last; x += 2) {
      all.push_back(share * side * x[0]);
      all.push_back(share * x[1]);
    }
}

template <class Number>
std::vector<Number> both(const FrameMesh& halves, const std::vector<Number>& vectors, Number share = 1) {
  std::vector<Number> all;
  for (const BodyMesh& body : halves.bodies) append_both(all, vectors, body, share);
  return all;
}

MeshChain moved(MeshChain chain, int by) {
  for (int& node : chain.node) node += by;
  return chain;
}

// An open chain and its image are one closed chain; images run backwards, so that their inside lies to the left.
std::vector<MeshChain> with_image(const std::vector<MeshChain>& chains, int nodes) {
  std::vector<MeshChain> all;
  for (const MeshChain& chain : chains) {
    MeshChain image = moved(chain, nodes);
    std::reverse(image.node.begin(), image.node.end());
    all.push_back(chain);
    if (chain.closed) {
      all.push_back(image);
      continue;
    }
    all.back().node.insert(all.back().node.end(), image.node.begin(), image.node.end());
    all.back().closed = true;
  }
  return all;
}

void add_body(FrameMesh& whole, const FrameMesh& halves, const BodyMesh& half) {
  BodyMesh body = half;
  body.first = whole.nodes();
  const int sides = half.axisymmetric ? 2 : 1, by = body.first - half.first;
  body.nodes = sides * half.nodes;
  for (int side = 0; side < sides; ++side)
    for (int i = half.first; i < half.first + half.nodes; ++i) {
      whole.mass.push_back(halves.mass[at(i)] / sides);
      whole.anchored.push_back(halves.anchored[at(i)]);
    }
  for (MeshChain& chain : body.surface) chain = moved(chain, by);
  if (half.axisymmetric) body.surface = with_image(body.surface, half.nodes);
  for (int side = 0; side < sides; ++side)
    for (std::size_t t = 0; t < halves.triangles.size(); ++t) {
      std::array<int, 3> corners = halves.triangles[t];
      if (corners[0] < half.first || corners[0] >= half.first + half.nodes) continue;
      for (int& corner : corners) corner += by + side * half.nodes;
      if (side == 1) std::swap(corners[1], corners[2]);
      whole.triangles.push_back(corners);
      if (!halves.modulus.empty()) whole.modulus.push_back(halves.modulus[t]);
      for (std::size_t k = 2 * t; k < 2 * t + 2 && !halves.lame.empty(); ++k) whole.lame.push_back(halves.lame[k]);
    }
  whole.bodies.push_back(body);
}

// Triangles in the order of add_body(); in an image the shear has the other sign.
std::vector<float> plastic_of_both(const FrameMesh& halves, const std::vector<float>& plastic) {
  std::vector<float> all;
  for (const BodyMesh& half : halves.bodies)
    for (const float side : {1.0f, -1.0f}) {
      if (side < 0 && !half.axisymmetric) continue;
      for (std::size_t t = 0; t < halves.triangles.size() && !plastic.empty(); ++t) {
        const int corner = halves.triangles[t][0];
        if (corner < half.first || corner >= half.first + half.nodes) continue;
        for (std::size_t k = 0; k < 5; ++k) all.push_back((k == 1 ? side : 1.0f) * plastic[5 * t + k]);
      }
    }
  return all;
}

bool any_half(const FrameMesh& mesh) {
  return std::any_of(mesh.bodies.begin(), mesh.bodies.end(), [](const BodyMesh& body) { return body.axisymmetric; });
}

}  // namespace

FrameMesh whole_section(const FrameMesh& halves) {
  if (!any_half(halves)) return halves;
  FrameMesh whole;  // without springs, which a body of revolution has none of, and meets none of
  whole.dim = halves.dim;
  whole.units = halves.units;
  whole.psi1 = halves.psi1;
  whole.first_touch = halves.first_touch;
  whole.effects = halves.effects;
  whole.rest = both(halves, halves.rest);
  for (const BodyMesh& half : halves.bodies) add_body(whole, halves, half);
  return whole;
}

Frame whole_section(const FrameMesh& halves, const Frame& frame) {
  if (!any_half(halves)) return frame;
  Frame whole = frame;
  whole.position = both(halves, frame.position);
  whole.velocity = both(halves, frame.velocity);
  whole.contact_force = both(halves, frame.contact_force, 0.5f);
  whole.plastic = plastic_of_both(halves, frame.plastic);
  return whole;
}

}  // namespace ricochet
