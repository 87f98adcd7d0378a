#pragma once
// Every theory, with what it says, where it holds and where it comes from; called by name with named values.

#include <functional>
#include <map>
#include <span>

#include "theory/argument.hpp"

namespace ricochet::theory {

struct Theory {
  std::string name;
  std::string says;    ///< the formula in words or symbols
  std::string valid;   ///< where it holds
  std::string source;  ///< key in references.bib, and place
  std::string example;
  std::vector<Field> arguments, results;  ///< one result alone is the value itself
  /// The results in the order of `results`; an optional one that is undefined is NaN. Arguments left out take their
  /// defaults. Throws FieldError.
  std::function<std::vector<Value>(const std::map<std::string, Value>&)> evaluate;
};

std::span<const Theory> theories();

}  // namespace ricochet::theory
