#include "store/run_names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "store/sinks.hpp"

namespace ricochet::run_names {

namespace fs = std::filesystem;

namespace {

constexpr const char* new_extension = ".new";
constexpr const char* results_stem = "results";
constexpr const char* parts_name = "parts";

fs::path with(fs::path path, const char* extension) { return path += extension; }

bool has_extension_of(const fs::path& path, std::initializer_list<const char*> extensions) {
  return std::find(extensions.begin(), extensions.end(), path.extension()) != extensions.end();
}

// A folder of frames holds nothing but frames.
bool is_folder_of_frames(const fs::path& path) {
  if (!fs::is_directory(path) || fs::is_empty(path)) return false;
  const auto is_frame = [](const fs::directory_entry& entry) {
    return has_extension_of(entry.path(), {picture, new_extension});
  };
  return std::all_of(fs::directory_iterator(path), fs::directory_iterator(), is_frame);
}

}  // namespace

fs::path unfinished(fs::path path) { return with(std::move(path), new_extension); }

fs::path results(const fs::path& folder) { return folder / results_stem; }

fs::path readable_results(const fs::path& folder) { return with(results(folder), rows_sinks().front().extension); }

fs::path parts(const fs::path& folder) { return folder / parts_name; }

fs::path part(const fs::path& folder, const std::string& key) {
  return with(parts(folder) / key, rows_sinks().front().extension);
}

std::vector<fs::path> stored(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  if (fs::exists(readable_results(folder), error)) files.push_back(readable_results(folder));
  if (fs::exists(parts(folder), error))
    for (const auto& entry : fs::directory_iterator(parts(folder)))
      if (has_extension_of(entry.path(), {rows_sinks().front().extension})) files.push_back(entry.path());
  return files;
}

bool holds_results(const fs::path& folder) {
  std::error_code error;
  return fs::exists(readable_results(folder), error) || fs::exists(parts(folder), error);
}

void remove_results(const fs::path& folder) {
  for (const RowsSink& sink : rows_sinks()) fs::remove_all(with(results(folder), sink.extension));
  fs::remove_all(parts(folder));
}

fs::path frame(const fs::path& folder, std::size_t k) { return folder / fmt::format("{:06}{}", k, picture); }

bool is_of_the_run(const fs::path& name) {
  fs::path first = *name.begin();
  if (has_extension_of(first, {new_extension})) first = first.stem();
  if (first == log || first == parts_name) return true;
  return std::any_of(rows_sinks().begin(), rows_sinks().end(),
                     [&](const RowsSink& sink) { return first == with(results_stem, sink.extension); });
}

bool is_product(const fs::path& path) {
  if (is_of_the_run(path.filename())) return false;
  if (has_extension_of(path, {picture, vector_picture, film, plot_script, new_extension})) return true;
  for (const TrajectorySink& sink : trajectory_sinks())
    if (has_extension_of(path, {sink.extension})) return true;
  // A series, whose readable file stands beside the others.
  for (const RowsSink& sink : rows_sinks())
    if (has_extension_of(path, {sink.extension}))
      return fs::exists(fs::path(path).replace_extension(rows_sinks().front().extension));
  return is_folder_of_frames(path);
}

}  // namespace ricochet::run_names
