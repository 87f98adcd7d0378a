#pragma once
#include <string>

namespace ricochet {

/// Prints of every sweep in a folder, or right below it, how far it is: of shards, of a run that is at work, or done.
/// Takes no lock. Throws FileError if there is none.
void print_status(const std::string& folder);

/// Prints the rows that are stored of the one sweep in a folder, or right below it, as comma-separated text. Takes no
/// lock. Throws FileError if there are none or several.
void print_stored(const std::string& folder);

}  // namespace ricochet
