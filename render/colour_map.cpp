#include "render/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace ricochet::render {

std::span<const ColourMap> colour_maps() {
  static const std::vector<ColourMap> maps{
      {"ylgnbu",
       "pale yellow over green to dark blue [ColorBrewer YlGnBu, Brewer 2003, Apache licence 2.0]",
       {{255, 255, 217},
        {237, 248, 177},
        {199, 233, 180},
        {127, 205, 187},
        {65, 182, 196},
        {29, 145, 192},
        {34, 94, 168},
        {37, 52, 148},
        {8, 29, 88}}},
      {"puor",
       "orange over white to purple, for values of both signs [ColorBrewer PuOr, Brewer 2003, Apache licence 2.0]",
       {{127, 59, 8},
        {179, 88, 6},
        {224, 130, 20},
        {253, 184, 99},
        {254, 224, 182},
        {247, 247, 247},
        {216, 218, 235},
        {178, 171, 210},
        {128, 115, 172},
        {84, 39, 136},
        {45, 0, 75}}},
      {"cividis",
       "dark blue over grey to yellow [Nunez, Anderton & Renslow 2018, PLoS ONE 13, e0199239]",
       {{0, 32, 77},
        {0, 57, 111},
        {66, 78, 108},
        {98, 100, 109},
        {124, 123, 120},
        {153, 147, 117},
        {185, 172, 105},
        {221, 201, 84},
        {254, 232, 56}}},
  };
  return maps;
}

const ColourMap& colour_map_named(const char* name) {
  for (const ColourMap& map : colour_maps())
    if (std::string(map.name) == name) return map;
  throw std::logic_error(std::string("no colour map is called ") + name);
}

Colour colour_of(const ColourMap& map, double value) {
  const double last = static_cast<double>(map.anchors.size() - 1);
  const double place = std::clamp(std::isfinite(value) ? value : 1.0, 0.0, 1.0) * last;
  const std::size_t below = std::min<std::size_t>(static_cast<std::size_t>(place), map.anchors.size() - 2);
  const double part = place - static_cast<double>(below);
  Colour colour{0, 0, 0, 255};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] =
        static_cast<std::uint8_t>(std::lround(map.anchors[below][c] * (1 - part) + map.anchors[below + 1][c] * part));
  return colour;
}

Colour kind_colour(int kind) {
  static constexpr std::array<Colour, 8> colours{{{0, 114, 178, 255},
                                                  {230, 159, 0, 255},
                                                  {0, 158, 115, 255},
                                                  {204, 121, 167, 255},
                                                  {86, 180, 233, 255},
                                                  {213, 94, 0, 255},
                                                  {240, 228, 66, 255},
                                                  {120, 120, 120, 255}}};
  return colours[static_cast<std::size_t>(kind) % colours.size()];
}

}  // namespace ricochet::render
