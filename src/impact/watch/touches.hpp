#pragma once
// When two bodies touch, read from the load of their contact at the ends of steps.

#include <limits>
#include <vector>

namespace ricochet {

/// The load of a contact at a time [R/c]: the sum of its normal forces over xi, which is the energy of its repulsion.
struct LoadSample {
  double time = 0, load = 0;
};

/// One touch: the time during which the load exceeds a share of its greatest in that touch.
struct TouchSpan {
  double greatest = 0;
  double end = std::numeric_limits<double>::quiet_NaN();  ///< [R/c]; undefined while it lasts
  std::vector<LoadSample> rise;                           ///< the loads that were greater than all before them
};

/// Follows the touches of one pair. Both ends of a touch and its greatest load are found between steps, by polynomials
/// through their neighbours in time whose error is of order 5 in the step.
class TouchClock {
 public:
  TouchClock() = default;
  /// Below a load of `floor` nothing touches; a touch ends when its load falls below `share` of its greatest.
  TouchClock(double floor, double share, double step) : floor_(floor), share_(share), step_(step) {}

  /// Whether the load at the end of a step counts, told from one near it in time: it does while it rises, at its
  /// greatest, and where it ends.
  bool wants(double nearby) const {
    if (!touching_) return nearby > floor_ / 100;
    return nearby >= 0.8 * touches_.back().greatest || nearby <= 30 * share_ * touches_.back().greatest;
  }
  /// Takes a load, later than all before. True if a touch has ended by it.
  bool follow(const LoadSample& now);

  bool touching() const { return touching_; }
  /// Of the touch that lasts, so far.
  double greatest() const { return touches_.back().greatest; }
  bool touched() const { return !touches_.empty(); }

  /// How many touches count: one whose greatest load is less than `share` of the impact's does not.
  int count() const;
  /// When the first that counts began. Undefined before.
  double begin() const;
  /// When the last touch began, once it has ended.
  double last_begin() const { return touches_.back().rise.front().time; }
  /// Whether the last one counts, so far.
  bool last_counts() const { return touched() && counts(touches_.back()); }
  /// When the last that counts ended. Undefined while one lasts.
  double end() const;
  /// From the first moment at which the load passed the floor to the last. Undefined before it is over.
  double time_above_floor() const { return below_ - above_; }

 private:
  bool counts(const TouchSpan& touch) const { return touch.greatest >= share_ * greatest_; }
  void pass_floor();
  void take_peak(TouchSpan& touch) const;

  double floor_ = 0, share_ = 0, step_ = 0;
  double greatest_ = 0;  // of all touches
  bool touching_ = false;
  std::vector<LoadSample> recent_;  // the last samples, of consecutive steps
  std::vector<TouchSpan> touches_;
  double above_ = std::numeric_limits<double>::quiet_NaN(), below_ = above_;  // when the load passed the floor
};

}  // namespace ricochet
