#pragma once
#include <cstddef>
#include <vector>

namespace ricochet {

/// What one impact remembers in a lane, on its way to a lane of another width: the same code writes it and reads it.
class Carrier {
 public:
  /// From now on passes out what came in, in the same order.
  void turn_round() { reading_ = true; }
  void pass(double& value) {
    if (reading_)
      value = values_[next_++];
    else
      values_.push_back(value);
  }
  template <class Whole>
  void pass_whole(Whole& value) {
    double number = static_cast<double>(value);
    pass(number);
    value = static_cast<Whole>(number);
  }

 private:
  std::vector<double> values_;
  std::size_t next_ = 0;
  bool reading_ = false;
};

}  // namespace ricochet
