#pragma once
#include <vector>

#include "core/frame.hpp"
#include "render/fields.hpp"
#include "render/show.hpp"

namespace ricochet::render {

/// What must be known of a whole sequence before its first picture is drawn, so that nothing jumps from one to the
/// next.
struct Survey {
  Vec2 low = Vec2::Constant(1e300), high = Vec2::Constant(-1e300);  ///< of all that is shown [R]
  double value_low = 0, value_high = 0;    ///< of the coloured quantity, but for the outermost thousandth
  double value_most = 0, value_least = 0;  ///< of all of it
  double target_most = 0;     ///< greatest value in the target, of a quantity of the material, without its sign
  double most_total = 0;      ///< greatest sum of the ledger's parts
  double most_energy = 0;     ///< that, with what effects owe at most
  double owed = 0;            ///< the least of its last part, if below 0
  bool effects = false;       ///< whether its last part ever counts
  Vec2 touch = Vec2::Zero();  ///< where the bodies first touched, as the frame nearest to it has it [R]
  double most_force = 0, most_speed = 0;
  Points trail;               ///< [frame] the projectile's centre
  std::vector<double> times;  ///< [frame]
  Points curve;               ///< time and plotted quantity, at every frame and between them where a run was sampled

  void see(const Show& show, const FrameMesh& mesh, const Fields& fields, const Frame& frame);
  /// The plotted quantity between two frames.
  void see_between(double time, double value) { curve.emplace_back(time, value); }

 private:
  double touch_missed_ = 1e300;  // by that frame [R/c]
  void see_surfaces(const FrameMesh& mesh, const Points& places);
};

/// Where every node is drawn: its place, or with the deformation magnified.
Points shown_places(const Show& show, const FrameMesh& mesh, const Frame& frame);

/// Values to colours.
struct Scale {
  double low = 0, high = 1;
  bool root = false;
  double most = 0, least = 0;  ///< of all values, which may lie outside

  double operator()(double value) const;  ///< 0 ... 1 within the limits
};

/// The limits of all surveyed sequences together, or those that the script gave.
/// `worth`: of one unit of the engine in the user's, of whom the ends low and high are.
Scale common_scale(const Show& show, const std::vector<const Survey*>& surveys, double worth);

}  // namespace ricochet::render
