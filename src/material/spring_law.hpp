#pragma once
// The laws that a spring may have. A new one is its header, and its numbers and its place here.

#include <array>
#include <concepts>
#include <utility>
#include <vector>

#include "core/field.hpp"
#include "material/linear.hpp"
#include "material/quartic.hpp"

namespace ricochet {

/// Energy, tension and its derivative at a stretch, per unit of the spring's stiffness.
template <class L>
concept SpringLaw = requires(const L& law, double stretch) {
  { law.energy(stretch) } -> std::convertible_to<double>;
  { law.tension(stretch) } -> std::convertible_to<double>;
  { law.tangent(stretch) } -> std::convertible_to<double>;
  { law.scale() } -> std::same_as<double>;
  { law.scaled_tension(stretch) } -> std::convertible_to<double>;
  { law.series() } -> std::same_as<std::array<double, 3>>;
};

static_assert(SpringLaw<Linear> && SpringLaw<Quartic>);

/// What chooses the law of a body's springs.
struct SpringLawNumbers {
  double quartic = 1e-3;

  static const std::vector<Member<SpringLawNumbers>>& fields() {
    static const std::vector<Member<SpringLawNumbers>> list{
        {{"quartic", "number", "1/R^2", "kb / ka; 0 makes the springs linear", not_negative, "0.001"},
         &SpringLawNumbers::quartic},
    };
    return list;
  }
};

/// The numbers of a law as a plain list, in the order of its fields, and back.
std::vector<double> numbers_of(const SpringLawNumbers& law);
SpringLawNumbers law_of(const std::vector<double>& numbers);

/// Calls `use(law)`: chosen once a sweep, never a spring.
template <class Use>
decltype(auto) with_spring_law(const SpringLawNumbers& numbers, Use&& use) {
  constexpr double least = 1e-100;  // below it 1 + quartic x^2 is 1 for any stretch, and 1 / quartic may overflow
  return numbers.quartic < least ? use(Linear{}) : use(Quartic{numbers.quartic});
}

}  // namespace ricochet
