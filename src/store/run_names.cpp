#include "store/run_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "store/files.hpp"
#include "store/sinks.hpp"

namespace ricochet::run_names {

namespace fs = std::filesystem;

namespace {

constexpr const char* new_extension = ".new";
constexpr const char* results_stem = "results";
constexpr const char* parts_name = "parts";
constexpr const char* plan_stem = "plan";
constexpr const char* earlier_stem = "earlier";
constexpr const char* shards_name = "shards";
constexpr const char* queue_name = "slurm";
constexpr const char* error_extension = ".error";

fs::path with(fs::path path, const char* extension) { return path += extension; }

bool has_extension_of(const fs::path& path, std::initializer_list<const char*> extensions) {
  return std::find(extensions.begin(), extensions.end(), path.extension()) != extensions.end();
}

// True for frame(), whole or not.
bool is_frame(fs::path name) {
  if (has_extension_of(name, {new_extension})) name = name.stem();
  const std::string number = name.stem();
  return has_extension_of(name, {picture}) && number.size() >= 6 &&
         std::all_of(number.begin(), number.end(), [](unsigned char c) { return std::isdigit(c); });
}

bool is_part(fs::path name) { return has_extension_of(name, {rows_sinks().front().extension, new_extension}); }

// Those of a folder that are of one kind, then the folder if nothing else is left.
void remove_those(const fs::path& folder, bool (*of_kind)(fs::path)) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (of_kind(entry.path().filename())) remove_file(entry.path());
  if (fs::is_empty(folder, error)) remove_file(folder);
}

}  // namespace

fs::path unfinished(fs::path path) { return with(std::move(path), new_extension); }

fs::path results(const fs::path& folder) { return folder / results_stem; }

fs::path readable_results(const fs::path& folder) { return with(results(folder), rows_sinks().front().extension); }

fs::path parts(const fs::path& folder) { return folder / parts_name; }

fs::path new_parts(const fs::path& folder) { return unfinished(parts(folder)); }

fs::path part(const fs::path& parts, const std::string& key) {
  return with(parts / key, rows_sinks().front().extension);
}

std::vector<fs::path> stored(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  const bool replaced = fs::exists(new_parts(folder), error);
  if (!replaced && fs::exists(readable_results(folder), error)) files.push_back(readable_results(folder));
  const fs::path rows = replaced ? new_parts(folder) : parts(folder);
  if (fs::exists(rows, error))
    for (const auto& entry : fs::directory_iterator(rows))
      if (has_extension_of(entry.path(), {rows_sinks().front().extension})) files.push_back(entry.path());
  return files;
}

fs::path plan(const fs::path& folder) { return with(folder / plan_stem, rows_sinks().front().extension); }

fs::path shards(const fs::path& folder) { return folder / shards_name; }

fs::path queue(const fs::path& folder) { return folder / queue_name; }

namespace {

std::string shard_stem(std::size_t k) { return fmt::format("{:03}", k); }

// Those of the shards' folder that hold rows, in order.
std::vector<fs::path> rows_of_shards(const fs::path& folder, const std::string& stem) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(shards(folder), error)) {
    const std::string name = entry.path().stem();
    if (!has_extension_of(entry.path(), {rows_sinks().front().extension})) continue;
    if (stem.empty() || name == stem || name.starts_with(stem + "-")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

fs::path shard(const fs::path& folder, std::size_t k) {
  return with(shards(folder) / shard_stem(k), rows_sinks().front().extension);
}

fs::path shard_part(const fs::path& folder, std::size_t k) {
  return shards(folder) / own_name(shard_stem(k), rows_sinks().front().extension);
}

fs::path shard_error(const fs::path& folder, std::size_t k) {
  return with(shards(folder) / shard_stem(k), error_extension);
}

std::vector<fs::path> shard_files(const fs::path& folder, std::size_t k) {
  return rows_of_shards(folder, shard_stem(k));
}

std::vector<fs::path> shard_files(const fs::path& folder) { return rows_of_shards(folder, ""); }

fs::path earlier(const fs::path& folder) { return with(folder / earlier_stem, rows_sinks().front().extension); }

namespace {

bool is_there(const fs::path& file) {
  std::error_code error;
  return fs::exists(file, error);
}

}  // namespace

std::vector<fs::path> merged(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::path& file : {readable_results(folder), earlier(folder)})
    if (is_there(file)) files.push_back(file);
  return files;
}

std::vector<fs::path> all_stored(const fs::path& folder) {
  std::vector<fs::path> files = stored(folder);
  for (const fs::path& file : shard_files(folder)) files.push_back(file);
  if (is_there(earlier(folder))) files.push_back(earlier(folder));
  return files;
}

std::vector<fs::path> stored_for_shard(const fs::path& folder, std::size_t k) {
  std::vector<fs::path> files = shard_files(folder, k);
  for (const fs::path& file : merged(folder)) files.push_back(file);
  return files;
}

std::set<std::string> shard_names(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(shards(folder), error)) names.insert(entry.path().filename());
  return names;
}

