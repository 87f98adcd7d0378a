#include "script/shard_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "impact/batch.hpp"
#include "impact/launch/launch.hpp"
#include "script/digest.hpp"
#include "script/known_rows.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// Steps of the first impact whose outcome is compared: the first meets every spring, and so many cost a hundredth of a
// usual impact, and little of a small one.
constexpr double canary_steps = 30;

std::string sorted_words(std::vector<std::string> words) {
  std::sort(words.begin(), words.end());
  return fmt::format("{}", fmt::join(words, " "));
}

// The files beside the script that it requires. The library is the program's.
std::string required_by(const Session& session) {
  std::string text;
  for (const auto& [name, source] : session.sources)
    if (name != session.script.string() && !is_within(name, session.library))
      text += fmt::format("{} {}\n", hash_text(source), fs::path(name).filename().string());
  return text;
}

/// What differs, in words, by the fact's name; and what to do.
struct Fact {
  const char* name;
  const char* says;
};

constexpr Fact facts[] = {
    {"version", "by another version of ricochet"},
    {"commit", "by another commit of ricochet"},
    {"script_hash", "of another text of the script"},
    {"required", "with other files that the script requires"},
    {"arguments", "with other parameters"},
    {"over", "for other values of 'over'"},
    {"first_scene", "where the script makes another scene of the first point"},
    {"canary",
     "where the first impact comes to other bits, so that this machine, that one or a build computes wrongly"},
};

// A line each: "40 lattice sample", "3 alike psi1".
std::string text_of(const std::vector<SweptName>& over) {
  std::string text;
  for (const SweptName& name : over)
    text += fmt::format("{} {} {}\n", name.values, name.changes_lattice ? "lattice" : "alike", name.name);
  return text;
}

std::vector<SweptName> over_of(const std::string& text) {
  std::vector<SweptName> over;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(' '), second = line.find(' ', first + 1);
    if (second == std::string::npos) throw std::invalid_argument(line);
    over.push_back({line.substr(second + 1), std::stoul(line), line.compare(first, second - first, " lattice") == 0});
  }
  return over;
}

}  // namespace

std::size_t ShardPlan::points() const {
  std::size_t count = 1;
  for (const SweptName& name : over) count *= name.values;
  return count;
}

std::size_t ShardPlan::impacts() const {
  const auto told = facts.find("impacts");
  return told == facts.end() ? points() : std::stoul(told->second);
}

std::size_t ShardPlan::shard_of(std::size_t point) const {
  std::size_t lattice = 0, lattice_stride = 1, rest = 0, rest_stride = 1;
  for (std::size_t n = over.size(); n-- > 0;) {
    const std::size_t digit = point % over[n].values;
    point /= over[n].values;
    std::size_t& stride = over[n].changes_lattice ? lattice_stride : rest_stride;
    (over[n].changes_lattice ? lattice : rest) += digit * stride;
    stride *= over[n].values;
  }
  const std::size_t pieces = (shards + lattice_stride - 1) / lattice_stride;
  const std::size_t card = lattice * pieces + rest % pieces;
  return (card + card / shards) % shards;
}

std::vector<std::size_t> ShardPlan::points_of(std::size_t shard) const {
  std::vector<std::size_t> own;
  for (std::size_t point = 0; point < points(); ++point)
    if (shard_of(point) == shard) own.push_back(point);
  return own;
}

Scene ShardPlan::with_step(Scene scene, std::size_t point) const {
  if (steps.rows() == 0 || std::isnan(scene.integration.accuracy)) return scene;
  scene.integration.accuracy = not_given;
  scene.integration.method = steps.text("method")->values[point];
  scene.integration.theta = steps.number("theta")->values[point];
  scene.error_step = steps.number("error_step")->values[point];
  scene.error_contact = steps.number("error_contact")->values[point];
  return scene;
}

Scene ShardPlan::with_planned_step(Scene scene, std::size_t point) const {
  if (steps.rows() == 0 && !std::isnan(scene.integration.accuracy))
    throw FieldError("accuracy",
                     "is given at this point and not at the first, so that the plan of the shards has no step for it; "
                     "give it at every point, or at none");
  return with_step(std::move(scene), point);
}

void add_step(Table& table, const Scene& scene) {
  if (table.numbers.empty())
    table = {{{{"theta"}, {}}, {{"error_step"}, {}}, {{"error_contact"}, {}}}, {{{"method"}, {}}}};
  table.numbers[0].values.push_back(scene.integration.theta);
  table.numbers[1].values.push_back(scene.error_step);
  table.numbers[2].values.push_back(scene.error_contact);
  table.texts[0].values.push_back(scene.integration.method);
}

Provenance facts_of(const Session& session) {
  Provenance p = Session::made_by();
  p["arguments"] = sorted_words(session.arguments);
  p["script_hash"] = hash_text(session.sources.at(session.script.string()));
  p["required"] = required_by(session);
  return p;
}

bool is_of_results(const Provenance& facts, const Provenance& results) {
  const auto of_results = [&](const char* name) {
    const auto found = results.find(name);
    return found == results.end() ? "" : found->second;
  };
  std::istringstream lines(of_results("arguments"));
  std::vector<std::string> arguments;
  for (std::string line; std::getline(lines, line);) arguments.push_back(line);
  return of_results("script_hash") == facts.at("script_hash") && sorted_words(arguments) == facts.at("arguments");
}

std::string canary_of(const Scene& scene) {
  Scene cut = scene;
  cut.ending = {};
  cut.integration.time_limit = not_given;
  const BuiltSolids solids(cut);
  cut.integration.time_limit = canary_steps * launch(cut, solids).step;
  if (stop_requested) throw Error("interrupted", Exit::interrupted);
  const Row row = row_of(cut, run_scene(solids, cut, stop_requested), 0);
  return digest_of(table_of({&row}));
}

bool write_plan(const fs::path& folder, const ShardPlan& plan, const Provenance& provenance) {
  Provenance all = provenance;
  for (const auto& [name, text] : plan.facts) all[name] = text;
  all["shards"] = fmt::format("{}", plan.shards);
  all["names"] = text_of(plan.over);
  make_folder(folder);
  const fs::path own = folder / own_name("plan", ".h5");
  write_table(own, plan.steps, all);
  const bool first = link_first(own, run_names::plan(folder));
  remove_file(own);
  return first;
}

ShardPlan read_plan(const fs::path& folder) {
  const fs::path path = run_names::plan(folder);
  ShardPlan plan{.facts = read_provenance(path), .steps = read_table(path)};
  try {
    plan.shards = std::stoul(plan.facts.at("shards"));
    plan.over = over_of(plan.facts.at("names"));
    if (plan.shards == 0 || plan.impacts() == 0) throw std::invalid_argument("a count");
  } catch (const std::logic_error&) {
    throw FileError(fmt::format("{} is no plan of shards; remove it, or give another --out", path.string()));
  }
  return plan;
}

void refuse_other(const ShardPlan& plan, const Provenance& own, const fs::path& folder) {
  for (const Fact& fact : facts) {
    const auto here = own.find(fact.name), there = plan.facts.find(fact.name);
    if (here == own.end()) continue;
    const std::string planned = there == plan.facts.end() ? "nothing" : there->second;
    if (planned == here->second) continue;
    const auto host = plan.facts.find("host");
    throw FileError(fmt::format(
        "{} was made {}: '{}', here '{}' (the plan is of {}); run all shards and merge with the same, or give another "
        "--out",
        run_names::plan(folder).string(), fact.says, planned, here->second,
        host == plan.facts.end() ? "an unknown host" : "host " + host->second));
  }
}

}  // namespace ricochet
