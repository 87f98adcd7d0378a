#include "store/hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "store/files.hpp"
#include "store/hdf5_version.hpp"
#include "store/run_names.hpp"
#include "store/seal.hpp"

namespace ricochet::hdf5 {
namespace {

// More than any table or text of ours holds.
constexpr hsize_t most_values = 1'000'000'000;

// Errors come back as values; HDF5's own stack on stderr would hide the one sentence that matters.
void quiet() {
  static const bool once = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  (void)once;
}

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "copy a type");
  H5Tset_size(type, std::max<std::size_t>(1, length));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

Handle no_times() {
  // Without object times equal runs give equal bytes.
  Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make properties");
  H5Pset_obj_track_times(properties, 0);
  return properties;
}

hsize_t value_count(const Handle& set) {
  const Handle space(H5Dget_space(set), H5Sclose, "read a shape");
  const hsize_t length = static_cast<hsize_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space)));
  // A file may claim any size for what it never stored.
  if (length > most_values || length > 1000 * (H5Dget_storage_size(set) + 1))
    throw FileError(fmt::format("a dataset claims {} values and stores {} bytes", length, H5Dget_storage_size(set)));
  return length;
}

Handle open_set(hid_t parent, const char* name) {
  return {H5Dopen2(parent, name, H5P_DEFAULT), H5Dclose, "open a dataset"};
}

void check(herr_t status, const char* doing) {
  if (status < 0) throw FileError(std::string("HDF5 cannot ") + doing);
}

template <class Number>
std::vector<Number> read_all(hid_t parent, const char* name, hid_t type) {
  const Handle set = open_set(parent, name);
  std::vector<Number> values(value_count(set));
  if (!values.empty()) check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read a dataset");
  return values;
}

}  // namespace

Handle memory_file() {
  quiet();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make properties");
  check(H5Pset_fapl_core(access, 1 << 20, 0), "use memory");
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "make properties");
  check(H5Pset_userblock(creation, seal_size), "leave room for the seal");
  return {H5Fcreate("memory", H5F_ACC_TRUNC, creation, access), H5Fclose, "make a file in memory"};
}

std::string image(const Handle& file, const std::string& content) {
  check(H5Fflush(file, H5F_SCOPE_GLOBAL), "flush a file in memory");
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size < 0) throw FileError("HDF5 cannot give a file's image");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file, bytes.data(), bytes.size()) < 0) throw FileError("HDF5 cannot give a file's image");
  return seal_of(bytes, content) + bytes;  // an image begins behind the user block
}

Handle new_file_beside(const std::filesystem::path& path) {
  quiet();
  const std::filesystem::path beside = run_names::unfinished(path);
  remove_file(beside);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "make properties");
  check(H5Pset_userblock(creation, seal_size), "leave room for the seal");
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make properties");
  check(H5Pset_file_locking(access, 0, 1), "do without locks");
  const hid_t id = H5Fcreate(beside.c_str(), H5F_ACC_EXCL, creation, access);
  if (id < 0) throw FileError(fmt::format("cannot write {}; give a writable folder with --out", path.string()));
  return {id, H5Fclose, "make a file"};
}

Handle open_known_file(const std::filesystem::path& path) {
  quiet();
  // One process writes a file, and gives it its name when it is whole: no lock is needed, and some file systems have
  // none.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make properties");
  check(H5Pset_file_locking(access, 0, 1), "do without locks");
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
  if (id < 0) throw FileError(fmt::format("{} is sealed, but HDF5 cannot open it; {}", path.string(), damage_remedy));
  return {id, H5Fclose, "open a file"};
}

namespace {

// True if HDF5 itself says that the file ends where it does: it added what stands there.
bool ends_by_hdf5(hid_t file, std::size_t size) {
  haddr_t end = 0;
  return H5Fget_eoa(file, &end) >= 0 && end == size;
}

}  // namespace

