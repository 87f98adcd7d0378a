#pragma once
// Impacts of a sweep that are run once more, to be seen: which ones, and how a page carries them.

#include <string>
#include <vector>

#include "impact/scene.hpp"
#include "store/table.hpp"
#include "store/trajectory.hpp"

namespace ricochet {

class Session;
struct Swept;

/// A page takes no more of nodes x frames of one replay, so that six are below 8 MB; a body of more nodes than allow
/// `fewest_frames` has none.
inline constexpr double most_node_frames = 1e6;
inline constexpr int fewest_frames = 24;

/// The sweep of this name that has run in the session; null if none has.
const Swept* swept_named(const Session& session, const std::string& name);

/// Rows of a table of results, in the order of interest. "typical": in `count` points of the sweep, spread evenly over
/// them, the impact whose e is nearest to its point's median (points that differ in `sample` or `seed` alone are one);
/// where there are fewer points, also the extremes. "extremes": those of lowest and highest e. Only finished rows.
std::vector<std::size_t> rows_to_replay(const Table& table, const std::string& how, std::size_t count);

/// When a row's impact is seen, and how often.
struct Viewing {
  double from = -1, until = 0;  ///< since the surfaces came within reach [R/c]
  double step = 0;              ///< of the impact [R/c]
  int frames = 120;
};

/// A scene's impact as one line of JSON: mesh, packed frames, a series of numbers at the same times in the scene's
/// units, the forces of the contact at up to eight times as many times, and the scene's text; of a mirrored scene as
/// seen in the mirror, as its row tells it. Empty if it has too many nodes, or was interrupted. Throws FieldError.
std::string replay_json(const Scene& scene, const Viewing& viewing);

/// The `time` and `step` of a row of these results as a viewing of its scene.
Viewing viewing_of(const Table& table, std::size_t row, const Scene& scene, int frames);

}  // namespace ricochet
