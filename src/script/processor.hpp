#pragma once
#include <string>

namespace ricochet {

/// As the system calls it; "unknown processor" if it does not say.
std::string processor_name();

}  // namespace ricochet
