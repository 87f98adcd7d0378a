#pragma once
// Every name and pattern of what a run leaves in its folder. Formats of results and trajectories bring their own
// extensions (sinks.hpp); here they are joined to names.

#include <filesystem>
#include <string>
#include <vector>

namespace ricochet::run_names {

inline constexpr const char* log = "run.log";

/// While it is written, a file is called so; it is renamed once it is whole.
std::filesystem::path unfinished(std::filesystem::path path);

/// A sweep's results, without the extension of a format; and the file of them that can be read back.
std::filesystem::path results(const std::filesystem::path& folder);
std::filesystem::path readable_results(const std::filesystem::path& folder);
/// The rows of one batch, until all are there; `key` tells batches apart.
std::filesystem::path part(const std::filesystem::path& folder, const std::string& key);
std::filesystem::path parts(const std::filesystem::path& folder);
/// The results and parts in a folder that can be read back.
std::vector<std::filesystem::path> stored(const std::filesystem::path& folder);
/// True if a folder holds any of them.
bool holds_results(const std::filesystem::path& folder);
/// Removes results and parts, in all formats.
void remove_results(const std::filesystem::path& folder);

/// Picture `k` of a sequence.
std::filesystem::path frame(const std::filesystem::path& folder, std::size_t k);
inline constexpr const char* picture = ".png";
inline constexpr const char* vector_picture = ".svg";
inline constexpr const char* film = ".mp4";
inline constexpr const char* plot_script = ".gp";

/// True for names (below the run's folder) of what a run leaves itself, results and log: no script may write there.
bool is_of_the_run(const std::filesystem::path& name);

/// True for what a script's plots, pictures, films, series and recordings leave.
bool is_product(const std::filesystem::path& path);

}  // namespace ricochet::run_names
