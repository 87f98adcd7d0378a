#pragma once
#include <string>
#include <vector>

#include "store/table.hpp"

namespace ricochet {

/// The sweep's own parameters, by name; numbers are NaN and texts empty where the other kind was given.
struct Parameters {
  std::vector<std::string> names, units;        // [parameter]; the user's word for the unit, or none
  std::vector<std::vector<double>> numbers;     // [parameter][scene]
  std::vector<std::vector<std::string>> texts;  // [parameter][scene]; empty if the parameter is numeric

  /// "psi1 = 2, sample = 7" for messages.
  std::string place(std::size_t scene) const;

  /// Of these scenes alone.
  Parameters of(const std::vector<std::size_t>& scenes) const;

  /// Puts their columns before all others of a table of these scenes' rows.
  void add_to(Table& table, const std::vector<std::size_t>& scenes) const;
};

}  // namespace ricochet
