#pragma once
#include "integrate/method.hpp"

namespace ricochet {

/// The first drift of a run. A run then stays `drift[0]` of a step ahead in its positions: the last drift of a step and the
/// first of the next are one, so a step costs nothing beside its force evaluations. `at_step_end` takes it back to look.
template <class Number>
Number first_drift(const Method& method, const Number& h) { return method.drift.front() * h; }

/// One step h of the composition for a state that is first_drift ahead. `kick_and_drift(a, b)` must do v += a F(x)/m, x += b v.
template <class Number, class KickAndDrift>
void step(const Method& method, const Number& h, KickAndDrift&& kick_and_drift) {
  const int n = method.evaluations();
  for (int i = 0; i < n; ++i) {
    const double drift = i + 1 < n ? method.drift[i + 1] : method.drift.back() + method.drift.front();
    kick_and_drift(Number(method.kick[i] * h), Number(drift * h));
  }
}

}  // namespace ricochet
