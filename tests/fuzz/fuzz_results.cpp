// The readers of results.h5 and trajectory.h5. An even first byte: the rest is the file as it lies on disk. An odd one:
// the rest describes an HDF5 file, sealed like ours but of other groups, types and sizes. (What HDF5 itself makes of
// bytes that are none of its own never comes to pass: the seal is checked first.)

#include <hdf5.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "store/files.hpp"
#include "store/h5md.hpp"
#include "store/hdf5.hpp"
#include "store/table.hpp"

namespace {

using namespace ricochet;

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), end_(data + size) {}
  bool empty() const { return data_ == end_; }
  unsigned take() { return empty() ? 0 : *data_++; }

 private:
  const std::uint8_t *data_, *end_;
};

// A group, dataset or attribute for every few bytes.
std::string described(Bytes& bytes) {
  const hdf5::Handle file = hdf5::memory_file();
  {
    std::vector<hdf5::Handle> groups;
    groups.push_back(hdf5::group(file, bytes.take() % 8 ? "rows" : "other"));
    if (bytes.take() % 2) groups.push_back(hdf5::group(file, "provenance"));
    if (bytes.take() % 4 == 0) groups.push_back(hdf5::group(file, "h5md"));
    while (!bytes.empty()) {
      const hdf5::Handle& parent = groups[bytes.take() % groups.size()];
      const char* names[] = {"status", "reason", "e", "hash", "unit", "a", "rows", ""};
      std::string name = names[bytes.take() % 8];
      if (name.empty()) name = std::string(1, static_cast<char>('b' + bytes.take() % 20));
      if (H5Lexists(parent, name.c_str(), H5P_DEFAULT) > 0) continue;
      const unsigned kind = bytes.take() % 8, length = bytes.take();
      if (kind == 0) {
        groups.push_back(hdf5::group(parent, name.c_str()));
        continue;
      }
      hid_t type = H5Tcopy(H5T_C_S1);
      if (kind == 1)
        H5Tset_size(type, H5T_VARIABLE);
      else if (kind == 2)
        H5Tset_size(type, 1 + bytes.take());
      else {
        H5Tclose(type);
        type = H5Tcopy(kind == 3   ? H5T_IEEE_F64LE
                       : kind == 4 ? H5T_STD_I32BE
                       : kind == 5 ? H5T_IEEE_F32LE
                       : kind == 6 ? H5T_STD_B8LE
                                   : H5T_STD_REF_OBJ);
      }
      hsize_t shape[3] = {length, 1 + bytes.take() % 3, 1 + bytes.take() % 2};
      const int rank = static_cast<int>(bytes.take() % 4);
      const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
      if (bytes.take() % 8 == 0 && rank > 0) {  // claims more than it stores
        for (int i = 0; i < rank; ++i) shape[i] = hsize_t{1} << bytes.take() % 60;
        const hsize_t chunk[3] = {1, 1, 1};
        H5Pset_chunk(properties, rank, chunk);
      }
      const hid_t space =
          rank == 0 ? H5Screate(bytes.take() % 2 ? H5S_SCALAR : H5S_NULL) : H5Screate_simple(rank, shape, nullptr);
      const hid_t set = H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
      if (set >= 0) {
        if (bytes.take() % 2) hdf5::attribute(set, "unit", "c");
        if (bytes.take() % 8 == 0) {
          const hid_t attribute = H5Acreate2(set, "doc", type, space, H5P_DEFAULT, H5P_DEFAULT);
          if (attribute >= 0) H5Aclose(attribute);
        }
        H5Dclose(set);
      }
      if (space >= 0) H5Sclose(space);
      H5Pclose(properties);
      H5Tclose(type);
    }
  }
  return hdf5::image(file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("ricochet_fuzz_" + std::to_string(getpid()) + ".h5");
  Bytes bytes(data + 1, size - 1);
  std::string file;
  try {
    file = data[0] % 2 ? described(bytes) : std::string(reinterpret_cast<const char*>(data) + 1, size - 1);
  } catch (const FileError&) {  // no file comes of it
    return 0;
  }
  write_atomically(path, file);
  for (const auto& read : {+[](const std::filesystem::path& p) { read_table(p); },
                           +[](const std::filesystem::path& p) { read_provenance(p); },
                           +[](const std::filesystem::path& p) { is_trajectory(p); },
                           +[](const std::filesystem::path& p) { read_trajectory(p); }})
    try {
      read(path);
    } catch (const FileError&) {  // refused: as it should be
    }
  return 0;
}
