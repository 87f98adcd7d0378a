#pragma once
#include <cstddef>

namespace ricochet {

/// The bodies of an aimed impact, by index: a view that launch, endings and outcomes have of the list; what moves
/// bodies knows of none. Their contact is the first pair.
namespace role {
inline constexpr std::size_t projectile = 0, target = 1;
inline constexpr std::size_t aimed_pair = 0;
}  // namespace role

}  // namespace ricochet
