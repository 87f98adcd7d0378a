#include "script/long_store.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "impact/outcome.hpp"
#include "script/digest.hpp"
#include "script/known_rows.hpp"
#include "script/shard_store.hpp"
#include "script/sweep_parameters.hpp"
#include "script/sweep_table.hpp"
#include "store/csv.hpp"
#include "store/files.hpp"
#include "store/long_table.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

std::string place_of(const std::vector<SweptAxis>& axes, std::size_t point) {
  std::string text;
  for (const SweptAxis& axis : axes) {
    const std::size_t k = axis.at(point);
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", axis.name,
                        axis.is_text() ? "'" + axis.texts[k] + "'" : fmt::format("{:g}", axis.numbers[k]));
  }
  return text;
}

namespace {

// The values of an axis at points.
template <class Value>
std::vector<Value> at_points(const std::vector<Value>& values, const SweptAxis& axis,
                             const std::vector<std::size_t>& points) {
  std::vector<Value> list(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) list[i] = values[axis.at(points[i])];
  return list;
}

Parameters parameters_at(const std::vector<SweptAxis>& axes, const std::vector<std::size_t>& points) {
  Parameters parameters;
  for (const SweptAxis& axis : axes) {
    parameters.names.push_back(axis.name);
    parameters.units.push_back(axis.unit);
    parameters.numbers.push_back(axis.is_text() ? std::vector<double>{} : at_points(axis.numbers, axis, points));
    parameters.texts.push_back(axis.is_text() ? at_points(axis.texts, axis, points) : std::vector<std::string>{});
  }
  return parameters;
}

}  // namespace

void LongStore::load(const std::vector<fs::path>& files) {
  index_.clear();
  for (const fs::path& file : files) index_.add(file);
}

void LongStore::load() {
  while_they_change([this] { return folder_.stored(); }, [this](const std::vector<fs::path>& files) { load(files); });
}

void LongStore::add(std::vector<Row> rows, const std::vector<std::size_t>& points) {
  for (Row& row : rows) chunk_.push_back(std::move(row));
  chunk_points_.insert(chunk_points_.end(), points.begin(), points.end());
  const std::chrono::duration<double> since = Clock::now() - flushed_;
  if (since.count() >= folder_.session().options.flush) flush();
}

// The rows of the chunk from `first` on.
fs::path LongStore::write_part(std::size_t first) {
  std::vector<const Row*> list;
  std::vector<std::size_t> places;
  std::vector<HashKey> keys;
  std::string name;
  for (std::size_t i = first; i < chunk_.size(); ++i) {
    places.push_back(list.size());
    list.push_back(&chunk_[i]);
    keys.push_back(HashKey::of(chunk_[i].hash));
    name += chunk_[i].hash;
  }
  const fs::path file = folder_.part(hash_text(name));
  if (folder_.session().options.force && index_.rows() == 0)
    run_names::remove_parts(folder_.parts());  // of another try
  make_folder(folder_.parts());
  Table table = table_of(list);
  parameters_at(axes_, {chunk_points_.begin() + static_cast<std::ptrdiff_t>(first), chunk_points_.end()})
      .add_to(table, places);
  write_table(file, table, folder_.origin());
  index_.add(file, keys);
  return file;
}

void LongStore::flush() {
  flushed_ = Clock::now();
  if (in_parts_ == chunk_.size()) return;
  chunk_parts_.push_back(write_part(in_parts_));
  in_parts_ = chunk_.size();
}

void LongStore::end_chunk() {
  if (chunk_parts_.size() == 1 && in_parts_ == chunk_.size()) chunk_parts_.clear();
  if (chunk_parts_.empty() && in_parts_ < chunk_.size()) {
    flush();
  } else if (!chunk_parts_.empty()) {
    const fs::path whole = write_part(0);
    for (const fs::path& part : chunk_parts_)
      if (part != whole) remove_file(part);
  }
  chunk_.clear();
  chunk_points_.clear();
  chunk_parts_.clear();
  in_parts_ = 0;
}

namespace {

/// The results' files while they are written, a column after the other.
class LongResults {
 public:
  explicit LongResults(fs::path file) : file_(std::move(file)), table_(file_) {}

