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
    : RowStore(hashes), folder_(session, name), parameters_(parameters) {
  if (!earlier.taken) return;
  strangers_ = load_while_they_change(known_, [this] { return folder_.stored(); });
  if (!earlier.strangers) folder_.refuse_strangers(strangers_);
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
  if (folder_.session().options.force && count() == 0) run_names::remove_parts(folder_.parts());  // of another try
  make_folder(folder_.parts());
  Table table = table_of(rows);
  parameters_.add_to(table, places);
  write_table(run_names::part(folder_.parts(), hash_text(key)), table, Session::made_by());
  for (const auto& [index, row] : batch) known_.accept(row);
}

void Store::stop_early() {
  if (!folder_.replaces()) assemble();
}

std::string Store::assemble() {
  Table table = table_of(known_.list());
  parameters_.add_to(table, known_.places());
  write_everywhere(run_names::results(folder()), table, folder_.session().provenance());
  folder_.results_are_written(count() == rows().size());
  return digest_of(table);
}

}  // namespace ricochet
