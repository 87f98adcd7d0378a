#include "script/replays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "impact/batch.hpp"
#include "impact/launch/launch.hpp"
#include "record/film.hpp"
#include "record/whole_section.hpp"
#include "sandbox/sandbox.hpp"
#include "script/filmed.hpp"
#include "script/page_text.hpp"
#include "script/session.hpp"
#include "script/sweep_table.hpp"
#include "store/packed.hpp"

namespace ricochet {

namespace {

bool marks_point(const Field& field) {
  return sweep_table::is_parameter(field) && !sweep_table::counts_samples(field.name);
}

// The point of the sweep that a row stands at, whatever its sample.
std::string point_of(const Table& table, std::size_t row) {
  std::string point;
  for (const NumberColumn& column : table.numbers)
    if (marks_point(column.field)) point += fmt::format("{} ", column.values[row]);
  for (const TextColumn& column : table.texts)
    if (marks_point(column.field)) point += column.values[row] + "\n";
  return point;
}

double e_of(const Table& table, std::size_t row) {
  const NumberColumn* e = table.number("e");
  return e ? e->values[row] : not_given;
}

// Finished rows by rising e; those without one come last.
std::vector<std::size_t> by_e(const Table& table, std::vector<std::size_t> rows) {
  const auto key = [&](std::size_t row) { return std::isnan(e_of(table, row)) ? HUGE_VAL : e_of(table, row); };
  std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return rows;
}

std::vector<std::size_t> finished_rows(const Table& table) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (sweep_table::has_finished(table, row)) rows.push_back(row);
  return rows;
}

void add_once(std::vector<std::size_t>& list, std::size_t row, std::size_t most) {
  if (list.size() < most && std::find(list.begin(), list.end(), row) == list.end()) list.push_back(row);
}

// The middle one of each point, in the order of the sweep.
std::vector<std::size_t> middle_rows(const Table& table, const std::vector<std::size_t>& rows) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<std::size_t>> points;
  for (const std::size_t row : rows) {
    const std::string point = point_of(table, row);
    if (points[point].empty()) order.push_back(point);
    points[point].push_back(row);
  }
  std::vector<std::size_t> middle;
  for (const std::string& point : order) {
    const std::vector<std::size_t> sorted = by_e(table, points[point]);
    middle.push_back(sorted[(sorted.size() - 1) / 2]);
  }
  return middle;
}

// Of those a sample has, what a reader sees or follows.
bool is_shown(const std::string& name) {
  static const std::set<std::string> names{"time",
                                           "x",
                                           "height",
                                           "vn",
                                           "vt",
                                           "omega",
                                           "angle",
                                           "force_n",
                                           "force_t",
                                           "overlap",
                                           "projectile_translation",
                                           "projectile_rotation",
                                           "projectile_vibration",
                                           "target_translation",
                                           "target_rotation",
                                           "target_vibration",
                                           "contact_energy",
                                           "effects_energy",
                                           "total_energy"};
  return names.count(name) > 0;
}

// Of those that are shown, what changes its sign in a mirror.
bool turns(const std::string& name) {
  static const std::set<std::string> names{"x", "vt", "omega", "angle", "force_t"};
  return names.count(name) > 0;
}

// Flat vectors of the plane as seen in a mirror, x to -x.
template <class Number>
void turn(std::vector<Number>& vectors) {
  for (std::size_t k = 0; k < vectors.size(); k += 2) vectors[k] = -vectors[k];
}

Frame in_mirror(Frame frame) {
  for (std::vector<float>* vectors : {&frame.position, &frame.velocity, &frame.contact_force}) turn(*vectors);
  return frame;
}

std::string series_json(const std::vector<Sample>& samples, const Scene& scene) {
  const Units& units = scene.units;
  std::string values, names;
  for (const auto& [field, value] : Sample::fields()) {
    if (!is_shown(field.name)) continue;
    std::string list;
    const double sign = scene.mirrored && turns(field.name) ? -1 : 1;
    for (const Sample& sample : samples) {
      const double number = sign * units.worth(field.unit) * value(sample);
      list += (list.empty() ? "" : ",") + (std::isfinite(number) ? fmt::format("{:.7g}", number) : "null");
    }
    values += fmt::format("{}\"{}\":[{}]", values.empty() ? "" : ",", field.name, list);
    names += fmt::format("{}\"{}\":{}", names.empty() ? "" : ",", field.name, json_text(units.name(field.unit)));
  }
  return fmt::format("\"series\":{{{}}},\"unit\":{{{}}}", values, names);
}