Opened open_with_additions(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw FileError(fmt::format("{} does not exist", path.string()));
  check_readable(path);
  const Sealed found = sealed_in(path);
  if (!found.seal.starts_with(seal_words))
    throw FileError(
        fmt::format("{} is no file of ricochet's (it begins without a seal), or its beginning is damaged; {}",
                    path.string(), damage_remedy));
  const Content content = content_of(found.seal);
  const bool whole = found.seal == seal_with(found.hash, content);
  const bool grew = !content.hash.empty() && found.size > content.size;
  if (!whole && !grew)
    throw FileError(
        fmt::format("{} is damaged: its bytes are not those that were written (the seal does not match); {}",
                    path.string(), damage_remedy));
  Handle file = open_known_file(path);
  if (!whole && !ends_by_hdf5(file, found.size))
    throw FileError(fmt::format("{} is damaged: more stands there than was written, and HDF5 did not add it; {}",
                                path.string(), damage_remedy));
  return {std::move(file), whole ? "" : content.hash};
}

Handle open_file(const std::filesystem::path& path) {
  Opened opened = open_with_additions(path);
  if (opened.content.empty()) return std::move(opened.file);
  throw FileError(
      fmt::format("{} is not as it was written: something was added to it; {}", path.string(), damage_remedy));
}

Handle group(hid_t parent, const char* name) {
  return {H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "make a group"};
}
Handle open_group(hid_t parent, const char* name) {
  return {H5Gopen2(parent, name, H5P_DEFAULT), H5Gclose, "open a group"};
}

void attribute(hid_t object, const char* name, const std::string& text) {
  // An attribute lives in the object's header, which holds 64 kB: longer texts (scripts) are datasets elsewhere.
  const Handle type = text_type(text.size());
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "make a shape");
  const Handle attr(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "make an attribute");
  check(H5Awrite(attr, type, text.empty() ? "" : text.data()), "write an attribute");
}

std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return "";
  const Handle attr(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, "open an attribute");
  const Handle type(H5Aget_type(attr), H5Tclose, "read a type");
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    throw FileError("an attribute is not plain text");
  const Handle space(H5Aget_space(attr), H5Sclose, "read a shape");
  if (H5Sget_simple_extent_npoints(space) != 1) throw FileError("an attribute is not one text");
  std::string text(H5Tget_size(type), '\0');
  check(H5Aread(attr, type, text.data()), "read an attribute");
  return text.c_str();
}

std::vector<std::string> attribute_names(hid_t object) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->push_back(name);
    return 0;
  };
  check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "list attributes");
  return names;
}

Handle dataset(hid_t parent, const char* name, hid_t file_type, hid_t memory_type, std::span<const hsize_t> shape,
               std::span<const hsize_t> chunk, const void* values) {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, "make a shape");
  const Handle properties = no_times();
  if (!chunk.empty()) {
    H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
    H5Pset_shuffle(properties);
    H5Pset_deflate(properties, 1);
  }
  Handle set(H5Dcreate2(parent, name, file_type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose,
             "make a dataset");
  if (values) check(H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write a dataset");
  return set;
}

Handle numbers(hid_t parent, const char* name, std::span<const double> values) {
  const hsize_t shape[] = {values.size()};
  return dataset(parent, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, {}, values.empty() ? nullptr : values.data());
}

namespace {

std::size_t longest(std::span<const std::string> values) {
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  return length;
}

// The values one after the other, each as long as the longest.
std::string packed(std::span<const std::string> values, std::size_t length) {
  std::string bytes(values.size() * length, '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
    std::copy(values[i].begin(), values[i].end(), bytes.begin() + static_cast<std::ptrdiff_t>(i * length));
  return bytes;
}

// A part of a dataset of one dimension, in the file.
Handle part_of(const Handle& set, std::size_t first, std::size_t count) {
  Handle space(H5Dget_space(set), H5Sclose, "read a shape");
  const hsize_t start = first, length = count;
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &start, nullptr, &length, nullptr), "choose rows");
  return space;
}

Handle line_of(std::size_t count) {
  const hsize_t length = count;
  return {H5Screate_simple(1, &length, nullptr), H5Sclose, "make a shape"};
}

}  // namespace

