#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ricochet {

/// The names among `names`, equally near, that a person who typed `word` most likely meant; empty if none is near.
std::vector<std::string> nearest_names(std::string_view word, std::span<const std::string> names);

/// " (did you mean 'x'?)", " (did you mean 'x' or 'y'?)", or nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string> names);

}  // namespace ricochet