  template <class Value>
  void add(const Field& field, const std::vector<Value>& values) {
    table_.add(field, values);
    digest_.add(field.name, values);
    names_.push_back(field.name);
  }
  void finish(const Provenance& provenance) {
    table_.finish(provenance);
    write_long_csv(fs::path(file_).replace_extension(".csv"), StoredTable(file_, true), names_);
  }
  std::string digest() const { return digest_.text(); }

 private:
  fs::path file_;
  LongTable table_;
  Digest digest_;
  std::vector<std::string> names_;  // in the order of their columns
};

// What a column of texts tells of how rows ended; status comes before reason.
void take_endings(const std::string& column, const std::vector<std::string>& values, LongStore::Written& written) {
  if (column == "status")
    for (const std::string& status : values) written.finished.push_back(status == "finished");
  const auto failed = static_cast<std::size_t>(std::find(written.finished.begin(), written.finished.end(), false) -
                                               written.finished.begin());
  if (failed == values.size()) return;
  if (column == "status") written.first_failure = values[failed];
  if (column == "reason") written.first_failure += ": " + values[failed];
}

}  // namespace

LongStore::Written LongStore::write_results(const std::vector<RowPlace>& rows, const std::vector<std::size_t>& points,
                                            Columns& wanted, bool whole) {
  index_.refuse_changed();
  LongResults results(run_names::readable_results(folder_.path()));
  Written written = write_columns(results, rows, points, wanted);
  index_.refuse_changed();
  results.finish(folder_.session().provenance());
  folder_.results_are_written(whole);
  written.digest = results.digest();
  return written;
}

template <class Results>
LongStore::Written LongStore::write_columns(Results& results, const std::vector<RowPlace>& rows,
                                            const std::vector<std::size_t>& points, Columns& wanted) const {
  Row first;  // its units are those of all
  first.outcomes.resize(Outcome::fields().size());
  if (!rows.empty()) first.units = index_.texts("units", {rows.front()}).front();
  const Table columns = table_of({&first});
  for (const SweptAxis& axis : axes_) {
    const bool taken = columns.number(axis.name) || columns.text(axis.name);
    const Field field{taken ? "over_" + axis.name : axis.name, "number", axis.unit, sweep_table::parameter};
    if (axis.is_text())
      results.add(field, at_points(axis.texts, axis, points));
    else
      results.add(field, at_points(axis.numbers, axis, points));
  }
  for (const NumberColumn& column : columns.numbers) {
    std::vector<double> values = index_.numbers(column.field.name, rows);
    results.add(column.field, values);
    if (const auto want = wanted.find(column.field.name); want != wanted.end()) want->second = std::move(values);
  }
  Written written;
  for (const TextColumn& column : columns.texts) {
    const std::vector<std::string> values = index_.texts(column.field.name, rows);
    results.add(column.field, values);
    take_endings(column.field.name, values, written);
  }
  return written;
}

std::size_t LongStore::write_shard(const std::vector<HashKey>& scenes, const std::vector<std::size_t>& points) {
  make_folder(folder_.parts());
  const fs::path own = folder_.part("");
  Written written;
  // Another process of this shard may end, and remove what it has taken up of our parts.
  while_they_change(
      [this] { return folder_.stored(); },
      [&](const std::vector<fs::path>& files) {
        load(files);
        std::vector<RowPlace> rows;
        for (const HashKey& scene : scenes) {
          const RowPlace* place = index_.find(scene);
          if (!place)
            throw FileError(fmt::format("rows of shard {} are gone from {}; the same command runs them again",
                                        folder_.session().options.shard, folder_.parts().string()));
          rows.push_back(*place);
        }
        LongTable table(own);
        Columns unused;
        written = write_columns(table, rows, points, unused);
        table.finish(folder_.origin());
      });
  const std::size_t shard = folder_.session().options.shard;
  std::vector<fs::path> all;
  while_they_change([&] { return all = run_names::shard_files(folder_.path(), shard); },
                    [this](const std::vector<fs::path>& files) { load(files); });
  become_shard(own, folder_.path(), shard, all);
  return static_cast<std::size_t>(std::count(written.finished.begin(), written.finished.end(), true));
}

}  // namespace ricochet
