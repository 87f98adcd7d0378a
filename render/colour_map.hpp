#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ricochet::render {

using Colour = std::array<std::uint8_t, 4>;  ///< red, green, blue, alpha

inline constexpr Colour black{20, 20, 30, 255};  ///< of text and lines: softer than none at all
inline constexpr Colour white{255, 255, 255, 255};

/// Colours for values from 0 to 1, that people with any colour vision can put in order.
struct ColourMap {
  const char *name, *doc;
  std::vector<std::array<std::uint8_t, 3>> anchors;  ///< equally spaced, joined linearly
};

std::span<const ColourMap> colour_maps();
const ColourMap& colour_map_named(const char* name);

/// The colour of a value, which is held within 0 ... 1.
Colour colour_of(const ColourMap& map, double value);

/// Colours for up to eight kinds of thing, which the colour-blind can tell apart [Okabe & Ito 2008].
Colour kind_colour(int kind);

}  // namespace ricochet::render