// Of so many samples to a frame the forces are told: at frames alone a peak between two is missed, and touches begin
// late.
constexpr int most_samples_a_frame = 8;

// As many samples to a frame as there are steps.
int samples_a_frame(const std::vector<double>& frames, double step) {
  if (frames.size() < 2) return 1;
  return std::clamp(static_cast<int>((frames[1] - frames[0]) / step + 1e-6), 1, most_samples_a_frame);
}

// The times of the frames, and those between.
std::vector<double> sample_times(const std::vector<double>& frames, int each) {
  std::vector<double> times;
  for (std::size_t k = 0; k + 1 < frames.size(); ++k)
    for (int j = 0; j < each; ++j) times.push_back(frames[k] + j * (frames[k + 1] - frames[k]) / each);
  times.push_back(frames.back());
  return times;
}

std::vector<Sample> every(const std::vector<Sample>& samples, int each) {
  std::vector<Sample> chosen;
  for (std::size_t k = 0; k < samples.size(); k += static_cast<std::size_t>(each)) chosen.push_back(samples[k]);
  return chosen;
}

// Whether a sample says more of the forces than a straight line between its neighbours: where one of the three has any.
bool tells_force(const std::vector<Sample>& samples, std::size_t k) {
  if (k == 0 || k + 1 == samples.size()) return true;
  return samples[k - 1].force != Vec2::Zero() || samples[k].force != Vec2::Zero() ||
         samples[k + 1].force != Vec2::Zero();
}

std::string forces_json(const std::vector<Sample>& samples, const Scene& scene) {
  std::string list;
  for (const char* name : {"time", "force_n", "force_t"}) {
    const auto& value = Sample::value_named(name);
    const double worth = scene.units.worth(std::string(name) == "time" ? "R/c" : "m0 c^2/R");
    const double sign = scene.mirrored && turns(name) ? -1 : 1;
    std::string numbers;
    for (std::size_t k = 0; k < samples.size(); ++k)
      if (tells_force(samples, k))
        numbers += fmt::format("{}{:.7g}", numbers.empty() ? "" : ",", sign * worth * value(samples[k]));
    list += fmt::format("{}\"{}\":[{}]", list.empty() ? "" : ",", name, numbers);
  }
  return "\"forces\":{" + list + "}";
}

std::string bodies_json(const FrameMesh& mesh) {
  std::string bodies;
  for (const BodyMesh& body : mesh.bodies) {
    std::string chains;
    for (const MeshChain& chain : body.surface)
      chains += fmt::format("{}{{\"closed\":{},\"node\":[{}]}}", chains.empty() ? "" : ",", chain.closed,
                            fmt::join(chain.node, ","));
    bodies += fmt::format("{}{{\"first\":{},\"nodes\":{},\"axisymmetric\":{},\"chains\":[{}]}}",
                          bodies.empty() ? "" : ",", body.first, body.nodes, body.axisymmetric, chains);
  }
  return fmt::format("\"bodies\":[{}]", bodies);
}

// "0.3", or "0.1 to 0.4" where it depends on the place
std::string shown_nu(const Body& body) {
  if (body.node_nu.empty()) return fmt::format("{:.3g}", body.numbers.nu);
  const auto [least, most] = std::minmax_element(body.node_nu.begin(), body.node_nu.end());
  return fmt::format("{:.3g} to {:.3g} by place", *least, *most);
}

// "a body 2 R wide and 2 R high of 300 nodes joined by springs"
std::string described(const Body& body, const Units& units) {
  if (body.plane) return "a rigid plane";
  Vec2 low = body.outline.front(), high = low;
  for (const Vec2& place : body.outline) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  const BodyNumbers& numbers = body.numbers;
  const double wide = (numbers.axisymmetric() ? 2 : 1) * (high - low)[0];
  std::string inside = numbers.rigid() ? "that is rigid" : "of nodes joined by springs";
  if (numbers.of_elements()) inside = fmt::format("of elements, Poisson's ratio {}", shown_nu(body));
  if (numbers.of_modes()) inside += ", which moves by its modes of vibration";
  return fmt::format("a body{} {} wide and {} high, {}", numbers.axisymmetric() ? " of revolution" : "",
                     units.shown(wide, "R"), units.shown((high - low)[1], "R"), inside);
}

