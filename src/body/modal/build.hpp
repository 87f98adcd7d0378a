#pragma once
#include "body/solid.hpp"

namespace ricochet {

/// The same body, moving as the `count` slowest of its modes, 0: as all, up to most_modes. Throws FieldError("modes")
/// if it has no such modes.
std::shared_ptr<const Solid> as_modes(const std::shared_ptr<const Solid>& solid, int count);

}  // namespace ricochet
