#include "core/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>

namespace ricochet {
namespace {

/// Powers of mass, length and time.
using Powers = std::array<int, 3>;

// "c^2" -> c and 2; nothing if it is none of R, m0, c.
std::optional<Powers> powers_of_symbol(const std::string& word) {
  const std::size_t hat = word.find('^');
  const std::string symbol = word.substr(0, hat);
  const int power = hat == std::string::npos ? 1 : std::stoi(word.substr(hat + 1));
  if (symbol == "1") return Powers{};
  if (symbol == "m0") return Powers{power, 0, 0};
  if (symbol == "R") return Powers{0, power, 0};
  if (symbol == "c") return Powers{0, power, -power};
  return std::nullopt;
}

// Nothing if the unit is not of R, m0 and c, or empty.
std::optional<Powers> powers_of(const std::string& unit) {
  if (unit.empty()) return std::nullopt;
  Powers sum{};
  const std::size_t bar = unit.find('/');
  const std::array<std::string, 2> parts{unit.substr(0, bar), bar == std::string::npos ? "" : unit.substr(bar + 1)};
  for (const int part : {0, 1}) {
    std::istringstream words(parts[static_cast<std::size_t>(part)]);
    for (std::string word; words >> word;) {
      const auto powers = powers_of_symbol(word);
      if (!powers) return std::nullopt;
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += part == 0 ? (*powers)[k] : -(*powers)[k];
    }
  }
  return sum;
}

std::string si_name(const Powers& powers) {
  static const std::pair<Powers, const char*> names[] = {
      {{0, 0, 0}, ""},       {{0, 1, 0}, "m"},       {{1, 0, 0}, "kg"},   {{0, 0, 1}, "s"},
      {{0, 1, -1}, "m/s"},   {{0, 1, -2}, "m/s^2"},  {{0, 0, -1}, "1/s"}, {{0, -1, 0}, "1/m"},
      {{0, -2, 0}, "1/m^2"}, {{1, 2, -2}, "J"},      {{1, 1, -2}, "N"},   {{1, 1, -1}, "N s"},
      {{1, 0, -2}, "N/m"},   {{1, -2, 0}, "kg/m^2"}, {{1, -1, -2}, "Pa"}, {{1, 2, 0}, "kg m^2"}};
  for (const auto& [of, name] : names)
    if (of == powers) return name;
  return fmt::format("kg^{} m^{} s^{}", powers[0], powers[1], powers[2]);
}

struct Quantity {
  std::string number, unit;
  std::size_t end;
};

// The number with a unit of R, c and m0 that stands here in a sentence, if one does: "-1.5e-3 m0 c^2".
std::optional<Quantity> quantity_at(const std::string& sentence, std::size_t begin) {
  static constexpr std::array units{"m0 c^2/R^1", "m0 c^2/R^2", "m0 c^2/R^3", "m0 c^2/R", "m0 c^2",
                                    "R/c",        "c/R",        "R",          "c"};
  std::size_t at = begin;
  const auto is = [&](const char* any) { return at < sentence.size() && std::strchr(any, sentence[at]); };
  const auto digits = [&] {
    const std::size_t first = at;
    while (is("0123456789")) ++at;
    return at > first;
  };
  if (is("+-")) ++at;
  if (!digits()) return std::nullopt;
  if (is(".")) {
    ++at;
    digits();
  }
  if (is("e")) {
    ++at;
    if (is("+-")) ++at;
    if (!digits()) return std::nullopt;
  }
  const std::string number = sentence.substr(begin, at - begin);
  if (!is(" ")) return std::nullopt;
  for (const std::string unit : units) {
    const std::size_t end = at + 1 + unit.size();
    const unsigned char next = end < sentence.size() ? static_cast<unsigned char>(sentence[end]) : ' ';
    const bool longer = std::isalnum(next) || next == '_' || next == '^' || next == '/';
    if (!longer && sentence.compare(at + 1, unit.size(), unit) == 0) return Quantity{number, unit, end};
  }
  return std::nullopt;
}

// How many digits a number was told with, of at least 3: "0.0042" has 2.
int digits_of(const std::string& number) {
  const std::string mantissa = number.substr(0, number.find('e'));
  int digits = 0;
  for (const char c : mantissa) digits += std::isdigit(static_cast<unsigned char>(c)) && (digits > 0 || c != '0');
  return std::max(digits, 3);
}

}  // namespace

double Units::worth(const std::string& unit) const {
  const auto powers = si ? powers_of(unit) : std::nullopt;
  if (!powers) return 1;
  return std::pow(mass, (*powers)[0]) * std::pow(length, (*powers)[1]) * std::pow(time, (*powers)[2]);
}

std::string Units::name(const std::string& unit) const {
  const auto powers = si ? powers_of(unit) : std::nullopt;
  return powers ? si_name(*powers) : unit;
}

std::string Units::shown(double value, const std::string& unit, int digits) const {
  const std::string number = fmt::format("{:.{}g}", value * worth(unit), digits);
  return unit.empty() ? number : number + " " + name(unit);
}

std::string Units::explained(const std::string& sentence) const {
  if (!si) return sentence;
  std::string text;
  for (std::size_t at = 0; at < sentence.size();) {
    if (const auto found = quantity_at(sentence, at)) {
      text += shown(std::stod(found->number), found->unit, digits_of(found->number));
      at = found->end;
    } else {
      text += sentence[at++];
    }
  }
  return text;
}

}  // namespace ricochet