Handle texts(hid_t parent, const char* name, std::span<const std::string> values) {
  const std::size_t length = longest(values);
  const std::string bytes = packed(values, length);
  const hsize_t shape[] = {values.size()};
  const Handle type = text_type(length);
  return dataset(parent, name, type, type, shape, {}, bytes.empty() ? nullptr : bytes.data());
}

Handle many_texts(hid_t parent, const char* name, std::span<const std::string> values) {
  constexpr std::size_t long_text = 64, block = 1 << 14;
  const std::size_t length = longest(values);
  const hsize_t shape[] = {values.size()}, chunk[] = {std::min(block, std::max<std::size_t>(1, values.size()))};
  const Handle type = text_type(length);
  Handle set = dataset(parent, name, type, type, shape,
                       length > long_text ? std::span<const hsize_t>(chunk) : std::span<const hsize_t>(), nullptr);
  for (std::size_t first = 0; first < values.size(); first += block) {
    const auto some = values.subspan(first, std::min(block, values.size() - first));
    const Handle memory = line_of(some.size()), file = part_of(set, first, some.size());
    check(H5Dwrite(set, type, memory, file, H5P_DEFAULT, packed(some, length).data()), "write a dataset");
  }
  return set;
}

bool holds_text(hid_t parent, const char* name) {
  const Handle set = open_set(parent, name);
  const Handle type(H5Dget_type(set), H5Tclose, "read a type");
  return H5Tget_class(type) == H5T_STRING;
}

std::vector<double> read_numbers(hid_t parent, const char* name) {
  return read_all<double>(parent, name, H5T_NATIVE_DOUBLE);
}
std::vector<float> read_floats(hid_t parent, const char* name) {
  return read_all<float>(parent, name, H5T_NATIVE_FLOAT);
}

std::vector<double> read_numbers(hid_t parent, const char* name, std::size_t first, std::size_t count) {
  const Handle set = open_set(parent, name);
  std::vector<double> values(count);
  if (count == 0) return values;
  const Handle memory = line_of(count), file = part_of(set, first, count);
  check(H5Dread(set, H5T_NATIVE_DOUBLE, memory, file, H5P_DEFAULT, values.data()), "read a dataset");
  return values;
}

std::size_t length_of(hid_t parent, const char* name) { return value_count(open_set(parent, name)); }

std::vector<std::string> read_texts(hid_t parent, const char* name, std::size_t first, std::size_t count) {
  const Handle set = open_set(parent, name);
  const Handle type(H5Dget_type(set), H5Tclose, "read a type");
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    throw FileError("a text column is not plain text");
  const std::size_t length = H5Tget_size(type);
  if (length > 0 && count > most_values / length) throw FileError("a text column is larger than any of ours");
  if (count == 0) return {};
  std::string bytes(count * length, '\0');
  const Handle memory = line_of(count), file = part_of(set, first, count);
  check(H5Dread(set, type, memory, file, H5P_DEFAULT, bytes.data()), "read a dataset");
  std::vector<std::string> values;
  for (std::size_t i = 0; i < count; ++i) values.emplace_back(std::string(bytes, i * length, length).c_str());
  return values;
}

std::vector<std::string> read_texts(hid_t parent, const char* name) {
  return read_texts(parent, name, 0, length_of(parent, name));
}

std::vector<std::string> link_names(hid_t where) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->push_back(name);
    return 0;
  };
  check(H5Literate(where, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "list a group");
  return names;
}

void describe(const Handle& set, const Field& field) {
  attribute(set, "unit", field.unit);
  attribute(set, "doc", field.doc);
}

Field described(hid_t parent, const std::string& name) {
  const Handle set = open_set(parent, name.c_str());
  return {name, "", text_attribute(set, "unit"), text_attribute(set, "doc")};
}

void write_provenance(hid_t file, const std::map<std::string, std::string>& provenance) {
  const Handle origin = group(file, "provenance");
  for (const auto& [name, text] : provenance) texts(origin, name.c_str(), std::vector<std::string>{text});
}

}  // namespace ricochet::hdf5

std::string ricochet::hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}
