#pragma once
#include <string>
#include <vector>

namespace ricochet {

/// A name in `over` of a long sweep, whose points are counted and not listed: its values, of numbers or of texts, and
/// after how many points the next one comes.
struct SweptAxis {
  std::string name, unit;
  std::size_t stride;
  std::vector<double> numbers;
  std::vector<std::string> texts;

  bool is_text() const { return numbers.empty(); }
  /// Which of its values a point has.
  std::size_t at(std::size_t point) const { return point / stride % (is_text() ? texts.size() : numbers.size()); }
};

/// "psi1 = 2, sample = 7" for messages.
std::string place_of(const std::vector<SweptAxis>& axes, std::size_t point);

}  // namespace ricochet
