#pragma once
#include <string>

namespace ricochet {

/// A replay as replay_json() gave it, with at most `frames` (2 or more) of its moments, spread evenly, the first and
/// the last among them. Throws FileError for one that is damaged.
std::string thinned(const std::string& replay, int frames);

}  // namespace ricochet