void remove_shards(const fs::path& folder) {
  remove_those(shards(folder), [](fs::path name) { return is_part(name) || name.extension() == error_extension; });
  remove_file(plan(folder));
}

bool holds_results(const fs::path& folder) {
  std::error_code error;
  return fs::exists(readable_results(folder), error) || holds_parts(folder);
}

bool holds_parts(const fs::path& folder) {
  std::error_code error;
  return fs::exists(plan(folder), error) || fs::exists(parts(folder), error) || fs::exists(new_parts(folder), error);
}

void remove_results(const fs::path& folder) {
  for (const RowsSink& sink : rows_sinks()) remove_file(with(results(folder), sink.extension));
  remove_parts(parts(folder));
  remove_parts(new_parts(folder));
  remove_shards(folder);
  remove_file(earlier(folder));
}

void remove_parts(const fs::path& parts) { remove_those(parts, is_part); }

fs::path frame(const fs::path& folder, std::size_t k) { return folder / fmt::format("{:06}{}", k, picture); }

bool is_film(const std::string& name) {
  return name.ends_with(film) || name.ends_with(film_gif) || name.ends_with(film_png);
}

bool is_of_the_run(const fs::path& name) {
  fs::path first = *name.begin();
  if (has_extension_of(first, {new_extension})) first = first.stem();
  if (first == log || first == report || first == list || first == parts_name) return true;
  if (first == plan("").filename() || first == earlier("").filename() || first == shards_name || first == queue_name)
    return true;
  return std::any_of(rows_sinks().begin(), rows_sinks().end(),
                     [&](const RowsSink& sink) { return first == with(results_stem, sink.extension); });
}

std::set<std::string> made_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  if (!fs::is_regular_file(folder / list, error)) return names;
  std::istringstream lines(read_file(folder / list));
  const fs::path root = fs::weakly_canonical(folder, error);
  for (std::string name; std::getline(lines, name);) {
    const fs::path real = fs::weakly_canonical((folder / name).parent_path(), error);
    if (!name.empty() && is_within(real, root) && !is_of_the_run(name)) names.insert(name);  // whoever wrote the list
  }
  return names;
}

void write_made(const fs::path& folder, const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += name + "\n";
  write_atomically(folder / list, text);
}

bool has_unlisted_plots(const fs::path& folder) {
  std::error_code error;
  if (!holds_results(folder) || fs::exists(folder / list, error)) return false;
  const fs::directory_iterator entries(folder, error);
  return std::any_of(begin(entries), end(entries),
                     [](const auto& entry) { return has_extension_of(entry.path(), {plot_script}); });
}

bool is_product(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return fs::exists(path, error) && !has_extension_of(path, {plot_script});
  const fs::directory_iterator entries(path, error);
  return std::any_of(begin(entries), end(entries), [](const auto& entry) { return is_frame(entry.path().filename()); });
}

void remove_product(const fs::path& path) {
  std::error_code error;
  for (const fs::path& folder : {unfinished(path), path})
    if (fs::is_directory(fs::symlink_status(folder, error))) remove_those(folder, is_frame);
  if (fs::is_directory(fs::symlink_status(path, error))) return;
  for (const fs::path& file : {path, unfinished(path)})
    if (!fs::is_directory(fs::symlink_status(file, error))) remove_file(file);
}

}  // namespace ricochet::run_names
