#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace ricochet {

/// Writes a file so that a reader, or a kill at any moment, sees either the old file or the whole new one: beside it,
/// synced, renamed. Throws FileError.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Makes a folder and its parents. Throws FileError.
void make_folder(const std::filesystem::path& path);

/// Removes a file or an empty folder, if there is one; a link, not what it leads to. Throws FileError.
void remove_file(const std::filesystem::path& path);

/// The whole file. Throws FileError.
std::string read_file(const std::filesystem::path& path);

/// Holds a folder against other processes until it goes out of scope (or the process dies). Throws FileError if another
/// holds it.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  int descriptor_;
};

}  // namespace ricochet
