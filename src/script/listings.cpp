#include "script/listings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "core/spelling.hpp"
#include "effect/catalogue.hpp"
#include "script/digest.hpp"
#include "script/fields.hpp"
#include "script/stored_rows.hpp"
#include "script/terminal.hpp"
#include "store/h5md.hpp"
#include "store/run_names.hpp"
#include "store/table.hpp"
#include "theory/catalogue.hpp"
#include "theory/claims.hpp"
#include "theory/errata.hpp"

namespace ricochet {

namespace fs = std::filesystem;
namespace {

// Lines of at most `width` bytes, each after `indent`.
std::string wrapped(const std::string& text, const std::string& indent, std::size_t width = 120) {
  std::string result, line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!line.empty() && indent.size() + line.size() + 1 + word.size() > width) {
      result += indent + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return result + indent + line + "\n";
}

// "name           first line", the other lines below the first.
std::string named_lines(const std::string& name, const std::string& text) {
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    result += fmt::format("{:<14} {}\n", result.empty() ? name : "", line);
  return result;
}

void print_table(const Table& table) {
  putf("{} rows\n", table.rows());
  if (const TextColumn* status = table.text("status")) {
    std::map<std::string, int> counts;
    for (const std::string& value : status->values) ++counts[value];
    for (const auto& [value, count] : counts) putf("  {:<14} {}\n", value, count);
  }
  for (const TextColumn& column : table.texts) putf("  {:<28} {}\n", column.field.name, column.field.doc);
  for (const NumberColumn& column : table.numbers)
    putf("  {:<28} {}\n",
         column.field.unit.empty() ? column.field.name : fmt::format("{} [{}]", column.field.name, column.field.unit),
         column.field.doc);
}

}  // namespace

void print_effects() {
  each_effect_kind([]<class E>(const E&) {
    putf("{}: {}\n  {}\n", E::name, E::doc, E::example);
    for (const Field& f : fields_of<E>())
      putf("    {:<12}{}{}{}\n", f.name, f.doc, f.unit.empty() ? "" : " [" + f.unit + "]",
           f.initial.empty() ? "" : " (default " + f.initial + ")");
    if (E::energy_doc) putf("  column {}_energy: {}\n", E::name, E::energy_doc);
    if constexpr (SpringChange<E>) putf("  column {}_springs: {}\n", E::name, E::count_doc);
    putf("\n");
  });
  putf(
      "What a scene does not name in `effects = {{ ... }}` is not computed; ricochet effects --cost measures what each "
      "costs.\n");
}

void print_theories(const std::string& name) {
  std::vector<std::string> known;
  for (const theory::Theory& t : theory::theories()) {
    known.push_back(t.name);
    if (!name.empty() && t.name != name) continue;
    std::string names;
    for (const Field& f : t.arguments) names += (names.empty() ? "" : ", ") + f.name;
    putf("{} {{ {} }}\n{}{}{}", t.name, names, wrapped(t.says, "  "), wrapped("valid: " + t.valid, "  "),
         wrapped("source: " + t.source, "  "));
  }
  if (!name.empty() && std::find(known.begin(), known.end(), name) == known.end()) {
    known.push_back("errata");
    throw Error(
        fmt::format(
            "there is no theory '{}'{}; ricochet theory lists them, ricochet theory errata the paper's misprints", name,
            did_you_mean(name, known)),
        Exit::usage);
  }
  putf(
      "\nAs ricochet.theory.NAME {{ field = value, ... }} in a script; fields, units and results in lua/REFERENCE.md, "
      "sources in src/theory/references.bib.\n"
      "Misprints of the paper: ricochet theory errata\n");
}

void print_errata() {
  int number = 0;
  for (const theory::Misprint& m : theory::errata())
    putf("{}. {}\n{}{}{}\n", ++number, m.where, wrapped(std::string("printed: ") + m.printed, "   "),
         wrapped(std::string("right:   ") + m.right, "   "), wrapped(std::string("checked: ") + m.checked, "   "));
  putf(
      "\nWhat the paper says of its simulation, whose text leaves the model open, and what gives it "
      "(scripts/readings.lua, scripts/four_claims.lua):\n\n");
  for (const theory::Claim& claim : theory::claims())
    putf("{}\n{}{}{}\n", claim.where, wrapped(std::string("printed: ") + claim.printed, "   "),
         wrapped(std::string("can be had: ") + claim.had, "   "), wrapped(std::string("by: ") + claim.by, "   "));
}

namespace {

// A sweep's folder of which results are still to be made; else the file of those, where a folder has some.
fs::path meant_in(const fs::path& folder) {
  return run_names::holds_parts(folder) ? folder : run_names::readable_results(folder);
}

// What is meant: a file; of a folder what meant_in() says, or of those below it where there is but one.
fs::path meant(const fs::path& path) {
  if (path.extension() == ".csv")
    throw FileError(
        fmt::format("{} is text, which says of itself only its columns; give the .h5 beside it", path.string()));
  if (!fs::is_directory(path)) return path;
  if (run_names::holds_results(path)) return meant_in(path);
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (fs::is_directory(entry.path()) && run_names::holds_results(entry.path()))
      found.push_back(meant_in(entry.path()));
  if (found.size() == 1) return found.front();
  if (found.empty()) throw FileError(fmt::format("the folder {} holds no results.h5; name a file", path.string()));
  std::sort(found.begin(), found.end());
  std::string names;
  for (const fs::path& file : found) names += (names.empty() ? "" : ", ") + file.string();
  throw FileError(fmt::format("the folder {} holds {} results: name one of {}", path.string(), found.size(), names));
}

void print_results(const Table& table) {
  print_table(table);
  if (table.text("scene_hash")) putf("digest of outcomes {}\n", digest_of(table));
}

}  // namespace

void print_info(const std::string& given) {
  const fs::path path = meant(given);
  if (fs::is_directory(path)) {
    putf("{}: a run or shards are at work there, or were cut off; stored so far:\n", path.string());
    return print_results(stored_rows(path));
  }
  for (const auto& [name, text] : read_provenance(path))
    if (name != "script" && !text.empty()) put(named_lines(name, text));
  if (is_trajectory(path))
    putf("a trajectory (H5MD)\n");
  else
    print_results(read_table(path));
}

}  // namespace ricochet
