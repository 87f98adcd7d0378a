#include "script/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "impact/parallel.hpp"
#include "script/page.hpp"
#include "script/replays.hpp"
#include "script/sweep_store.hpp"
#include "script/terminal.hpp"
#include "script/thinned.hpp"
#include "store/files.hpp"
#include "store/long_table.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// Replays of a run may take a tenth of the time that its impacts took, or so long, whichever is more. [s]
constexpr double little_time = 5;

// "A soft wall at three angles", if the script begins with "-- A soft wall at three angles.".
std::string title_of(const std::string& script, const std::string& name) {
  std::string line = script.substr(0, script.find('\n'));
  if (!line.starts_with("--")) return fs::path(name).filename();
  line.erase(0, line.find_first_not_of("- "));
  if (line.size() > 110) line = line.substr(0, line.find(' ', 90)) + " ...";
  while (line.ends_with('.') && !line.ends_with("...")) line.pop_back();
  return line.empty() ? fs::path(name).filename().string() : line;
}

std::string text_in(const Provenance& provenance, const std::string& name) {
  const auto found = provenance.find(name);
  return found == provenance.end() ? "" : found->second;
}

std::string log_in(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / run_names::log, error)) return "";
  return shown_log(read_file(folder / run_names::log));
}

using SceneOfRow = decltype(Swept::scene_of);

struct Replay {
  Scene scene;
  Viewing viewing;
  std::string json;
};

double seconds_of(const Table& table, std::size_t row) {
  const NumberColumn* column = table.number("wall_seconds");
  return column ? column->values[row] : 0;
}

// The rows of the table that are to be replayed: all that the script has named, or so many.
std::vector<std::size_t> rows_wanted(const Table& table, const PageWish& wish, std::size_t count) {
  if (wish.hashes.empty()) return rows_to_replay(table, wish.which, count);
  const TextColumn* hashes = table.text("scene_hash");
  std::vector<std::size_t> rows;
  for (const std::string& hash : wish.hashes) {
    const auto found = std::find(hashes->values.begin(), hashes->values.end(), hash);
    if (found != hashes->values.end()) rows.push_back(static_cast<std::size_t>(found - hashes->values.begin()));
  }
  return rows;
}

// The scenes to run once more: of rows that the script has named, or of those chosen that time allows.
std::vector<Replay> planned_replays(const PageSection& section, const SceneOfRow& scene_of, const PageWish& wish,
                                    std::size_t count) {
  const Table& table = section.table;
  const TextColumn* hashes = table.text("scene_hash");
  double all = 0, taken = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) all += seconds_of(table, row);
  std::vector<Replay> replays;
  for (const std::size_t row : rows_wanted(table, wish, count)) {
    const std::optional<Scene> scene = scene_of(hashes->values[row]);
    if (!scene) continue;
    taken += 2 * seconds_of(table, row);  // watched, and alone in its lanes
    const bool is_asked = !wish.hashes.empty();
    if (!is_asked && taken > std::max(little_time, all / 10)) break;
    replays.push_back({*scene, viewing_of(table, row, *scene, wish.frames), ""});
  }
  return replays;
}

// A scene that cannot be shown has no replay, and the page says why.
void add_replays(Session& session, PageSection& section, const SceneOfRow& scene_of, std::size_t count) {
  std::vector<Replay> replays = planned_replays(section, scene_of, session.page, count);
  std::string refused;
  std::mutex telling;
  in_parallel(replays, session.options.threads, [&](Replay& replay) {
    try {
      replay.json = replay_json(replay.scene, replay.viewing);
    } catch (const FieldError& error) {
      const std::lock_guard lock(telling);
      refused = error.what();
    }
  });
  for (Replay& replay : replays)
    if (!replay.json.empty()) section.replays.push_back(std::move(replay.json));
  if (!section.replays.empty() || count == 0) return;
  if (!refused.empty())
    section.told = "No impact has a replay: " + refused + ".";
  else if (!session.page.hashes.empty())
    section.told = "No impact of this sweep was chosen to be replayed.";
  else if (rows_to_replay(section.table, session.page.which, 1).empty())
    section.told = "No impact finished, so none has a replay.";
  else
    section.told = fmt::format(
        "No impact has a replay: one would take more than a tenth of the run's time, or has more than {} nodes.",
        static_cast<int>(most_node_frames / fewest_frames));
}

// What the script has plotted of the section's rows.
void add_plots(const Session& session, PageSection& section) {
  const TextColumn* hashes = section.table.text("scene_hash");
  if (!hashes) return;
  for (const auto& [hash, plot] : session.plotted)
    if (std::find(hashes->values.begin(), hashes->values.end(), hash) != hashes->values.end())
      section.plots.push_back(plot);
}

Page page_of_run(Session& session) {
  Page page;
  const Provenance provenance = session.provenance();
  page.title = session.page.title.empty() ? title_of(text_in(provenance, "script"), session.script.string())
                                          : session.page.title;
  page.notes = session.page.notes;
  page.questions = session.page.questions;
  page.lines = session.page.lines;
  page.columns = session.page.plots;
  page.log = log_in(session.own_folder());
  const std::size_t parts = session.swept.size() + !session.singles.empty();
  const std::size_t all = static_cast<std::size_t>(session.page.replays);
  const std::size_t count = all == 0 ? 0 : std::max<std::size_t>(1, all / std::max<std::size_t>(1, parts));
  for (const Swept& swept : session.swept) {
    const fs::path file = run_names::readable_results(swept.folder);
    page.sections.push_back({swept.name, table_of_results(file), read_provenance(file)});
    if (page.log.empty()) page.log = log_in(swept.folder);
    add_plots(session, page.sections.back());
    add_replays(session, page.sections.back(), swept.scene_of, count);
  }
  if (session.singles.empty()) return page;
  std::vector<const Row*> rows;
  for (const auto& [scene, row] : session.singles) rows.push_back(&row);
  const auto scene_of = [&](const std::string& hash) {
    const auto found = std::find_if(session.singles.begin(), session.singles.end(),
                                    [&](auto& one) { return one.second.hash == hash; });
    return found == session.singles.end() ? std::nullopt : std::optional<Scene>(found->first);
  };
  page.sections.push_back({"single impacts", table_of(rows), provenance});
  add_replays(session, page.sections.back(), scene_of, count);
  return page;
}

