#pragma once
#include <string>

namespace ricochet {

// What the program lists on the terminal.
void print_effects();
/// All theories, or the one of that name. Throws Error.
void print_theories(const std::string& name);
/// The paper's misprints.
void print_errata();
/// What a file of results or a trajectory holds, and where it came from. Throws FileError.
void print_info(const std::string& path);

}  // namespace ricochet
