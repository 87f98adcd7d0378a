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
/// and for multirate methods:
///   fast(a, b, c)         the same for the projectile and the contact; x += c v for the target's rim
///   slow(a, b, c)         v += a F(x)/m of the target's springs; x += b v inside it, x += c v at its rim
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
    // The slow kick finds the target's rim at the end of the step.
    for (const Stage& stage : method.stages) {
      const bool last = &stage == &method.stages.back();
      system.fast(Number(stage.kick * h), Number(stage.drift * h), Number((last ? stage.drift - method.ahead_drift : stage.drift) * h));
    }
    system.slow(h, h, Number(method.ahead_drift * h));
    return;
  }
  for (const Stage& stage : method.stages) {
    if (stage.gradient != 0) system.displace(Number(stage.gradient * h * h));
    system.kick_and_drift(Number(stage.kick * h), Number(stage.drift * h));
    if (stage.gradient != 0) system.put_back();
  }
}

/// Takes a state at the beginning of a step to where a run stays: one kick (if the method begins with one) and one drift ahead;
/// the inside of a multirate method's target by half a kick and a whole drift.
template <class Number, class System>
void get_ahead(const Method& method, const Number& h, System&& system) {
  if (method.multirate()) {
    const Number ahead = method.ahead_drift * h, none = 0 * h;
    system.slow(Number(0.5 * h), Number(h - ahead), none), system.drift(ahead);
    return;
  }
  if (method.ahead_kick == 0) system.drift(Number(method.ahead_drift * h));
  else system.kick_and_drift(Number(method.ahead_kick * h), Number(method.ahead_drift * h));
}

}  // namespace ricochet
