#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace ricochet {

/// Writes a file so that a reader, or a kill at any moment, sees either the old file or the whole new one: beside it, synced, renamed.
/// Throws FileError.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Makes a folder and its parents. Throws FileError.
void make_folder(const std::filesystem::path& path);

/// The whole file. Throws FileError.
std::string read_file(const std::filesystem::path& path);

}  // namespace ricochet
