#pragma once
#include <span>
#include <string>
#include <vector>

namespace ricochet {

/// A symplectic composition: x += drift[0] h v; v += kick[0] h F/m; x += drift[1] h v; ... ; x += drift[last] h v.
/// Coefficients only; the one loop is in compose.hpp.
struct Method {
  std::string name;
  std::string source;
  int order;
  double stability_limit;  ///< largest h omega of a harmonic oscillator
  double usual;            ///< h omega of the default step
  std::vector<double> drift, kick;

  int evaluations() const { return static_cast<int>(kick.size()); }
};

std::span<const Method> methods();
std::vector<std::string> method_names();

/// Throws FieldError("method") for an unknown name.
const Method& method_named(const std::string& name);

}  // namespace ricochet
