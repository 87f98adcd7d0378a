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

/// Gives a finished file another name, in place of what has that. Throws FileError.
void rename_over(const std::filesystem::path& file, const std::filesystem::path& path);

/// Gives a finished file the name `path` besides its own, unless that is taken: then false. Of several processes, on
/// whatever machines, one gets true. Throws FileError.
bool link_first(const std::filesystem::path& file, const std::filesystem::path& path);

/// True if `inner` is `outer` or lies below it, by their components as they stand.
bool is_within(const std::filesystem::path& inner, const std::filesystem::path& outer);

/// The name of this machine.
std::string host_name();

/// A name that no other process, on whatever machine, gives a file: STEM-<host>-<process>-<random>-<count>EXTENSION.
std::string own_name(const std::string& stem, const std::string& extension);

/// A folder where temporary files go, this user's alone, removed with all in it at the end.
class ScratchFolder {
 public:
  ScratchFolder();  ///< Throws FileError.
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Holds a folder against other processes until it goes out of scope (or the process dies). Throws FileError if another
/// holds it. Some file systems of networks give no locks: then it holds nothing.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(FolderLock&& other) noexcept
      : refusal_(std::move(other.refusal_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

  /// Why the file system gave no lock; empty if it did.
  const std::string& refusal() const { return refusal_; }

 private:
  std::string refusal_;
  int descriptor_;
};

}  // namespace ricochet
