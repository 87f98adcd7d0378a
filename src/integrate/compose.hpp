#pragma once
#include "integrate/method.hpp"

namespace ricochet {

/// What a method moves:
///   kick_and_drift(a, b)  v += a F(x)/m; x += b v
///   drift(b)              x += b v
///   displace(a)           x += d, d = a F(x)/m; remembers d
///   put_back()            x -= d
/// and for Runge-Kutta methods
///   remember()            x0 = x, v0 = v
///   evaluate(i)           V_i = v, A_i = F(x)/m
///   combine(h, w)         x = x0 + h sum w_i V_i, v = v0 + h sum w_i A_i
/// and for multirate methods, F being that of the contact and the projectile's springs in the fast ones, of the
/// target's springs in slow():
///   displace_fast(a)      x += d, d = a F(x)/m, of the projectile and the target's rim; remembers d
///   put_back_fast()       x -= d
///   fast(a, b)            v += a F(x)/m; x += b v, of the same
///   displace_slow(a, g, k)  x += d of the target, d = g F(x)/m and k g times the contact's; the contact kicks by a
///   times what it gains when the
///                         target's rim is displaced by k g F(x)/m instead; remembers d
///   slow(a, b, c)         v += a F(x)/m, x -= d; x += b v inside the target, x += c v of the others

/// The slow kick of a multirate method with step h. Both levels are Takahashi & Imada's: with the force at x + h^2/12
/// F(x)/m each is conjugate to order 4. What the inner level is conjugate by does not commute with the slow force,
/// though; it leaves (h/n)^2/24 grad V_fast grad V_slow / m in the energy that the method keeps, which would be of
/// order 2. The last argument of displace_slow() takes it off.
template <class Number, class System>
void kick_slowly(const Method& method, const Number& h, const Number& kick, const Number& drift,
                 const Number& outer_drift, System&& system) {
  const double inner = method.stages.front().drift;
  system.displace_slow(kick, Number(h * h / 12), -inner * inner / 2);
  system.slow(kick, drift, outer_drift);
}

/// One step h of the composition, for a state that is ahead of the step's beginning (get_ahead).
template <class Number, class System>
void step(const Method& method, const Number& h, System&& system) {
  if (!method.symplectic()) {
    system.remember();
    for (std::size_t i = 0; i < method.tableau.b.size(); ++i) {
      if (i > 0) system.combine(h, method.tableau.a[i]);
      system.evaluate(i);
    }
    system.combine(h, method.tableau.b);
    return;
  }
  if (method.multirate()) {
    for (const Stage& stage : method.stages) {
      const bool last = &stage == &method.stages.back();  // to the end of the step
      system.displace_fast(Number(stage.gradient * h * h));
      system.fast(Number(stage.kick * h), Number((last ? stage.drift - method.ahead_drift : stage.drift) * h));
      system.put_back_fast();
    }
    kick_slowly(method, h, h, h, Number(method.ahead_drift * h), system);
    return;
  }
  for (const Stage& stage : method.stages) {
    if (stage.gradient != 0) system.displace(Number(stage.gradient * h * h));
    system.kick_and_drift(Number(stage.kick * h), Number(stage.drift * h));
    if (stage.gradient != 0) system.put_back();
  }
}

/// Takes a state at the beginning of a step to where a run stays: one kick (if the method begins with one) and one
/// drift ahead; the inside of a multirate method's target by half a kick and a whole drift.
template <class Number, class System>
void get_ahead(const Method& method, const Number& h, System&& system) {
  if (method.multirate()) {
    kick_slowly(method, h, Number(0.5 * h), h, Number(method.ahead_drift * h), system);
    return;
  }
  if (method.ahead_kick == 0)
    system.drift(Number(method.ahead_drift * h));
  else
    system.kick_and_drift(Number(method.ahead_kick * h), Number(method.ahead_drift * h));
}

}  // namespace ricochet
