#pragma once
#include <array>

namespace ricochet::render {

using Colour = std::array<float, 3>;

/// Dark blue over grey to yellow for a value from 0 to 1: anchors of cividis, made to read alike with and without colour
/// blindness [Nunez, Anderton & Renslow 2018, PLoS ONE 13, e0199239], joined linearly.
Colour cividis(double value);

}  // namespace ricochet::render
