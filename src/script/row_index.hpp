#pragma once
// The rows of a long sweep that are stored, by the hashes of their scenes: where each lies, not what it holds.

#include <cstdint>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/hash_pieces.hpp"
#include "store/table.hpp"

namespace ricochet {

/// A file of a RowIndex, and a row in it.
struct RowPlace {
  std::uint32_t file = 0, row = 0;
};

class RowIndex {
 public:
  /// Takes up a file's rows. Throws FileError for one that is damaged, of another program or lacks a column, and for a
  /// row that differs from another of its scene.
  void add(const std::filesystem::path& file);
  /// Those of a file that this process wrote, which may be there already.
  void add(const std::filesystem::path& file, const std::vector<HashKey>& rows);
  void clear();

  /// nullptr if there is none.
  const RowPlace* find(const HashKey& scene) const;
  std::size_t rows() const { return places_.size(); }
  /// How many rows are of none of these scenes.
  std::size_t strangers(const std::vector<HashKey>& scenes) const;

  /// A column of these rows, in their order. Throws FileError.
  std::vector<double> numbers(const std::string& column, const std::vector<RowPlace>& rows) const;
  std::vector<std::string> texts(const std::string& column, const std::vector<RowPlace>& rows) const;
  /// Throws FileError if a file is not what it was when its rows were taken up: another process has replaced it.
  void refuse_changed() const;

 private:
  struct File {
    std::filesystem::path path;
    std::filesystem::file_time_type written;
    std::uintmax_t bytes;
  };
  using Twin = std::pair<RowPlace, std::uint32_t>;

  std::uint32_t enter(const std::filesystem::path& file);
  void compare(const std::vector<Twin>& twins, std::uint32_t file) const;

  std::vector<File> files_;
  std::unordered_map<HashKey, RowPlace, HashKey::Spread> places_;
};

}  // namespace ricochet
