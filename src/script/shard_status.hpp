#pragma once
#include <string>

namespace ricochet {

/// Prints of every sweep in a folder, or right below it, how far it is: of shards, of a run that is at work, or done.
/// Takes no lock. Throws FileError if there is none.
void print_status(const std::string& folder);

}  // namespace ricochet
