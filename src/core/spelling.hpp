#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ricochet {

/// The name among `names` that a person who typed `word` most likely meant; empty if none is near.
std::string nearest_name(std::string_view word, std::span<const std::string> names);

/// " (did you mean 'x'?)", or nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string> names);

}  // namespace ricochet
