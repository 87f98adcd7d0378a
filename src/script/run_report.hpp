#pragma once
// The report that a run leaves, and `ricochet report`, which makes one of stored results.

#include <filesystem>
#include <string>

#include "script/session.hpp"

namespace ricochet {

/// After a run without mistakes: report.html in the script's own folder, of the sweeps that ran and the single impacts.
/// Runs some of their impacts once more, for the replays. Nothing with --no-report, or where the run left nothing.
/// Throws FileError.
void write_report(Session& session);

/// The rows of results; of very many only the columns that a page carries, or that replays are chosen and made by.
/// Throws FileError.
Table table_of_results(const std::filesystem::path& file);

/// What `ricochet report` was asked for.
struct ReportOptions {
  std::string path, title, out;
  int replays = 6;
  int frames = 0;  ///< at most so many of each replay; 0: as many as it has
};

/// Makes a report of a results.h5, or of all in a folder or below, with the replays of an earlier report of theirs.
/// Throws FileError.
void report_of_results(const ReportOptions& options);

}  // namespace ricochet
