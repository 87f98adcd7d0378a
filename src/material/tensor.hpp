#pragma once

namespace ricochet {

/// A tensor of second order in the plane, such as the deformation gradient F_iJ = dx_i/dX_J, of numbers or of lanes.
/// Its copies are written out, component by component, for the reason that core/place.hpp gives.
template <class Number>
struct Tensor {
  Number xx, xy, yx, yy;

  [[gnu::always_inline]] Tensor() {}
  [[gnu::always_inline]] Tensor(const Number& xx_, const Number& xy_, const Number& yx_, const Number& yy_) {
    xx = xx_;
    xy = xy_;
    yx = yx_;
    yy = yy_;
  }
  [[gnu::always_inline]] Tensor(const Tensor& other) { *this = other; }
  // NOLINTNEXTLINE(bugprone-unhandled-self-assignment): it owns nothing
  [[gnu::always_inline]] Tensor& operator=(const Tensor& other) {
    xx = other.xx;
    xy = other.xy;
    yx = other.yx;
    yy = other.yy;
    return *this;
  }
};

/// A tensor of a body of revolution: that of the plane through its axis, and across the plane, where it has no shear.
/// F_zz is the circumference of a ring over that at rest.
template <class Number>
struct AxialTensor {
  Tensor<Number> plane;
  Number zz;

  [[gnu::always_inline]] AxialTensor() {}
  [[gnu::always_inline]] AxialTensor(const Tensor<Number>& plane_, const Number& zz_) : plane(plane_) { zz = zz_; }
  [[gnu::always_inline]] AxialTensor(const AxialTensor& other) { *this = other; }
  // NOLINTNEXTLINE(bugprone-unhandled-self-assignment): it owns nothing
  [[gnu::always_inline]] AxialTensor& operator=(const AxialTensor& other) {
    plane = other.plane;
    zz = other.zz;
    return *this;
  }
};

}  // namespace ricochet
