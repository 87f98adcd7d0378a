#include "theory/maw.hpp"

#include <cmath>
#include <numbers>

namespace ricochet::theory {
namespace {

using std::numbers::pi;
constexpr double absent = std::numeric_limits<double>::quiet_NaN();

// In units where Omega, the normal speed and m are 1: forces and velocities of one contact, closed forms of each phase.
struct Course {
  double b, sigma2, omega, mu, e, t0 = pi / 2, end;
  double t = 0, u = 0,
         v;         // since the last change; u: stretch of the tangential spring, v: velocity of the contact point
  double sign = 1;  // of the sliding

  explicit Course(const Bilinear& impact)
      : b(impact.beta_x),
        sigma2(impact.sigma2()),
        omega(std::sqrt(b / sigma2)),
        mu(impact.mu),
        e(impact.e),
        end(t0 * (1 + e)),
        v(impact.psi1) {}

  double tau(double at) const { return at <= t0 ? at : t0 + (at - t0) / e; }
  double normal(double at) const { return std::sin(tau(at)); }
  double normal_rate(double at) const { return at <= t0 ? std::cos(at) : std::cos(tau(at)) / e; }
  /// Impulse of the normal force until then; what is left of it, 2 e cos^2(tau/2) in restitution, without cancellation
  /// near the end.
  double impulse(double at) const {
    return at <= t0 ? 2 * std::pow(std::sin(at / 2), 2) : 1 + e - 2 * e * std::pow(std::cos(tau(at) / 2), 2);
  }

  // Sticking: u'' = -omega^2 u.
  double stuck_u(double at) const { return u * std::cos(omega * (at - t)) + v / omega * std::sin(omega * (at - t)); }
  double stuck_v(double at) const { return v * std::cos(omega * (at - t)) - omega * u * std::sin(omega * (at - t)); }
  double friction_left(double at) const { return sigma2 * mu * normal(at) - std::abs(stuck_u(at)); }
  // Sliding: u = sign sigma^2 mu F_z, v' = -sign b mu F_z.
  double sliding_v(double at) const { return v - sign * b * mu * (impulse(at) - impulse(t)); }
  double sliding_speed(double at) const { return sign * sliding_v(at) - sigma2 * mu * normal_rate(at); }

  void stick_until(double at) {
    const double stretch = stuck_u(at);
    v = stuck_v(at);
    u = stretch;
    t = at;
    sign = u < 0 ? -1 : 1;
  }
  void slide_until(double at) {
    v = sliding_v(at);
    u = sign * sigma2 * mu * normal(at);
    t = at;
  }

