#pragma once
// The file of a script.

#include <filesystem>
#include <string>

#include "script/session.hpp"

namespace ricochet {

/// The text of a script or module; of standard input for the script that is called so. Throws FileError.
std::string read_source(const std::filesystem::path& path);

/// Throws FileError, with the nearest name beside it, if there is no such script.
void check_script(const std::filesystem::path& script);

/// Warns of a script that is not UTF-8: its texts would be question marks in pictures and plots.
void warn_of_encoding(Session& session);

}  // namespace ricochet
