#pragma once
// A report, or another page, as one HTML file that needs no network and no server.

#include <map>
#include <string>
#include <vector>

#include "script/page_part.hpp"
#include "store/table.hpp"

namespace ricochet {

struct PageLine {
  std::string of, label;  ///< the column that it is about
  std::vector<double> x, y;
  bool marks = false;     ///< published points rather than a line of theory
  std::string against{};  ///< the column along x; empty: whatever the page has there
};

/// What a script has plotted of a sweep's rows.
struct PagePlot {
  std::string x;
  std::vector<std::string> columns;
  std::vector<PageLine> lines;
};

/// The results of one sweep on a page.
struct PageSection {
  std::string name;
  Table table;
  Provenance provenance;
  std::vector<std::string> replays{};  ///< of rows, by replay_json()
  std::string told{};                  ///< why an impact has no replay; empty if nothing needs saying
  std::vector<PagePlot> plots{};
};

struct Page {
  std::string title, notes{}, log{};
  std::vector<std::string> questions{};
  std::vector<PageLine> lines{};
  std::vector<std::string> columns{};  ///< to plot, in all sections; empty: what the script plotted, and e, mu, beta
  std::vector<PageSection> sections{};
};

/// No report is larger, as long as its rows are not: replays that would make it so are left out, and the page says so.
inline constexpr std::size_t most_page_bytes = 8'000'000;

/// More rows are carried as binary columns; of more than the second, in single precision and of the main columns only.
inline constexpr std::size_t most_text_rows = 2000, most_whole_rows = 20000;

/// True for a column that a page of so many rows keeps.
bool is_main(const Field& field);

/// The same bytes for the same page: nothing of the clock or the machine is added.
std::string html_of(const Page& page);

/// What any page is put together of: its frame, styles and scripts (of render/report), and what stands in them.
struct PageParts {
  const char* frame;
  const char* kind;  ///< "report" or "lesson"
  std::vector<PagePart> styles, code;
  std::string title, lead{}, data{}, replays{}, script{};
};
std::string assembled(const PageParts& parts);

/// As much of a run's log as fits on some screens.
std::string shown_log(const std::string& log);

/// A section as the page's data hold it.
std::string section_json(const PageSection& section, const std::string& told);
/// The element that holds a replay by replay_json().
std::string replay_element(const std::string& replay);
/// The script that made a section.
std::string script_in(const PageSection& section);

/// The replays in the text of an earlier report, by the hash of their scene, as replay_json() gave them.
std::map<std::string, std::string> replays_in(const std::string& html);

}  // namespace ricochet