// Where results lie: the file, or those in a folder and below.
std::vector<fs::path> results_at(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw FileError(fmt::format("{} is not there; name a run's folder", path.string()));
  if (!fs::is_directory(path, error)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (entry.path() == run_names::readable_results(entry.path().parent_path())) files.push_back(entry.path());
  if (files.empty())
    throw FileError(
        fmt::format("the folder {} holds no results.h5; name the folder of a sweep, or of all", path.string()));
  std::sort(files.begin(), files.end());
  return files;
}

// Of an earlier report: beside the results, or in the folder of the script that made them.
std::map<std::string, std::string> earlier_replays(const fs::path& results, const Provenance& provenance) {
  const fs::path folder = fs::absolute(results).parent_path();
  const fs::path own = folder.parent_path() / fs::path(text_in(provenance, "script_name")).stem();
  std::map<std::string, std::string> replays;
  std::error_code error;
  for (const fs::path& place : {own, folder})
    if (fs::exists(place / run_names::report, error))
      for (auto& [hash, replay] : replays_in(read_file(place / run_names::report))) replays[hash] = replay;
  return replays;
}

PageSection section_of(const fs::path& file, std::size_t most, int frames) {
  const fs::path folder = fs::absolute(file).parent_path();
  PageSection section{folder.filename(), table_of_results(file), read_provenance(file)};
  const std::map<std::string, std::string> replays = earlier_replays(file, section.provenance);
  if (const TextColumn* hashes = section.table.text("scene_hash"))
    for (const std::string& hash : hashes->values)
      if (const auto replay = replays.find(hash); replay != replays.end() && section.replays.size() < most)
        section.replays.push_back(frames > 0 ? thinned(replay->second, frames) : replay->second);
  if (section.replays.empty() && most > 0)
    section.told = "No report of an earlier run with replays of these impacts was found; ricochet run makes them.";
  return section;
}

// A sweep's folder is called as the sweep, that of plots and the report as the script: where both are, it is told.
void tell_folders(const Session& session) {
  constexpr std::size_t most = 3;
  const fs::path own = session.own_folder();
  std::vector<std::string> others;
  for (const Swept& swept : session.swept)
    if (swept.folder != own) others.push_back(swept.folder.string());
  if (others.empty() || !session.folders.claimed(own) || session.options.quiet) return;
  const std::size_t more = others.size() - std::min(most, others.size());
  others.resize(others.size() - more);
  put(fmt::format("folders: rows of sweeps in {}{}; all else of the script in {}\n", fmt::join(others, ", "),
                  more > 0 ? fmt::format(" and {} more", more) : "", own.string()));
}

}  // namespace

Table table_of_results(const fs::path& file) {
  const StoredTable stored(file);
  const bool all = stored.rows() <= most_whole_rows;
  static const std::set<std::string> others{"scene_hash", "reason", "wall_seconds", "time", "step"};
  return stored.part(0, stored.rows(),
                     [&](const Field& field) { return all || is_main(field) || others.contains(field.name); });
}

void write_report(Session& session) {
  const fs::path folder = session.own_folder();
  // An earlier one would pass for that of the new results.
  if (!session.options.report && session.options.force && session.folders.claimed(folder))
    remove_file(folder / run_names::report);
  if (session.options.check || !session.options.study.empty() || session.done) return;
  if (session.swept.empty() && session.singles.empty()) return;
  if (session.options.report) {
    session.folders.claim(folder);
    const Page page = page_of_run(session);
    if (stop_requested) throw Error("interrupted before the report; the results are stored", Exit::interrupted);
    write_atomically(folder / run_names::report, html_of(page));
    if (!session.options.quiet) put(fmt::format("report: {}\n", (folder / run_names::report).string()));
  }
  tell_folders(session);
}

void report_of_results(const ReportOptions& options) {
  const std::vector<fs::path> files = results_at(options.path);
  Page page;
  const std::size_t all = static_cast<std::size_t>(options.replays);
  for (const fs::path& file : files)
    page.sections.push_back(
        section_of(file, all == 0 ? 0 : std::max<std::size_t>(1, all / files.size()), options.frames));
  const Provenance& provenance = page.sections.front().provenance;
  page.title = options.title.empty() ? title_of(text_in(provenance, "script"), text_in(provenance, "script_name"))
                                     : options.title;
  page.log = log_in(fs::absolute(files.front()).parent_path());
  std::error_code error;
  const fs::path place =
      fs::is_directory(options.path, error) ? fs::path(options.path) : fs::absolute(files.front()).parent_path();
  const fs::path out = options.out.empty() ? place / run_names::report : fs::path(options.out);
  write_atomically(out, html_of(page));
  putf("report: {}\n", out.string());
}

}  // namespace ricochet
