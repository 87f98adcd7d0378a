#pragma once
// The stress of a place between elements: the mean of theirs by area.

#include <algorithm>
#include <cmath>

#include "material/tensor.hpp"

namespace ricochet {

/// Cauchy's stress times the area that it acts in, summed over the elements at a place.
struct MeanStress {
  double xx = 0, xy = 0, yy = 0, zz = 0, area = 0;

  /// An element of the first stress of Piola and Kirchhoff P = dW/dF and of `rest` area at rest: A/J P F^T. A ring's
  /// area in the plane changes as J/F_zz does.
  void add(const Tensor<double>& P, const Tensor<double>& F, double rest) {
    xx += rest * (P.xx * F.xx + P.xy * F.xy);
    xy += rest * (P.xx * F.yx + P.xy * F.yy);
    yy += rest * (P.yx * F.yx + P.yy * F.yy);
  }
  void add(const AxialTensor<double>& P, const AxialTensor<double>& F, double rest) {
    add(P.plane, F.plane, rest / F.zz);
    zz += rest * P.zz;
  }

  /// Minus the mean of the normal stresses, of three in `space` and of two in the plane.
  double pressure(bool space) const { return area == 0 ? 0 : -(xx + yy + zz) / ((space ? 3 : 2) * area); }

  /// sqrt(3/2) times the deviator's norm; of a stress in the plane, that of the plane.
  double von_mises() const {
    const double square = xx * xx - xx * yy + yy * yy + 3 * xy * xy + zz * (zz - xx - yy);
    return area == 0 ? 0 : std::sqrt(std::max(0.0, square)) / area;
  }
};

}  // namespace ricochet
