#include "material/material.hpp"

namespace ricochet {

const std::vector<Member<Material>>& Material::fields() {
  static const std::vector<Member<Material>> list{
      {{"E", "number", "Pa", "Young's modulus", positive}, &Material::E},
      {{"nu", "number", "", "Poisson's ratio", {-1, 0.5, true, true}}, &Material::nu},
      {{"density", "number", "kg/m^3", "mass of the volume", positive}, &Material::density},
      {{"yield", "number", "Pa", "yield stress; data: only an effect that uses it lets anything yield", positive, "",
        true},
       &Material::yield},
      {{"hardening", "number", "Pa", "rise of the yield stress with the plastic strain; data as `yield`", not_negative,
        "", true},
       &Material::hardening},
      {{"source", "string", "", "where a reader can look the numbers up", any_number, "", true}, &Material::source},
  };
  return list;
}

PlaneMaterial in_plane(const Material& m, const std::string& state, double thickness) {
  const bool strain = state != "plane_stress";
  const double E = strain ? m.E / (1 - m.nu * m.nu) : m.E, nu = strain ? m.nu / (1 - m.nu) : m.nu;
  return {E * thickness, nu, m.density * thickness, m.yield * thickness, m.hardening * thickness, thickness};
}

Material in_space(const PlaneMaterial& m, const std::string& state) {
  const double nu = state != "plane_stress" ? m.nu / (1 + m.nu) : m.nu;
  const double E = state != "plane_stress" ? m.E * (1 - nu * nu) : m.E;
  return {.E = E / m.thickness, .nu = nu, .density = m.density / m.thickness};
}

}  // namespace ricochet
