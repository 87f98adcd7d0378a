#pragma once
// The first bytes of a file of ricochet's: the hash of all others, and of what it held when it was written.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace ricochet::hdf5 {

inline constexpr std::string_view seal_words = "ricochet: HDF5 from byte 512 on; XXH3-128 of that: ";
inline constexpr std::size_t seal_size = 512;

/// How large a file was when it was written, and the hash of its content then.
struct Content {
  std::size_t size = 0;
  std::string hash;
};

/// Of a file that begins with its seal; no hash if none stands there, or it is damaged.
Content content_of(const std::string& bytes);

/// What a file says of itself, the hash of what it holds, and its size.
struct Sealed {
  std::string seal, hash;
  std::size_t size = 0;
};

Sealed sealed_in(const std::filesystem::path& path);

/// The seal of bytes of that hash.
std::string seal_with(const std::string& hash, const Content& content);

}  // namespace ricochet::hdf5
