#pragma once
// A sweep's rows as they come in, in part files that survive a kill, and the results of them all.

#include <filesystem>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "record/row.hpp"
#include "script/session.hpp"
#include "store/table.hpp"

namespace ricochet {

/// The sweep's own parameters, by name; numbers are NaN and texts empty where the other kind was given.
struct Parameters {
  std::vector<std::string> names, units;        // [parameter]; the user's word for the unit, or none
  std::vector<std::vector<double>> numbers;     // [parameter][scene]
  std::vector<std::vector<std::string>> texts;  // [parameter][scene]; empty if the parameter is numeric

  /// "psi1 = 2, sample = 7" for messages.
  std::string place(std::size_t scene) const;
};

/// What of a sweep's earlier rows a store takes up.
struct Earlier {
  bool taken;      ///< else it begins anew
  bool strangers;  ///< rows of other scenes may be among them: later rounds will ask for those
};

/// All columns of rows, in the units of the first.
Table table_of(const std::vector<const Row*>& rows);

/// Rows of a sweep as they come in, and their files.
class Store {
 public:
  /// Takes what is stored if it is to be taken up. Throws FileError for what is damaged, or not of these scenes, or of
  /// another version.
  Store(Session& session, const std::string& name, const std::vector<std::string>& hashes, const Parameters& parameters,
        const Earlier& earlier);

  const std::vector<bool>& done() const { return done_; }
  const std::vector<Row>& rows() const { return rows_; }
  std::size_t count() const { return count_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// Keeps a finished batch as a part file: from then on it survives a kill.
  void add(const std::vector<std::pair<std::size_t, Row>>& batch);

  /// The results, in every format, of every row there is, in the sweep's order; then the parts are not needed any more.
  void assemble();
  /// The same of a sweep that stops early, unless it would replace earlier results with less: then the parts stay
  /// beside them.
  void stop_early();
  /// "12 of 40 impacts are stored in out/s; --resume goes on from there".
  std::string left_behind() const;

 private:
  // True if earlier results stay until all new rows are there.
  bool replaces() const;
  // Fills in the row at every scene that it is of: rows of equal scenes are the same row. False if there is none.
  bool accept(const Row& row);
  // Puts the column of parameter `p` before all others.
  void add_parameter(Table& table, std::size_t p, const std::vector<std::size_t>& scenes) const;
  void load(bool strangers_too);

  Session& session_;
  std::filesystem::path folder_, parts_;
  const std::vector<std::string>& hashes_;
  const Parameters& parameters_;
  std::unordered_map<std::string, std::vector<std::size_t>> scenes_;  // by hash
  std::vector<Row> rows_;
  std::vector<bool> done_;
  std::size_t count_ = 0;
};

}  // namespace ricochet
