#pragma once
// Every name and pattern of what a run leaves in its folder. Formats of results and trajectories bring their own
// extensions (sinks.hpp); here they are joined to names.

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace ricochet::run_names {

inline constexpr const char* log = "run.log";
inline constexpr const char* report = "report.html";
/// The methods and steps that trials chose, beside the folders of all scripts.
inline constexpr const char* steps = "run.steps";

/// While it is written, a file is called so; it is renamed once it is whole.
std::filesystem::path unfinished(std::filesystem::path path);

/// A sweep's results, without the extension of a format; and the file of them that can be read back.
std::filesystem::path results(const std::filesystem::path& folder);
std::filesystem::path readable_results(const std::filesystem::path& folder);
/// The folder of rows until all are there. New ones, which will replace the earlier results with all their parts, stand
/// in one of their own.
std::filesystem::path parts(const std::filesystem::path& folder);
std::filesystem::path new_parts(const std::filesystem::path& folder);
/// The rows of one batch, in either; `key` tells batches apart.
std::filesystem::path part(const std::filesystem::path& parts, const std::string& key);
/// The results and parts in a folder that can be read back: the new ones if there are some.
std::vector<std::filesystem::path> stored(const std::filesystem::path& folder);

/// Of a sweep that is run in shards: what all of them were told; the folder of their rows; of one, all its rows, and
/// those of a while until they are there, which several processes may leave; and why it ended early.
std::filesystem::path plan(const std::filesystem::path& folder);
std::filesystem::path shards(const std::filesystem::path& folder);
std::filesystem::path shard(const std::filesystem::path& folder, std::size_t k);
std::filesystem::path shard_part(const std::filesystem::path& folder, std::size_t k);
std::filesystem::path shard_error(const std::filesystem::path& folder, std::size_t k);
/// The files of rows of one shard, or of all, whole or not.
std::vector<std::filesystem::path> shard_files(const std::filesystem::path& folder, std::size_t k);
std::vector<std::filesystem::path> shard_files(const std::filesystem::path& folder);
/// Of a sweep by rounds that goes on from results of a larger error: their rows, some of which later rounds ask for.
std::filesystem::path earlier(const std::filesystem::path& folder);
/// The files of rows that were merged: results, and the earlier ones.
std::vector<std::filesystem::path> merged(const std::filesystem::path& folder);
/// All files of rows; and those that one shard goes on from: its own, and merged ones.
std::vector<std::filesystem::path> all_stored(const std::filesystem::path& folder);
std::vector<std::filesystem::path> stored_for_shard(const std::filesystem::path& folder, std::size_t k);
/// The names of all files of the shards.
std::set<std::string> shard_names(const std::filesystem::path& folder);
/// Removes the shards' rows and the plan. Throws FileError.
void remove_shards(const std::filesystem::path& folder);
/// The folder of the scripts and logs of a queue that runs the shards.
std::filesystem::path queue(const std::filesystem::path& folder);

/// True if a folder holds results or parts of them, or shards.
bool holds_results(const std::filesystem::path& folder);
/// True if parts lie there, or shards, of which results are still to be made.
bool holds_parts(const std::filesystem::path& folder);
/// Removes results, parts and shards, in all formats. Throws FileError.
void remove_results(const std::filesystem::path& folder);
/// Removes a folder of parts. Throws FileError.
void remove_parts(const std::filesystem::path& parts);

/// Picture `k` of a sequence.
std::filesystem::path frame(const std::filesystem::path& folder, std::size_t k);
inline constexpr const char* picture = ".png";
inline constexpr const char* vector_picture = ".svg";
/// How the names of films end.
inline constexpr const char* film = ".mp4";
inline constexpr const char* film_gif = ".gif";
inline constexpr const char* film_png = ".apng";
bool is_film(const std::string& name);
inline constexpr const char* plot_script = ".gp";

/// True for names (below the run's folder) of what a run leaves itself, results and log: no script may write there.
bool is_of_the_run(const std::filesystem::path& name);

/// The list of what a script's plots, pictures, films, series and recordings left in a folder: names below it, one a
/// line.
inline constexpr const char* list = "run.files";
std::set<std::string> made_in(const std::filesystem::path& folder);
void write_made(const std::filesystem::path& folder, const std::set<std::string>& names);
/// True for a folder with results and plots, but without that list: as versions before it left them.
bool has_unlisted_plots(const std::filesystem::path& folder);
/// True if something of that list is there and would be a loss: a file other than what gnuplot draws from, or a folder
/// with frames.
bool is_product(const std::filesystem::path& path);
/// Removes what a run made: a file, or the frames of a folder, and the folder if nothing else lies in it. Throws
/// FileError.
void remove_product(const std::filesystem::path& path);

}  // namespace ricochet::run_names
