#pragma once
// What the elements of a body that yields remember.

#include <vector>

#include "material/hencky_flow.hpp"
#include "material/solid_law.hpp"

namespace ricochet {

/// One element's law with what it remembers: asked as the elastic laws are (material/solid_law.hpp), it does not
/// change. Elements of the plane are those of a ring that keeps its length.
template <int W>
struct RememberingLaw {
  HenckyFlow<W> law;
  const PlasticMemory<W>& memory;

  Lane<W> energy(const AxialTensor<Lane<W>>& F) const { return law.energy(F, memory); }
  AxialTensor<Lane<W>> stress(const AxialTensor<Lane<W>>& F) const {
    PlasticMemory<W> changed = memory;
    Lane<W> lost = Lane<W>::Zero();
    return law.stress(F, changed, lost);
  }
  AxialTensor<Lane<W>> tangent(const AxialTensor<Lane<W>>& F, const AxialTensor<Lane<W>>& dF) const {
    return law.tangent(F, dF, memory);
  }

  Lane<W> energy(const Tensor<Lane<W>>& F) const { return energy(AxialTensor<Lane<W>>(F, Lane<W>::Ones())); }
  Tensor<Lane<W>> stress(const Tensor<Lane<W>>& F) const {
    return stress(AxialTensor<Lane<W>>(F, Lane<W>::Ones())).plane;
  }
  Tensor<Lane<W>> tangent(const Tensor<Lane<W>>& F, const Tensor<Lane<W>>& dF) const {
    return tangent(AxialTensor<Lane<W>>(F, Lane<W>::Ones()), AxialTensor<Lane<W>>(dF, Lane<W>::Zero())).plane;
  }
};

/// A body whose elements yield, in W lanes. Where E depends on the place, so do its yield stress and hardening, in the
/// same proportion.
template <int W>
struct Flow {
  double yield = 0, hardening = 0;       ///< [m0 c^2/R^3, times the thickness in the plane]
  std::vector<PlasticMemory<W>> memory;  ///< [element]
  Lane<W> lost = Lane<W>::Zero();        ///< to what has flowed [m0 c^2]

  /// `stiffness`: E of each lane.
  HenckyFlow<W> law(const SolidLawNumbers& numbers, const Lane<W>& stiffness) const {
    return {numbers.lame.lambda * stiffness, numbers.lame.mu * stiffness, yield, hardening};
  }
};

}  // namespace ricochet
