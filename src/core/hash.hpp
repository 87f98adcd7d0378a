#pragma once
#include <string>
#include <string_view>

namespace ricochet {

/// XXH3, 128 bits, as 32 hexadecimal digits: names scenes, scripts and outcomes (not a cryptographic hash).
std::string hash_text(std::string_view text);

}  // namespace ricochet
