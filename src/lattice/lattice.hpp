#pragma once
// A body: what it is (description) and what is built from it (lattice).

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/field.hpp"
#include "core/vec2.hpp"
#include "lattice/placement.hpp"
#include "lattice/triangulate.hpp"

namespace ricochet {

/// The numbers that describe a body; a random mass-spring lattice in a closed outline. Units: R, m0, c.
struct BodyNumbers {
  int nodes = 800;
  std::string placement = "uniform";
  std::int64_t seed = 1;
  double stiffness = 1e4;
  double quartic = 1e-3;
  double mass = 1;
  double roughness = 0;
  double prestress = 0;

  static const std::vector<Member<BodyNumbers>>& fields();
};

/// Nodes before they are joined: rim first, in order, counter-clockwise.
struct NodePlan {
  Points points;
  int rim = 0;
  Points smooth_rim;  ///< the rim's points before roughness
};

/// A body as a script describes it. `anchored` and `node_stiffness` hold what the script's functions said of each
/// planned node, evaluated once; empty where no function was given.
struct Body {
  Points outline;  ///< simple, counter-clockwise
  BodyNumbers numbers;
  std::vector<bool> anchored;          ///< [plan node]
  std::vector<double> node_stiffness;  ///< [plan node], in m0 c^2 / R^2

  /// Everything that fixes the lattice except the stiffness number, which only scales it: bodies of equal geometry
  /// share one lattice.
  std::string geometry_text() const;
};

/// Rim and interior points. Anchored rim nodes (by `anchored_rim`, in rim order; may be empty) stay smooth. Throws if
/// the outline or the rough rim crosses itself, or if the outline needs more points than the body has nodes.
NodePlan plan_nodes(const Points& outline, const BodyNumbers& numbers, const std::vector<bool>& anchored_rim);

/// The rim's points before roughness, which say where a body's outline lies and which rim nodes an anchor predicate
/// holds.
Points plan_rim(const Points& outline, const BodyNumbers& numbers);

struct Spring {
  int node, other;   ///< its ends; the first holds it and is the smaller
  bool on_rim;       ///< joins neighbours in the rim
  double length;     ///< rest length: the distance of its ends at rest, but for prestress [R]
  double stiffness;  ///< relative to the body's stiffness
};

/// Springs, read like a vector of Spring, kept as one array a quantity: a loop over one impact alone takes several at
/// once.
class Springs {
 public:
  void push_back(const Spring& s) {
    ends_.push_back({s.node, s.other});
    on_rim_.push_back(s.on_rim);
    length_.push_back(s.length);
    stiffness_.push_back(s.stiffness);
  }
  Spring operator[](std::size_t s) const { return {ends_[s][0], ends_[s][1], on_rim_[s], length_[s], stiffness_[s]}; }
  std::size_t size() const { return ends_.size(); }
  void set_length(std::size_t s, double length) { length_[s] = length; }

  const std::array<int, 2>* ends() const { return ends_.data(); }  ///< [spring] node, other
  const double* length() const { return length_.data(); }          ///< [spring]
  const double* stiffness() const { return stiffness_.data(); }    ///< [spring]

 private:
  std::vector<std::array<int, 2>> ends_;
  std::vector<bool> on_rim_;
  std::vector<double> length_, stiffness_;
};

/// Nodes joined by springs. Free nodes come first, in reverse Cuthill-McKee order, then the anchored ones: loops over
/// what moves never meet an anchor. Springs are a half list: those of node i to larger numbers are spring[first[i]] ...
/// spring[first[i+1]-1]. Springs between two anchored nodes, which never stretch, are left out of the half list but
/// kept in `edges`.
struct Lattice {
  Points points;           ///< [node] rest positions [R]
  int free = 0;            ///< how many nodes move
  std::vector<int> first;  ///< [node + 1] first spring of a node
  Springs spring;
  std::vector<std::array<int, 2>> edges;  ///< every spring's two ends, for drawing and files
  std::vector<Triangle> triangles;
  std::vector<int> rim;  ///< the outline's nodes in order, counter-clockwise, closed
  Points smooth_rim;     ///< [rim] where they lay before roughness
  double mass = 1;       ///< of a node [m0]
  bool uniform = true;   ///< every spring has the body's stiffness
  double quartic = 0;    ///< kb / ka [1/R^2]
  double rest_energy =
      0;  ///< of the springs at rest, which prestress alone gives, per unit of the body's stiffness [R^2]

  int nodes() const { return static_cast<int>(points.size()); }
  bool anchored() const { return free < nodes(); }
  double total_mass() const { return mass * nodes(); }
  Vec2 centre() const;
  double inertia() const;  ///< moment of inertia about the centre, at rest [m0 R^2]
};

/// Builds the lattice of a body; a pure function of the description.
std::shared_ptr<const Lattice> build_lattice(const Body& body);

}  // namespace ricochet
