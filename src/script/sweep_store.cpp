#include "script/sweep_store.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "script/digest.hpp"
#include "script/shard_store.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"
#include "store/sinks.hpp"

namespace ricochet {

namespace fs = std::filesystem;

Store::Store(Session& session, const std::string& name, const std::vector<std::string>& hashes,
             const Parameters& parameters, const Earlier& earlier)
    : RowStore(hashes),
      session_(session),
      folder_(session.folders.named(name)),
      parts_(run_names::parts(folder_)),
      parameters_(parameters) {
  std::error_code error;
  merges_ = session.options.part == Part::merge;
  if (!merges_ && !session.options.force && fs::exists(run_names::plan(folder_), error))
    throw FileError(fmt::format(
        "{} holds shards of this sweep; ricochet merge makes results of them, --force drops them", folder_.string()));
  session.folders.claim(folder_);
  if (session.options.force || (session.options.resume && fs::exists(run_names::new_parts(folder_), error)))
    parts_ = run_names::new_parts(folder_);
  if (earlier.taken) load(earlier.strangers);
}

void Store::add(const std::vector<std::pair<std::size_t, Row>>& batch) {
  std::vector<const Row*> rows;
  std::vector<std::size_t> places;
  std::string key;
  for (const auto& [index, row] : batch) {
    rows.push_back(&row);
    places.push_back(index);
    key += row.hash;
  }
  if (session_.options.force && count() == 0) run_names::remove_parts(parts_);  // of another try
  make_folder(parts_);
  Table table = table_of(rows);
  parameters_.add_to(table, places);
  write_table(run_names::part(parts_, hash_text(key)), table, session_.made_by());
  for (const auto& [index, row] : batch) known_.accept(row);
}

bool Store::replaces() const {
  std::error_code error;
  return parts_ == run_names::new_parts(folder_) &&
         (fs::exists(run_names::readable_results(folder_), error) || fs::exists(run_names::plan(folder_), error));
}

void Store::stop_early() {
  if (!replaces()) assemble();
}

std::string Store::left_behind() const {
  return fmt::format("{} of {} impacts are stored in {}; {}--resume goes on from there{}", count(), rows().size(),
                     folder_.string(), session_.options.fresh ? "--new " : "",
                     replaces() ? ", and the earlier results stay until all are there" : "");
}

std::string Store::assemble() {
  Table table = table_of(known_.list());
  parameters_.add_to(table, known_.places());
  write_everywhere(run_names::results(folder_), table, session_.provenance());
  for (const fs::path& parts : {run_names::parts(folder_), run_names::new_parts(folder_)})
    run_names::remove_parts(parts);
  if (count() == rows().size()) run_names::remove_shards(folder_);
  session_.folders.results_are_whole(folder_);
  return digest_of(table);
}

void Store::load(bool strangers_too) {
  const auto files = [this] {
    std::vector<fs::path> list = run_names::stored(folder_);
    if (!merges_) return list;
    for (const fs::path& file : run_names::shard_files(folder_)) list.push_back(file);
    return list;
  };
  const std::size_t strangers = load_while_they_change(known_, files);
  if (strangers > 0 && !strangers_too)
    throw FileError(fmt::format(
        "{} holds {} rows of other scenes than this sweep's, which --resume would lose; use the same parameters (and "
        "the same scenes where accuracy chooses the step: trials of them chose it), --force, or another --out",
        folder_.string(), strangers));
}

}  // namespace ricochet
