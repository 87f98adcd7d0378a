#pragma once
// A smooth curve through points.

#include "theory/argument.hpp"

namespace ricochet::theory {

/// Values at `at` of the interpolating B-spline of degree 3 through (x, y), with averaged knots [de Boor 1978, A
/// Practical Guide to Splines, XIII]: twice continuously differentiable on any points. x rises, `at` lies within it.
/// Fewer than four points take the degree that they determine.
Numbers cubic_spline(const Numbers& x, const Numbers& y, const Numbers& at);

}  // namespace ricochet::theory
