#pragma once
// HDF5 behind RAII. Files are made in memory and written in one piece, so that a full disk or a kill never leaves half
// a file.

#include <hdf5.h>

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace ricochet::hdf5 {

/// Owns an HDF5 identifier and closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const char* doing) : id_(id), close_(close) {
    if (id < 0) throw FileError(std::string("HDF5 cannot ") + doing);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

Handle memory_file();
/// The bytes of a file as it would lie on disk, sealed: HDF5 leaves the first 512 bytes to whoever writes it, and there
/// stands the hash of all that follows, so that not one flipped bit goes unnoticed. `content`: a hash of what we put
/// into it, by which that is known again where somebody has added to the file; empty: nothing may be added.
std::string image(const Handle& file, const std::string& content = "");
/// The seal of these bytes, which go behind it.
std::string seal_of(std::string_view bytes, const std::string& content = "");

/// A file that is open to read, of what was written or more. If `content` is not empty, something was added to it, by
/// HDF5 and so that it grew: what we wrote must have that hash.
struct Opened {
  Handle file;
  std::string content;
};
/// Throws FileError that names the file if it is not ours, or is damaged: HDF5 sees only what was written, and what was
/// added to it.
Opened open_with_additions(const std::filesystem::path& path);
/// The same of a file to which nothing may be added.
Handle open_file(const std::filesystem::path& path);

/// What to do about a damaged file.
inline constexpr const char* damage_remedy =
    "restore it from a copy, or remove it, or run the script that wrote it again with --force or another --out";

Handle group(hid_t parent, const char* name);
Handle open_group(hid_t parent, const char* name);
void attribute(hid_t object, const char* name, const std::string& text);
std::string text_attribute(hid_t object, const char* name);
std::vector<std::string> attribute_names(hid_t object);

/// One-dimensional datasets. Text is stored with a fixed length, padded with zeros.
Handle numbers(hid_t parent, const char* name, std::span<const double> values);
Handle texts(hid_t parent, const char* name, std::span<const std::string> values);
/// The values of a dataset of numbers of any shape, in its order.
std::vector<double> read_numbers(hid_t parent, const char* name);
std::vector<float> read_floats(hid_t parent, const char* name);
std::vector<std::string> read_texts(hid_t parent, const char* name);
bool holds_text(hid_t parent, const char* name);
std::vector<std::string> link_names(hid_t group);

/// A dataset of any shape from memory of type `memory_type`, stored as `file_type`; chunk 0 sizes make it contiguous.
Handle dataset(hid_t parent, const char* name, hid_t file_type, hid_t memory_type, std::span<const hsize_t> shape,
               std::span<const hsize_t> chunk, const void* values);

/// The group "provenance": a text for each name.
void write_provenance(hid_t file, const std::map<std::string, std::string>& provenance);

}  // namespace ricochet::hdf5
