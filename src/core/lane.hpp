#pragma once
// A lane is one of W impacts that advance together; a Lane<W> holds one quantity of all of them and is written like a
// number. Every operation on it is element by element and IEEE exact or correctly rounded, so an impact has the same
// bits alone (W = 1) and in any batch.

#include <Eigen/Core>

namespace ricochet {

template <int W>
using Lane = Eigen::Array<double, W, 1>;

/// W, chosen when the project is configured. 4 doubles fill an AVX2 register.
inline constexpr int lanes = RICOCHET_LANES;
#ifdef EIGEN_VECTORIZE_AVX512
static_assert(
    lanes < 8,
    "Eigen 3.4 estimates the square root of eight numbers on AVX-512, in other bits; configure with RICOCHET_LANES=4");
#endif

}  // namespace ricochet
