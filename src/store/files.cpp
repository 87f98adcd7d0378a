#include "store/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

#include "core/error.hpp"
#include "store/run_names.hpp"

namespace ricochet {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* doing, int error) {
  const char* remedy = error == ENOSPC || error == EDQUOT
                           ? "; free some space or give another folder with --out, then --resume"
                       : error == EACCES || error == EROFS || error == EPERM ? "; give a writable folder with --out"
                                                                             : "";
  throw FileError(fmt::format("cannot {} {}: {}{}", doing, path.string(), std::strerror(error), remedy));
}

class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int value() const { return value_; }

 private:
  int value_;
};

void sync_folder(const std::filesystem::path& folder) {
  const Descriptor directory(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.value() >= 0) fsync(directory.value());
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string name = std::filesystem::temp_directory_path() / "ricochet-XXXXXX";
  if (!mkdtemp(name.data())) fail(name, "make folder", errno);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

FolderLock::FolderLock(const std::filesystem::path& folder)
    : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) fail(folder, "open", errno);
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  close(descriptor_);
  descriptor_ = -1;
  if (error == ENOLCK || error == ENOSYS || error == EOPNOTSUPP) {
    refusal_ = std::strerror(error);
    return;
  }
  if (error != EWOULDBLOCK) fail(folder, "lock", error);
  throw FileError(fmt::format("another run is writing into {}; wait for its end, or give another folder with --out",
                              folder.string()));
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

void write_atomically(const std::filesystem::path& path, std::string_view bytes) {
  const std::filesystem::path beside = run_names::unfinished(path);
  {
    unlink(beside.c_str());  // left by a run that was killed; and no link is ever followed
    const Descriptor file(open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
    if (file.value() < 0) fail(path, "write", errno);
    while (!bytes.empty()) {
      const ssize_t written = write(file.value(), bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) {
        const int error = written < 0 ? errno : EIO;
        unlink(beside.c_str());
        fail(path, "write", error);
      }
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    if (fsync(file.value()) != 0) {
      const int error = errno;
      unlink(beside.c_str());
      fail(path, "write", error);
    }
  }
  rename_over(beside, path);
}

void rename_over(const std::filesystem::path& file, const std::filesystem::path& path) {
  if (rename(file.c_str(), path.c_str()) != 0) fail(path, "write", errno);
  sync_folder(path.parent_path());
}

bool link_first(const std::filesystem::path& file, const std::filesystem::path& path) {
  if (link(file.c_str(), path.c_str()) == 0) {
    sync_folder(path.parent_path());
    return true;
  }
  const int error = errno;
  struct stat now {};
  if (stat(file.c_str(), &now) == 0 && now.st_nlink == 2) return true;  // done, but the answer was lost on its way
  if (error != EEXIST) fail(path, "link", error);
  return false;
}

bool is_within(const std::filesystem::path& inner, const std::filesystem::path& outer) {
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

std::string host_name() {
  char host[256] = "unknown";
  gethostname(host, sizeof host - 1);
  return host;
}

std::string own_name(const std::string& stem, const std::string& extension) {
  static std::atomic<int> count = 0;
  static const unsigned bits = std::random_device()();  // containers may share host name and process number
  return fmt::format("{}-{}-{}-{:08x}-{}{}", stem, host_name(), getpid(), bits, count++, extension);
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) fail(path, "make folder", error.value());
}

void remove_file(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove(path, error);
  if (error) fail(path, "remove", error.value());
}

std::string read_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw FileError(fmt::format("cannot read {}: it is a folder", path.string()));
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw FileError(fmt::format("cannot read {}: it is no regular file", path.string()));
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path, "read", errno);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace ricochet
