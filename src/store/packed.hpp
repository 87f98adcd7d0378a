#pragma once
// A recorded impact as a page carries it: places as whole numbers of a grid, differences in time node after node, the
// low bytes before the high ones, deflated. A fifteenth of what a trajectory file takes.

#include <optional>
#include <string>

#include "store/trajectory.hpp"

namespace ricochet {

struct PackedReplay {
  double grid = 1e-3;     ///< places are whole multiples of it; larger only where a body is wider than 60 R [R]
  int levels = 63;        ///< greatest number of a colour
  double top = 0;         ///< the speed of that colour; of level k it is top (k / levels)^2 [c]
  std::string place;      ///< int16: [2 node + k][frame], differences in time, byte planes; deflated
  std::string colour;     ///< uint8: [node][frame], differences in time modulo 256; deflated
  std::string triangles;  ///< uint32: three nodes each, differences from number to number, byte planes; deflated
};

/// Of a plane trajectory of two frames or more. Places beyond 32 767 grid steps (the ends of a plane) lie on that edge.
PackedReplay packed(const Trajectory& trajectory);

/// By deflate (RFC 1950) at level 5: level 6 takes half as long again for two hundredths less.
std::string deflated(const std::string& bytes);

/// What was deflated, if it is whole and of so many bytes.
std::optional<std::string> inflated(const std::string& bytes, std::size_t size);

/// RFC 4648, in one line.
std::string base64(const std::string& bytes);

/// What base64() made a text of, up to the first character that it does not write.
std::string from_base64(const std::string& text);

/// `size` bytes each, as the lowest bytes of all numbers, then the next ones: deflate finds far more in that.
std::string byte_planes(const std::vector<std::uint32_t>& numbers, int size);

}  // namespace ricochet