  // The first time after now at which the function, not negative now, is so no longer; `end` if it stays. Compression
  // and restitution apart: its slope may jump between them.
  template <class F>
  double first_negative(const F& f) const {
    constexpr int parts = 400;
    double last = t;
    for (const auto& [from, to] : {std::pair{t, std::max(t, t0)}, std::pair{std::max(t, t0), end}})
      for (int i = 1; i <= parts && to > from; ++i) {
        const double next = i == parts ? to : from + (to - from) * i / parts;
        if (f(next) < 0) return f(last) > 0 ? root_between(f, last, next) : last;
        last = next;
      }
    return end;
  }
};

}  // namespace

double Bilinear::slip_bound() const { return mu * std::max(beta_x, beta_x * (1 + e) - sigma2() / e); }

Arguments<Bilinear> Bilinear::fields() {
  return {{{"psi1", "number", "", "tangent of the incident angle, v_ct/v_n", not_negative}, &Bilinear::psi1},
          {{"mu", "number", "", "coefficient of friction", not_negative}, &Bilinear::mu},
          {{"e", "number", "", "normal restitution coefficient", {0.01, 2}}, &Bilinear::e},
          {{"nu",
            "number",
            "",
            "Poisson's ratio of spheres; 0 for disks, whose contact is as stiff along the surface as across",
            {0, 0.5}},
           &Bilinear::nu},
          {{"beta_x", "number", "", "1 + m R^2/I: 3 for a disk, 3.5 for a sphere", {2, 100}, "3"}, &Bilinear::beta_x}};
}

Arguments<BilinearRebound> BilinearRebound::fields() {
  using S = BilinearRebound;
  return {
      {{"beta", "number", "", "tangential restitution of the contact point, -v_ct'/v_ct"}, &S::beta},
      {{"psi2", "number", "", "v_ct' over the normal speed before, -beta psi1"}, &S::psi2},
      {{"regime", "integer", "", "1: sticks at first, 2: slides, sticks and slides, 3: slides all along"}, &S::regime},
      {{"t1", "number", "", "end of the first sticking, in compression times; in regime 1", any_number, "", true},
       &S::t1},
      {{"t2", "number", "", "begin of sticking; in regime 2", any_number, "", true}, &S::t2},
      {{"t3", "number", "", "end of that sticking; in regime 2", any_number, "", true}, &S::t3}};
}

BilinearRebound maw(const Bilinear& impact) {
  checked(impact);
  BilinearRebound result{0, 0, 0, absent, absent, absent};
  Course course(impact);
  if (impact.psi1 == 0) {
    result.regime = 1;
    result.t1 = 1 + impact.e;
    result.beta = -std::cos(course.omega * course.end);
    return result;
  }
  result.regime = impact.psi1 < impact.stick_bound() ? 1 : impact.psi1 <= impact.slip_bound() ? 2 : 3;
  if (result.regime == 3) {
    course.slide_until(course.end);
  } else {
    bool sticking = result.regime == 1;
    double last = -1;
    // Where the speed of sliding falls to 0 again the contact sticks once more: the phases go on until the end. Within
    // 1e-4 of it (in tau) friction can change no more than mu beta_x e 1e-8/2, and what decides between sticking and
    // sliding drowns in rounding: it slides.
    for (int phase = 0; course.t < course.end; ++phase, sticking = !sticking) {
      if (course.tau(course.end) - course.tau(course.t) < 1e-4) {
        sticking = false;
        course.slide_until(course.end);
      }
      if (course.t == course.end) break;
      const double until = sticking ? course.first_negative([&](double at) { return course.friction_left(at); })
                                    : course.first_negative([&](double at) { return course.sliding_speed(at); });
      // Neither sticks nor slides by more than rounding: both are the same for a while, and sliding is taken.
      const bool undecided = until == course.t && phase > 0 && course.t == last;
      last = course.t;
      if (undecided) {
        sticking = false;
        course.slide_until(course.t + (course.end - course.t) / 20);
      } else
        sticking ? course.stick_until(until) : course.slide_until(until);
      if (result.regime == 1 && phase == 0) result.t1 = until / course.t0;
      if (result.regime == 2 && phase == 0) result.t2 = until / course.t0;
      if (result.regime == 2 && phase == 1) result.t3 = until / course.t0;
      if (phase > 1000) throw std::logic_error("maw: the contact sticks and slides without end");
    }
  }
  result.psi2 = course.v;
  result.beta = -course.v / impact.psi1;
  return result;
}

Arguments<BilinearSteps> BilinearSteps::fields() {
  Arguments<BilinearSteps> list;
  for (const auto& a : Bilinear::fields()) list.push_back({a.field, std::get<double Bilinear::*>(a.place)});
  list.front().field.range = positive;  // without tangential speed there is no beta to measure
  list.push_back(
      {{"steps", "integer", "", "time steps in one compression time", {100, 1e7}, "20000"}, &BilinearSteps::steps});
  return list;
}

Arguments<IntegratedRebound> IntegratedRebound::fields() {
  using S = IntegratedRebound;
  return {{{"beta", "number", "", "tangential restitution of the contact point"}, &S::beta},
          {{"psi2", "number", "", "v_ct' over the normal speed before"}, &S::psi2}};
}

IntegratedRebound maw_integrated(const BilinearSteps& impact) {
  checked(impact);
  // m = k = v_n = 1. z: approach; the unloading line starts from the deepest point with stiffness 1/e^2 and reaches
  // force 0 with approach left over.
  const double dt = pi / 2 / impact.steps, e2 = impact.e * impact.e, sigma2 = impact.sigma2();
  double z = 0, vz = 1, deepest = 0, u = 0, v = impact.psi1, force = 0;
  for (;;) {
    vz -= 0.5 * dt * force;
    v -= 0.5 * dt * impact.beta_x * u / sigma2;  // half a kick, drift, half a kick
    z += dt * vz;
    deepest = std::max(deepest, z);
    force = vz >= 0 ? z : deepest - (deepest - z) / e2;
    if (force <= 0) return {-v / impact.psi1, v};
    // The spring stretches with the contact point as far as friction lets it; beyond that the slider gives way.
    const double most = sigma2 * impact.mu * force;
    u = std::clamp(u + dt * v, -most, most);
    vz -= 0.5 * dt * force;
    v -= 0.5 * dt * impact.beta_x * u / sigma2;
  }
}

}  // namespace ricochet::theory
