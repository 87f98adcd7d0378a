#pragma once
// The laws that the elements of a solid may have. A new one is its header, and its name and its place here.

#include <concepts>
#include <string>
#include <utility>
#include <vector>

#include "material/polynomial.hpp"
#include "material/small_strain.hpp"
#include "material/st_venant_kirchhoff.hpp"

namespace ricochet {

/// Energy per area at rest, the first stress of Piola and Kirchhoff P = dW/dF, and its change by a change of F; per
/// volume in a body of revolution.
template <class L>
concept SolidLaw = requires(const L& law, const Tensor<double>& F, const AxialTensor<double>& G) {
  { law.energy(F) } -> std::convertible_to<double>;
  { law.stress(F) } -> std::same_as<Tensor<double>>;
  { law.tangent(F, F) } -> std::same_as<Tensor<double>>;
  { law.energy(G) } -> std::convertible_to<double>;
  { law.stress(G) } -> std::same_as<AxialTensor<double>>;
  { law.tangent(G, G) } -> std::same_as<AxialTensor<double>>;
};

static_assert(SolidLaw<Polynomial<double>> && SolidLaw<SmallStrain<double>> && SolidLaw<StVenantKirchhoff<double>>);

/// Lame's constants, of a plane or of space, per unit of Young's modulus E.
struct Lame {
  double lambda = 0, mu = 0;
};

/// mu = 1/(2 (1 + nu)); lambda = nu/(1 - nu^2) of a sheet that is free to bulge (plane_stress), nu/((1 + nu)(1 - 2 nu))
/// of a long cylinder (plane_strain) and of a body of revolution (axisymmetric), as of any body in space.
Lame lame_of(double nu, const std::string& state);

/// The law of a body's elements, per unit of E.
struct SolidLawNumbers {
  int law = 0;  ///< its place in solid_law_names()
  Lame lame;
};

/// polynomial, linear, st_venant_kirchhoff
const std::vector<std::string>& solid_law_names();
SolidLawNumbers solid_law(const std::string& name, const Lame& lame);

/// As a plain list, and back.
std::vector<double> numbers_of(const SolidLawNumbers& law);
SolidLawNumbers solid_law_of(const std::vector<double>& numbers);

/// Whether a rigid rotation leaves a body of this law without stress.
inline bool turns_freely(const SolidLawNumbers& numbers) { return numbers.law != 1; }

/// Calls `use(law)`, `E`: Young's modulus, of each lane or of one body; chosen once a sweep, never an element.
template <class Number, class Use>
decltype(auto) with_solid_law(const SolidLawNumbers& numbers, const Number& E, Use&& use) {
  const Number lambda = numbers.lame.lambda * E, mu = numbers.lame.mu * E;
  if (numbers.law == 1) return use(SmallStrain<Number>{lambda, mu});
  if (numbers.law == 2) return use(StVenantKirchhoff<Number>{lambda, mu});
  return use(Polynomial<Number>{lambda, mu});
}

}  // namespace ricochet
