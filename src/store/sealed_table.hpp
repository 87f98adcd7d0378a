#pragma once
// What of a file is a table's, and what somebody has added beside it.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "store/hdf5.hpp"
#include "store/table.hpp"

namespace ricochet {

/// The groups of a table's file.
inline constexpr const char* rows_group = "rows";
inline constexpr const char* provenance_group = "provenance";

/// The hash of all that a table and its provenance are, in whatever order its columns come.
class ContentHash {
 public:
  void add(const Field& field, const std::vector<double>& values);
  void add(const Field& field, const std::vector<std::string>& values);
  std::string text(const Provenance& provenance) const;

 private:
  std::map<std::string, std::string> columns_;
};

Provenance provenance_in(hid_t file);

/// A file that is open, of which what we wrote is as it was, whatever was added beside it. Throws FileError.
hdf5::Handle open_table(const std::filesystem::path& path);

/// Copies what somebody has added to the file that is to be replaced into its successor; nothing of one that is not
/// whole. Throws FileError.
void keep_additions(const std::filesystem::path& path, hid_t successor);

}  // namespace ricochet