std::string collided(const Scene& scene, const Solids& solids, const FrameMesh& mesh) {
  std::string text;
  for (std::size_t b = 0; b < scene.bodies().size(); ++b) {
    const Body& body = *scene.bodies()[b];
    const int nodes = mesh.bodies[b].nodes;
    text += fmt::format("{}{}: {}{}", b ? "; " : "", b ? "target" : "Projectile", described(body, scene.units),
                        body.plane ? "" : fmt::format(" ({} nodes are drawn)", nodes));
  }
  const Vec2 velocity = arriving_velocity(scene, solids[1]->anchored());
  return text + fmt::format(". They meet at {} along the normal and {} along the surface.",
                            scene.units.shown(std::abs(velocity[1]), "c"),
                            scene.units.shown(std::abs(velocity[0]), "c"));
}

}  // namespace

const Swept* swept_named(const Session& session, const std::string& name) {
  for (const Swept& one : session.swept)
    if (one.name == name) return &one;
  return nullptr;
}

std::vector<std::size_t> rows_to_replay(const Table& table, const std::string& how, std::size_t count) {
  const std::vector<std::size_t> finished = finished_rows(table);
  std::vector<std::size_t> list;
  if (finished.empty() || count == 0) return list;
  const std::vector<std::size_t> sorted = by_e(table, finished);
  if (how == "typical") {
    const std::vector<std::size_t> middle = middle_rows(table, finished);
    const std::size_t most = std::min(count, middle.size());
    for (std::size_t k = 0; k < most; ++k)
      add_once(list, middle[most == 1 ? middle.size() / 2 : k * (middle.size() - 1) / (most - 1)], count);
  }
  add_once(list, sorted.front(), count);
  add_once(list, sorted.back(), count);
  return list;
}

Viewing viewing_of(const Table& table, std::size_t row, const Scene& scene, int frames) {
  const auto number = [&](const char* name) {
    const NumberColumn* column = table.number(name);
    return column ? column->values[row] / scene.units.worth("R/c") : not_given;
  };
  return {.until = number("time"), .step = number("step"), .frames = frames};
}

std::string replay_json(const Scene& scene, const Viewing& viewing) {
  const BuiltSolids solids(scene);
  const FrameMesh halves = frame_mesh(scene, solids);
  FrameMesh mesh = whole_section(halves);
  if (scene.mirrored) turn(mesh.rest);
  const int frames = std::min(viewing.frames, static_cast<int>(most_node_frames / std::max(1, mesh.nodes())));
  if (frames < fewest_frames && frames < viewing.frames) return "";
  Trajectory trajectory(mesh);
  std::vector<Sample> samples;
  const std::vector<double> times = equal_times(viewing.from, viewing.until, frames, viewing.step);
  if (times.empty()) return "";
  const int each = samples_a_frame(times, viewing.step);
  const Sampling sampling{sample_times(times, each), [&](const Sample& sample) { samples.push_back(sample); }};
  const auto add = [&](const Frame& seen) {
    const Frame frame = whole_section(halves, seen);
    trajectory.add(scene.mirrored ? in_mirror(frame) : frame);
  };
  const bool whole = film_scene(solids, scene, times, stop_requested, add, sampling);
  if (!whole || trajectory.frames().size() < 2 || samples.size() != sampling.times.size()) return "";
  settle_overlaps(samples);
  const std::vector<Sample> at_frames = every(samples, each);
  const PackedReplay replay = packed(trajectory);
  const Units& units = scene.units;
  return fmt::format(
      "{{\"hash\":\"{}\",\"nodes\":{},\"frames\":{},\"grid\":{},\"levels\":{},\"top\":{:.7g},\"speedUnit\":{},"
      "\"length\":{:.7g},\"lengthUnit\":{},\"method\":\"{}\",\"collided\":{},{},{},{},\"scene\":{},"
      "\"triangles\":\"{}\",\"place\":\"{}\",\"colour\":\"{}\"}}",
      scene.hash(), mesh.nodes(), at_frames.size(), replay.grid, replay.levels, replay.top * units.worth("c"),
      json_text(units.name("c")), units.worth("R"), json_text(units.name("R")), scene.method().name,
      json_text(collided(scene, solids, mesh)), bodies_json(mesh), series_json(at_frames, scene),
      forces_json(samples, scene), json_text(scene.text()), base64(replay.triangles), base64(replay.place),
      base64(replay.colour));
}

}  // namespace ricochet
