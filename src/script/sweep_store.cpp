#include "script/sweep_store.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "script/digest.hpp"
#include "script/shard_store.hpp"
#include "script/sweep_table.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"
#include "store/sinks.hpp"

namespace ricochet {

namespace fs = std::filesystem;

std::string Parameters::place(std::size_t scene) const {
  std::string text;
  for (std::size_t p = 0; p < names.size(); ++p)
    text += fmt::format("{}{} = {}", p ? ", " : "", names[p],
                        texts[p].empty() ? fmt::format("{:g}", numbers[p][scene]) : "'" + texts[p][scene] + "'");
  return text;
}

Store::Store(Session& session, const std::string& name, const std::vector<std::string>& hashes,
             const Parameters& parameters, const Earlier& earlier)
    : RowStore(hashes), folder_(session, name), parameters_(parameters) {
  if (!earlier.taken) return;
  const std::size_t strangers = load_while_they_change(
      known_, [this] { return folder_.stored(); }, session.made_by());
  if (!earlier.strangers) folder_.refuse_strangers(strangers);
}

void Store::add(const std::vector<std::pair<std::size_t, Row>>& batch) {
  std::vector<const Row*> rows;
  std::string key;
  for (const auto& [index, row] : batch) {
    rows.push_back(&row);
    key += row.hash;
  }
  if (folder_.session().options.force && count() == 0) run_names::remove_parts(folder_.parts());  // of another try
  make_folder(folder_.parts());
  write_table(run_names::part(folder_.parts(), hash_text(key)), table_of(rows), Session::made_by());
  for (const auto& [index, row] : batch) known_.accept(row);
}

void Store::stop_early() {
  if (!folder_.replaces()) assemble();
}

std::string Store::assemble() {
  Table table = table_of(known_.list());
  const std::vector<std::size_t> scenes = known_.places();
  for (std::size_t p = parameters_.names.size(); p-- > 0;) add_parameter(table, p, scenes);
  write_everywhere(run_names::results(folder()), table, folder_.session().provenance());
  folder_.results_are_written(count() == rows().size());
  return digest_of(table);
}

void Store::add_parameter(Table& table, std::size_t p, const std::vector<std::size_t>& scenes) const {
  const std::string& name = parameters_.names[p];
  // An outcome of the same name is what the impact had; the parameter is what the sweep asked for: keep both.
  const Field field{table.number(name) || table.text(name) ? "over_" + name : name, "number", parameters_.units[p],
                    sweep_table::parameter};
  if (!parameters_.texts[p].empty()) {
    table.texts.insert(table.texts.begin(), {field, {}});
    for (const std::size_t i : scenes) table.texts.front().values.push_back(parameters_.texts[p][i]);
  } else {
    table.numbers.insert(table.numbers.begin(), {field, {}});
    for (const std::size_t i : scenes) table.numbers.front().values.push_back(parameters_.numbers[p][i]);
  }
}

}  // namespace ricochet
