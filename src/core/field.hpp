#pragma once
// What a quantity is to its user: name, unit, range and meaning. From one list of fields come the reading of a script's
// table, the messages, `--help`, the editor stubs, the reference page, the file attributes and the CSV header.

#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace ricochet {

/// Accepted values of a number. An open end excludes its bound.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_open = false;
  bool max_open = false;

  bool contains(double value) const {
    return (min_open ? value > min : value >= min) && (max_open ? value < max : value <= max);
  }
};

inline constexpr Range any_number{};
inline constexpr Range positive{0, std::numeric_limits<double>::infinity(), true};
inline constexpr Range not_negative{0};

/// The value of a number that a script may leave out, and did.
inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// As `initial` of a field of a plain struct: what a default-made one holds.
inline constexpr const char* by_struct = "=";

struct Field {
  std::string name;
  std::string type;  ///< "number", "integer", "boolean", "string", or what the script layer's reference calls it
  std::string unit;  ///< in R, m0, c; empty for a pure number
  std::string doc;
  Range range = any_number;
  std::string initial;               ///< default, as text; empty if the field must be given (or `optional`)
  bool optional = false;             ///< may be absent without a default
  std::vector<std::string> choices;  ///< accepted strings, if type is "string" and only some are
};

/// A field and where its value lives in a plain struct.
template <class Struct>
struct Member {
  Field field;
  std::variant<double Struct::*, int Struct::*, std::int64_t Struct::*, bool Struct::*, std::string Struct::*> place;
};

}  // namespace ricochet
