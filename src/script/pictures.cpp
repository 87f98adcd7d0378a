// ricochet.animate, ricochet.record, ricochet.lammps, gnuplot for ricochet.plot, ricochet.file.

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/hash.hpp"
#include "force/springs.hpp"
#include "impact/batch.hpp"
#include "impact/lammps.hpp"
#include "impact/launch.hpp"
#include "render/picture.hpp"
#include "render/png.hpp"
#include "script/objects.hpp"
#include "script/state.hpp"
#include "store/files.hpp"
#include "store/trajectory.hpp"

extern char** environ;

namespace ricochet {

namespace fs = std::filesystem;

namespace {

/// Both lattices of a scene as one mesh: the projectile's nodes, then the target's.
struct Joined {
  std::shared_ptr<const Lattice> projectile, target;
  render::Mesh mesh;
  std::vector<double> length, stiffness;  // [edge]
};

Joined join(const Scene& scene) {
  Joined joined{build_lattice(*scene.projectile), build_lattice(*scene.target), {}, {}, {}};
  int offset = 0;
  for (const auto& [lattice, body] : {std::pair{joined.projectile, scene.projectile}, std::pair{joined.target, scene.target}}) {
    for (int i = 0; i < lattice->nodes(); ++i)
      for (int s = lattice->first[i]; s < lattice->first[i + 1]; ++s) {
        const Spring spring = lattice->spring[s];
        joined.mesh.edges.push_back({i + offset, spring.other + offset});
        joined.length.push_back(spring.length), joined.stiffness.push_back(spring.stiffness * body->numbers.stiffness);
      }
    for (const Triangle& t : lattice->triangles) joined.mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    std::vector<int> rim;
    for (const int node : lattice->rim) rim.push_back(node + offset);
    joined.mesh.rims.push_back(rim);
    offset += lattice->nodes();
  }
  return joined;
}

Points all_points(const Points& projectile, const Points& target) {
  Points points = projectile;
  points.insert(points.end(), target.begin(), target.end());
  return points;
}

// Energy of each spring, by the law of its body and what effects have left of it; NaN if it is broken. `shot`: nullptr before the impact.
std::vector<double> spring_energies(const Joined& joined, const Points& points, const Snapshot* shot) {
  std::vector<double> energies;
  const std::size_t of_projectile = joined.projectile->spring.size();
  for (std::size_t e = 0; e < joined.mesh.edges.size(); ++e) {
    SpringRest<double> rest{(points[joined.mesh.edges[e][1]] - points[joined.mesh.edges[e][0]]).norm() - joined.length[e], 1};
    const bool first = e < of_projectile;
    if (shot && !shot->springs[first ? 0 : 1].empty()) rest = shot->springs[first ? 0 : 1][first ? e : e - of_projectile];
    const double energy = joined.stiffness[e] * with_spring_law(first ? *joined.projectile : *joined.target, [&](const auto& law) { return law.energy(rest.elastic); });
    energies.push_back(rest.share > 0 ? energy : not_given);
  }
  return energies;
}

/// What a sequence of frames covers.
struct Sequence {
  double from, until, brightest;
  render::View view;
  Outcome outcome;
};

Points before_touch(const Joined& joined, const Start& start, double time) {
  Pose pose = start.pose;
  pose.centre += time * start.velocity, pose.angle += time * start.spin;
  return posed(joined.projectile->points, joined.projectile->centre(), pose);
}

// A first run without pictures: how long the impact lasts, the strongest springs, the space it takes.
Sequence survey(const Scene& scene, const Joined& joined, double from, double duration) {
  const Start start = launch(scene, *joined.projectile, *joined.target);
  if (!start.touches) throw FieldError("scene", "the projectile passes by the target: there is nothing to show");
  Sequence sequence{from, std::isnan(duration) ? not_given : from + duration, 0, {}, {}};
  render::View& view = sequence.view;
  view.low = view.high = joined.target->points.front();
  const auto include = [&](const Points& points) {
    for (const Vec2& p : points)
      if (p.allFinite()) view.low = view.low.cwiseMin(p), view.high = view.high.cwiseMax(p);
  };
  include(joined.target->points), include(before_touch(joined, start, from));
  const auto look = [&](const Snapshot& shot) {
    std::vector<double> energies = spring_energies(joined, all_points(shot.projectile, shot.target), &shot);
    for (double& energy : energies)
      if (std::isnan(energy)) energy = 0;
    // The one spring in a thousand that is strongest does not darken all others.
    const auto high = energies.begin() + static_cast<std::ptrdiff_t>(energies.size() * 999 / 1000);
    std::nth_element(energies.begin(), high, energies.end());
    sequence.brightest = std::max(sequence.brightest, *high);
    include(shot.projectile);
  };
  // Every quarter of R/c; past `until` nothing is shown.
  const double until = std::isnan(duration) ? std::numeric_limits<double>::infinity() : sequence.until;
  const auto sampled = equally_spaced(0, 0.25, std::numeric_limits<std::int64_t>::max(), start.step);
  const Observer observer{std::isnan(duration) ? 0 : until, [&, sampled](double time) mutable { return time <= until && sampled(time); }, look};
  sequence.outcome = run_scene(*joined.projectile, *joined.target, scene, stop_requested, &observer);
  if (stop_requested) throw Error("interrupted", Exit::interrupted);
  if (std::isnan(sequence.until)) sequence.until = sequence.outcome.time;
  const Vec2 margin = 0.03 * (view.high - view.low);
  view.low -= margin, view.high += margin;
  return sequence;
}

fs::path below_folder(lua_State* L, const std::string& name) {
  const Session& session = session_of(L);
  const fs::path path(name);
  bool plain = !name.empty() && path.is_relative() && name.find('\\') == std::string::npos && name.find('\0') == std::string::npos;
  for (const fs::path& part : path) plain = plain && part != ".." && part != ".";
  if (!plain) throw at_line(L, fmt::format("'{}' is no name below the run's folder; give a relative name without '..'", name));
  // A link inside the folder must not lead out of it.
  const fs::path whole = session.own_folder() / path;
  std::error_code error;
  const fs::path real = fs::weakly_canonical(whole, error), root = fs::weakly_canonical(session.own_folder(), error);
  if (error || std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end())
    throw FileError(fmt::format("'{}' leads out of the run's folder {}", name, session.own_folder().string()));
  return whole;
}

std::string text_field(lua_State* L, const char* name, const char* initial) {
  lua_getfield(L, 1, name);
  const std::string text = lua_isnil(L, -1) ? initial : lua_tostring(L, -1);
  lua_pop(L, 1);
  return text;
}

double number_field(lua_State* L, const char* name, double initial) {
  lua_getfield(L, 1, name);
  const double value = lua_isnil(L, -1) ? initial : lua_tonumber(L, -1);
  lua_pop(L, 1);
  return value;
}

// With --check: looks at the start, pushes a row of an impact that has not run, and returns true.
bool only_checked(lua_State* L, const Joined& joined, const Scene& scene) {
  if (!session_of(L).options.check) return false;
  check_start(*joined.projectile, *joined.target, scene);
  push_row(L, row_of(scene, Outcome{}, 0));
  return true;
}

// The time between frames; a frame falls on the end of a step, so it cannot be shorter than one.
double frame_spacing(double duration, int frames, double step) {
  const double spacing = duration / std::max(1, frames - 1);
  if (frames > 1 && spacing < step)
    throw FieldError("frames", fmt::format("{} frames in {:.4g} R/c are closer than the time step {:.3g} R/c; ask for {} or fewer, or give the scene a smaller step",
                                           frames, duration, step, static_cast<std::int64_t>(duration / step) + 1));
  return spacing;
}

// Mistakes in fields of this call stand at this call, the others in the scene's own table.
[[noreturn]] void throw_at_call_or_scene(lua_State* L, const SceneObject& object, const FieldError& error) {
  static const std::set<std::string> own{"size", "frames", "scene"};
  throw_at(session_of(L), own.count(error.field) ? call_site(L) : object.site, error);
}

int animate(lua_State* L) {
  check_table(L, 1, function_named("animate"));
  Session& session = session_of(L);
  lua_getfield(L, 1, "scene");
  const SceneObject& object = scene_at(L, -1);
  Scene scene = object.scene;
  const int frames = static_cast<int>(number_field(L, "frames", 120));
  int size[2] = {1280, 720};
  if (lua_getfield(L, 1, "size") == LUA_TTABLE) {
    if (luaL_len(L, -1) != 2) throw_at(session, call_site(L), FieldError("size", "takes a width and a height"));
    for (int axis : {0, 1}) {
      lua_geti(L, -1, axis + 1);
      const double pixels = lua_tonumber(L, -1);
      size[axis] = pixels >= 1 && pixels <= 1e5 ? static_cast<int>(pixels) : 0;
      lua_pop(L, 1);
    }
  }
  try {
    scene = with_chosen_step(session, scene);
    render::Context context(size[0], size[1]);
    const Joined joined = join(scene);
    if (only_checked(L, joined, scene)) return 1;
    const fs::path folder = below_folder(L, text_field(L, "out", "frames"));
    session.claim(session.own_folder());
    make_folder(folder);
    const Sequence sequence = survey(scene, joined, number_field(L, "from", -1), number_field(L, "duration", not_given));
    const Provenance provenance = session.provenance();
    const Start start = launch(scene, *joined.projectile, *joined.target);
    const double spacing = frame_spacing(sequence.until - sequence.from, frames, start.step);
    int drawn = 0;
    const auto draw = [&](double time, const Points& projectile, const Points& target, const Snapshot* shot = nullptr) {
      render::Frame frame{all_points(projectile, target), {}};
      frame.edge_values = spring_energies(joined, frame.points, shot);
      for (double& value : frame.edge_values) value = std::sqrt(value / std::max(sequence.brightest, 1e-300));
      const std::map<std::string, std::string> texts{{"Software", "ricochet " + provenance.at("version")},
                                                     {"ricochet.script", provenance.at("script_hash")},
                                                     {"ricochet.scene", scene.hash()},
                                                     {"ricochet.time", fmt::format("{:.6g} R/c", time)}};
      write_atomically(folder / fmt::format("{:06}.png", drawn++), render::png(render::draw(context, size[0], size[1], joined.mesh, frame, sequence.view), texts));
    };
    // Frames before the touch are free flight; the others are the observer's, which begins at 0.
    while (drawn < frames && sequence.from + drawn * spacing < 0) draw(sequence.from + drawn * spacing, before_touch(joined, start, sequence.from + drawn * spacing), joined.target->points);
    const double first = sequence.from + drawn * spacing;
    const Observer observer{sequence.until, equally_spaced(first, spacing, frames - drawn, start.step),
                            [&](const Snapshot& shot) { draw(shot.time, shot.projectile, shot.target, &shot); }};
    run_scene(*joined.projectile, *joined.target, scene, stop_requested, &observer);
    if (stop_requested) throw Error(fmt::format("interrupted: {} of {} frames are in {}", drawn, frames, folder.string()), Exit::interrupted);
    // Frames of an earlier, longer sequence would pass for the end of this one.
    for (int stale = drawn; fs::remove(folder / fmt::format("{:06}.png", stale)); ++stale) {
    }
    session.print(fmt::format("{} frames in {}\n", drawn, folder.string()));
    session.count(sequence.outcome.status == Status::finished, name_of(sequence.outcome.status) + ": " + sequence.outcome.reason);
    push_row(L, row_of(scene, sequence.outcome, 0));
    return 1;
  } catch (const FieldError& error) {
    throw_at_call_or_scene(L, object, error);
  }
}

int record(lua_State* L) {
  check_table(L, 1, function_named("record"));
  Session& session = session_of(L);
  lua_getfield(L, 1, "scene");
  const SceneObject& object = scene_at(L, -1);
  Scene scene = object.scene;
  const int frames = static_cast<int>(number_field(L, "frames", 120));
  try {
    scene = with_chosen_step(session, scene);
    const Joined joined = join(scene);
    if (only_checked(L, joined, scene)) return 1;
    const fs::path path = below_folder(L, text_field(L, "out", "trajectory") + ".h5");
    session.claim(session.own_folder());
    double duration = number_field(L, "duration", not_given);
    Outcome outcome = run_scene(*joined.projectile, *joined.target, scene, stop_requested);
    if (std::isnan(duration)) duration = outcome.time;
    Trajectory trajectory({joined.projectile->nodes(), joined.projectile->nodes() + joined.target->nodes(), joined.projectile->mass, joined.target->mass,
                           joined.mesh.edges, joined.mesh.triangles});
    const std::vector<Field> observables{{"projectile_translation", "number", "m0 c^2", "energy of the projectile's centre of mass"},
                                         {"projectile_rotation", "number", "m0 c^2", "energy of the projectile's spin"},
                                         {"projectile_vibration", "number", "m0 c^2", "energy of the projectile's vibration"},
                                         {"target_translation", "number", "m0 c^2", "energy of the target's centre of mass (0 if anchored)"},
                                         {"target_rotation", "number", "m0 c^2", "energy of the target's spin (0 if anchored)"},
                                         {"target_vibration", "number", "m0 c^2", "energy of the target's vibration"},
                                         {"contact", "number", "m0 c^2", "contact energy"},
                                         {"total", "number", "m0 c^2", "total energy"}};
    const Start start = launch(scene, *joined.projectile, *joined.target);
    if (!start.touches) throw FieldError("scene", "the projectile passes by the target: there is nothing to record");
    const auto due = equally_spaced(0, frame_spacing(duration, frames, start.step), frames, start.step);
    const Observer observer{duration, due, [&](const Snapshot& shot) {
      trajectory.add(shot.time, shot.time / start.step, all_points(shot.projectile, shot.target), all_points(shot.projectile_velocity, shot.target_velocity),
                     {shot.energy.projectile_translation, shot.energy.projectile_rotation, shot.energy.projectile_vibration, shot.energy.target_translation,
                      shot.energy.target_rotation, shot.energy.target_vibration, shot.energy.contact, shot.energy.total()});
    }};
    run_scene(*joined.projectile, *joined.target, scene, stop_requested, &observer);
    if (stop_requested) throw Error("interrupted", Exit::interrupted);
    Provenance provenance = session.provenance();
    provenance["scene"] = scene.text();
    make_folder(path.parent_path());
    trajectory.write(path, observables, provenance);
    session.print(fmt::format("{} frames in {}\n", trajectory.frames(), path.string()));
    session.count(outcome.status == Status::finished, name_of(outcome.status) + ": " + outcome.reason);
    push_row(L, row_of(scene, outcome, 0));
    return 1;
  } catch (const FieldError& error) {
    throw_at_call_or_scene(L, object, error);
  }
}

// Writes OUT.data and OUT.in for LAMMPS.
int lammps(lua_State* L) {
  check_table(L, 1, function_named("lammps"));
  Session& session = session_of(L);
  lua_getfield(L, 1, "scene");
  const SceneObject& object = scene_at(L, -1);
  try {
    const Scene scene = with_chosen_step(session, object.scene);
    const fs::path data = below_folder(L, text_field(L, "out", "impact") + ".data");
    const Joined joined = join(scene);
    if (session.options.check) return 0;
    const LammpsFiles files = lammps_files(scene, *joined.projectile, *joined.target, data.stem().string());
    session.claim(session.own_folder());
    make_folder(data.parent_path());
    write_atomically(data, files.data);
    write_atomically(fs::path(data).replace_extension(".in"), files.input);
    session.print(fmt::format("LAMMPS files: {}, beside it .in\n", data.string()));
    return 0;
  } catch (const FieldError& error) {
    throw_at_call_or_scene(L, object, error);
  }
}

// gnuplot(name, text): writes NAME.gp into the run's folder and lets gnuplot draw NAME.svg and NAME.png.
int gnuplot(lua_State* L) {
  Session& session = session_of(L);
  const std::string name = luaL_checkstring(L, 1);
  const fs::path script = below_folder(L, name + ".gp");
  session.claim(session.own_folder());
  write_atomically(script, luaL_checkstring(L, 2));
  const std::string file = script.filename().string();
  const char* arguments[] = {"gnuplot", file.c_str(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, script.parent_path().c_str());
  pid_t child = 0;
  const int failed = posix_spawnp(&child, "gnuplot", &actions, nullptr, const_cast<char**>(arguments), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed) throw FileError("gnuplot is not installed; apt-get install gnuplot-nox");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw FileError(fmt::format("gnuplot could not draw {} (its message stands above)", script.string()));
  session.print(fmt::format("plot: {}\n", fs::path(script).replace_extension(".png").string()));
  return 0;
}

int file_write(lua_State* L) {
  Session& session = session_of(L);
  const fs::path path = below_folder(L, luaL_checkstring(L, 1));
  std::size_t length = 0;
  const char* text = luaL_checklstring(L, 2, &length);
  if (session.options.check) return 0;
  spend(L, work_a_file + static_cast<double>(length) / 8);
  session.claim(session.own_folder());
  make_folder(path.parent_path());
  write_atomically(path, {text, length});
  return 0;
}

int file_read(lua_State* L) {
  const std::string text = read_file(below_folder(L, luaL_checkstring(L, 1)));
  lua_pushlstring(L, text.data(), text.size());
  return 1;
}

}  // namespace

void add_pictures(lua_State* L) {
  const luaL_Reg list[] = {{"animate", guarded<animate>}, {"record", guarded<record>}, {"lammps", guarded<lammps>}, {"gnuplot", guarded<gnuplot>}, {"file_write", guarded<file_write>}, {"file_read", guarded<file_read>}};
  for (const luaL_Reg& f : list) lua_pushcfunction(L, f.func), lua_setfield(L, -2, f.name);
}

}  // namespace ricochet
