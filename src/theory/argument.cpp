#include "theory/argument.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ricochet::theory {
namespace {

std::string accepted(const Range& r) {
  const bool low = r.min > any_number.min, high = r.max < any_number.max;
  const std::string from = low ? fmt::format("{} {:g}", r.min_open ? "greater than" : "at least", r.min) : "";
  const std::string to = high ? fmt::format("{} {:g}", r.max_open ? "less than" : "at most", r.max) : "";
  return from + (low && high ? " and " : "") + to;
}

void check_number(const Field& field, double value) {
  if (!std::isfinite(value)) throw FieldError(field.name, "must be a finite number");
  if (!field.range.contains(value))
    throw FieldError(field.name, fmt::format("must be {}, is {:g}", accepted(field.range), value));
}

}  // namespace

void check(const Field& field, const Value& value) {
  if (const double* number = std::get_if<double>(&value)) {
    if (!(field.optional && *number == without_bound)) check_number(field, *number);
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    if (std::find(field.choices.begin(), field.choices.end(), *text) == field.choices.end())
      throw FieldError(field.name, fmt::format("has no choice '{}'", *text));
  } else {
    const Numbers& list = std::get<Numbers>(value);
    if (list.empty() && !field.optional) throw FieldError(field.name, "must not be empty");
    for (const double element : list) check_number(field, element);
  }
}

}  // namespace ricochet::theory
