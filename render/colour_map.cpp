#include "render/colour_map.hpp"

#include <algorithm>
#include <cmath>

namespace ricochet::render {

Colour cividis(double value) {
  static constexpr std::array<Colour, 9> anchors{{{0.000f, 0.126f, 0.302f}, {0.000f, 0.222f, 0.436f}, {0.260f, 0.305f, 0.423f}, {0.383f, 0.392f, 0.428f},
                                                  {0.485f, 0.482f, 0.471f}, {0.600f, 0.576f, 0.459f}, {0.727f, 0.676f, 0.413f}, {0.866f, 0.787f, 0.331f},
                                                  {0.995f, 0.909f, 0.218f}}};
  const double place = std::clamp(std::isfinite(value) ? value : 1.0, 0.0, 1.0) * (anchors.size() - 1);
  const std::size_t below = std::min<std::size_t>(static_cast<std::size_t>(place), anchors.size() - 2);
  const float part = static_cast<float>(place - static_cast<double>(below));
  Colour colour;
  for (std::size_t c = 0; c < 3; ++c) colour[c] = anchors[below][c] + part * (anchors[below + 1][c] - anchors[below][c]);
  return colour;
}

}  // namespace ricochet::render
