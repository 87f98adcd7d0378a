#include "material/spring_law.hpp"

namespace ricochet {

std::vector<double> numbers_of(const SpringLawNumbers& law) {
  std::vector<double> numbers;
  for (const auto& [field, place] : SpringLawNumbers::fields()) numbers.push_back(law.*std::get<0>(place));
  return numbers;
}

SpringLawNumbers law_of(const std::vector<double>& numbers) {
  SpringLawNumbers law;
  const auto& fields = SpringLawNumbers::fields();
  for (std::size_t i = 0; i < fields.size() && i < numbers.size(); ++i) law.*std::get<0>(fields[i].place) = numbers[i];
  return law;
}

}  // namespace ricochet
