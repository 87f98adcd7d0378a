#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/field.hpp"
#include "render/context.hpp"

namespace ricochet::render {

/// What a picture shows. What is not switched on is not computed.
struct Show {
  static constexpr double automatic = std::numeric_limits<double>::quiet_NaN();
  std::string title;
  std::string material = "energy_density", springs = "plain";
  bool rims = true, anchors = true, forces = false, velocity = false, spin = false, trail = false, ghost = false,
       fronts = false;
  double magnify = 1;
  bool colour_bar = true, clock = true, ledger = false;
  std::string plot = "none";
  std::string colours = "auto", scale = "auto";
  double low = automatic, high = automatic;
  std::string camera = "fit";
  double width = automatic;
  std::string smoothing = "lines";

  static const std::vector<Member<Show>>& fields();
  /// Throws FieldError if two of them contradict each other.
  void check() const;
  Smoothing how_smooth() const;
};

/// A quantity that can be drawn.
struct Quantity {
  std::string name, label, unit, doc;
  bool is_signed = false;
};

std::span<const Quantity> material_quantities();
std::span<const Quantity> spring_quantities();
std::span<const Quantity> plot_quantities();

/// The quantity that the colours mean: of the material, or else of the springs; nullptr if nothing is coloured.
const Quantity* coloured_quantity(const Show& show);
/// The quantity of the live plot; nullptr without one.
const Quantity* plotted_quantity(const Show& show);

}  // namespace ricochet::render
