#pragma once
// What a theory takes and gives: plain structs whose numbers are listed once, with meaning, units and valid range. From
// that list come the check of every call, the script layer's tables and messages, the reference page, and the test that
// results keep their dimensions.

#include <initializer_list>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/field.hpp"

namespace ricochet::theory {

using Numbers = std::vector<double>;
using Value = std::variant<double, Numbers, std::string>;

/// A second body that is left out is a plane (R2), rigid (E2) or immovable (m2): infinitely large.
inline constexpr double without_bound = std::numeric_limits<double>::infinity();

/// A field and where its value lives. Units are powers of M, L and T ("M L^-1 T^-2"): any consistent system will do.
template <class Struct>
struct Argument {
  Field field;
  std::variant<double Struct::*, Numbers Struct::*, std::string Struct::*> place;
};

template <class Struct>
using Arguments = std::vector<Argument<Struct>>;

template <class Struct>
Arguments<Struct> joined(std::initializer_list<Arguments<Struct>> lists) {
  Arguments<Struct> whole;
  for (const auto& list : lists) whole.insert(whole.end(), list.begin(), list.end());
  return whole;
}

/// Throws FieldError if the value is not finite (an optional one may be left out), out of range or no choice.
void check(const Field& field, const Value& value);

/// The arguments themselves, each within its range; else FieldError. Every theory begins with it.
template <class Struct>
const Struct& checked(const Struct& arguments) {
  for (const Argument<Struct>& a : Struct::fields())
    std::visit([&](auto place) { check(a.field, Value(arguments.*place)); }, a.place);
  return arguments;
}

/// 1 / (1/a + 1/b), for a body beside another that may be without bound.
inline double parallel(double a, double b) { return 1 / (1 / a + 1 / b); }

/// The root of a function that changes sign between low and high, to the last digits. Throws std::logic_error if it
/// does not.
template <class F>
double root_between(const F& f, double low, double high);

}  // namespace ricochet::theory

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>
#include <stdexcept>

template <class F>
double ricochet::theory::root_between(const F& f, double low, double high) {
  const double at_low = f(low), at_high = f(high);
  if (at_low == 0) return low;
  if (at_high == 0) return high;
  if ((at_low > 0) == (at_high > 0)) throw std::logic_error("root_between: no change of sign");
  std::uintmax_t most = 200;
  const auto [a, b] = boost::math::tools::toms748_solve(f, low, high, at_low, at_high,
                                                        boost::math::tools::eps_tolerance<double>(52), most);
  return 0.5 * (a + b);
}
