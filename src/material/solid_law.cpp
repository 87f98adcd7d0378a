#include "material/solid_law.hpp"

#include <algorithm>

namespace ricochet {

Lame lame_of(double nu, const std::string& state) {
  const double lambda = state == "plane_stress" ? nu / (1 - nu * nu) : nu / ((1 + nu) * (1 - 2 * nu));
  return {lambda, 1 / (2 * (1 + nu))};
}

const std::vector<std::string>& solid_law_names() {
  static const std::vector<std::string> names{"polynomial", "linear", "st_venant_kirchhoff"};
  return names;
}

SolidLawNumbers solid_law(const std::string& name, const Lame& lame) {
  const auto& names = solid_law_names();
  return {static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin()), lame};
}

std::vector<double> numbers_of(const SolidLawNumbers& law) {
  return {static_cast<double>(law.law), law.lame.lambda, law.lame.mu};
}

SolidLawNumbers solid_law_of(const std::vector<double>& numbers) {
  return {static_cast<int>(numbers.at(0)), {numbers.at(1), numbers.at(2)}};
}

}  // namespace ricochet
