#pragma once
// What options of the command line take.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

namespace ricochet {

/// A number of these. CLI::Range lets what is no number pass.
inline CLI::Validator within(double low, double high) {
  const auto mistake = [=](const std::string& text) -> std::string {
    double value = 0;
    const bool right = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
    return right ? "" : fmt::format("{} is no number of {:g} to {:g}", text, low, high);
  };
  return CLI::Validator(mistake, fmt::format("{:g} to {:g}", low, high));
}

/// The same of whole numbers.
inline CLI::Validator count_within(int low, int high) {
  const auto mistake = [=](const std::string& text) -> std::string {
    long long value = 0;
    const bool right = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
    return right ? "" : fmt::format("{} is no whole number of {} to {}", text, low, high);
  };
  return CLI::Validator(mistake, fmt::format("{} to {}", low, high));
}

}  // namespace ricochet
