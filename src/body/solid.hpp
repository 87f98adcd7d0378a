#pragma once
// What is built from a body's description: shared by the lanes, immutable. It holds nothing of one body's fate
// (stiffness, pose, name), so that equal bodies share it.

#include <array>
#include <memory>
#include <variant>
#include <vector>

#include "body/description.hpp"
#include "body/elements/elements.hpp"
#include "body/modal/modes.hpp"
#include "body/springs/springs.hpp"
#include "shape/surface.hpp"

namespace ricochet {

using Triangle = std::array<int, 3>;  ///< node numbers, counter-clockwise

/// The interior of a body that nothing moves inside of.
struct Rigid {};

/// What holds a body together. Who visits it: body/interior.hpp.
using Interior = std::variant<Springs, Elements, Modes, Rigid>;

/// Of the nodes. [m0]
class Masses {
 public:
  explicit Masses(double each = 1) : each_(each) {}
  /// Every node has its own.
  explicit Masses(std::vector<double> of) : of_(std::move(of)) {
    for (const double m : of_) inverse_.push_back(1 / m);
  }

  bool uniform() const { return of_.empty(); }
  double each() const { return each_; }  ///< if uniform
  double operator[](int node) const { return uniform() ? each_ : of_[static_cast<std::size_t>(node)]; }
  const std::vector<double>& of() const { return of_; }            ///< [node]; empty if uniform
  const std::vector<double>& inverse() const { return inverse_; }  ///< [node]; empty if uniform
  double lightest() const;

 private:
  double each_ = 1;
  std::vector<double> of_, inverse_;
};

/// Free nodes come first, then the held ones: loops over what moves never meet an anchor.
struct Solid {
  int dim = 2;
  Points points;                ///< [node] rest positions [R]
  int free = 0;                 ///< how many nodes move
  Masses mass;                  ///< of the nodes
  std::vector<Triangle> cells;  ///< what has a volume, and is drawn
  Surface surface = Mesh<2>{};  ///< what contact meets
  Points smooth;                ///< [surface node] where it lay before roughness
  std::vector<int> corners;     ///< places in the surface where the smooth outline has a corner
  Interior interior = Springs{};
  bool axisymmetric = false;  ///< a body of revolution about the axis x = 0, of which this is the half at x >= 0

  int nodes() const { return static_cast<int>(points.size()); }
  int free_coordinates() const { return dim * free; }
  int coordinates() const { return dim * nodes(); }
  /// A body that is held somewhere has no rigid motion.
  bool anchored() const { return free < nodes() || std::holds_alternative<Rigid>(interior); }
  double total_mass() const;
  Vec2 centre() const;     ///< of mass; of a plane, the point of it nearest to the origin
  double inertia() const;  ///< moment of inertia about the centre, of a turn in the plane, at rest [m0 R^2]
  /// Spin of an angular momentum, at rest.
  template <class Number>
  Number spin_of(const Number& momentum) const {
    return momentum / inertia();
  }
  const Springs* springs() const { return std::get_if<Springs>(&interior); }
  const Elements* elements() const { return std::get_if<Elements>(&interior); }
  const Modes* modes() const { return std::get_if<Modes>(&interior); }
  /// The same body as nodes that springs or elements join: that which modes are of, or itself.
  const Solid& joined() const { return modes() ? *modes()->of : *this; }
};

/// The area of a triangle of the solid at rest, or the volume of the ring that it is in a body of revolution, 2 pi
/// times the mean of its corners' x times its area. [Pappus; R^2 or R^3]
double measure_at_rest(const Solid& solid, const Triangle& triangle);

/// The share of a triangle at a corner: a third of its area; of a ring, the integral of 2 pi x times what is 1 at the
/// corner and 0 at the others, 2 pi A (3 X + x)/12, X: the mean of the corners' x. [R^2 or R^3]
double corner_share(const std::array<Vec2, 3>& corner, std::size_t k, bool axisymmetric);

/// Rest places of the surface's nodes, in their order.
Points surface_points(const Solid& solid);

/// The mean length of the surface's cells at rest. [R]
double mean_cell(const Solid& solid);

/// A pure function of the description.
std::shared_ptr<const Solid> build_solid(const Body& body);

}  // namespace ricochet
