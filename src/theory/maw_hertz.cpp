#include "theory/maw_hertz.hpp"

#include <algorithm>
#include <cmath>

namespace ricochet::theory {
namespace {

// Half of the row of springs, whose other half does the same; lengths in R, forces in E* R^2.
class Row {
 public:
  Row(double width, double tangential, double mu, std::size_t count)
      : each_(2 * width / static_cast<double>(count)), tangential_(tangential), mu_(mu), place_(count, 0.0) {
    for (std::size_t i = 0; i < count; ++i) {
      const double x = width * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
      profile_.push_back(x * x);
    }
  }

  // The surface moves on along itself.
  void drag(double by) {
    for (double& u : place_) u += by;
  }

  struct Force {
    double normal = 0, tangential = 0;
  };

  // At a depth z, normal springs of `share` of E*. What slips keeps what friction bears.
  Force press(double z, double share) {
    Force sum;
    for (std::size_t i = 0; i < profile_.size(); ++i) {
      const double normal = share * std::max(0.0, z - profile_[i]), most = mu_ * normal / tangential_;
      place_[i] = std::clamp(place_[i], -most, most);
      sum.normal += normal;
      sum.tangential -= tangential_ * place_[i];
    }
    return {each_ * sum.normal, each_ * sum.tangential};
  }

 private:
  double each_, tangential_, mu_;
  std::vector<double> place_, profile_;  // displacement along the surface; x^2
};

}  // namespace

Arguments<HertzianOblique> HertzianOblique::fields() {
  using S = HertzianOblique;
  return {{{"psi1", "number", "", "tangent of the incident angle, v_ct / v_cn", not_negative}, &S::psi1},
          {{"mu", "number", "", "coefficient of friction", not_negative}, &S::mu},
          {{"e", "number", "", "normal restitution coefficient", {0.05, 1}}, &S::e},
          {{"nu", "number", "", "Poisson's ratio of both", {-1, 0.5, true}}, &S::nu},
          {{"beta_x", "number", "", "1 + m R^2/I: 3.5 for a sphere", {2, 100}, "3.5"}, &S::beta_x},
          {{"springs", "number", "", "of half of the contact", {10, 1e5}, "1000"}, &S::springs}};
}

Arguments<HertzianRebound> HertzianRebound::fields() {
  using S = HertzianRebound;
  return {{{"beta", "number", "", "tangential restitution of the contact point; at psi1 = 0 the limit"}, &S::beta},
          {{"psi2", "number", "", "its tangential velocity after over the normal speed before"}, &S::psi2}};
}

HertzianRebound maw_hertz(const HertzianOblique& impact) {
  checked(impact);
  const double ratio = 2 * (1 - impact.nu) / (2 - impact.nu);  // 1/sigma^2
  // m v^2/2 = (8/15) z^{5/2}; a^2 = z.
  const double deepest = std::pow(15.0 / 16, 0.4);
  Row row(std::sqrt(deepest), ratio, impact.mu, static_cast<std::size_t>(impact.springs));
  const double step = 2.9432752 * deepest / (4 * impact.springs), half = step / 2;
  const double along = impact.psi1 > 0 ? impact.psi1 : 1e-9;  // beta at 0 is the limit
  double z = 0, v_z = 1, v_x = along;
  while (z >= 0) {
    z += half * v_z;
    row.drag(half * v_x);
    const Row::Force force = row.press(z, v_z > 0 ? 1 : impact.e * impact.e);
    v_z -= step * force.normal;
    v_x += step * impact.beta_x * force.tangential;
    z += half * v_z;
    row.drag(half * v_x);
  }
  return {-v_x / along, impact.psi1 > 0 ? v_x : 0};
}

}  // namespace ricochet::theory
