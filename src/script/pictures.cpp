// ricochet.animate, ricochet.still, ricochet.contact_sheet, ricochet.record, ricochet.lammps.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "impact/batch.hpp"
#include "impact/film.hpp"
#include "impact/lammps.hpp"
#include "script/filming.hpp"
#include "script/objects.hpp"
#include "script/state.hpp"
#include "store/files.hpp"
#include "store/trajectory.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// Frames over which a picture of single moments is surveyed.
constexpr int survey_frames = 60;

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

/// A scene that is filmed: what it is, its lattices and, once it has run, its course.
struct Take {
  Scene scene;
  CallSite site;  ///< of the scene in the script
  std::shared_ptr<const Lattice> projectile, target;
  Course course{};
  std::string title{};
};

// Mistakes in fields of a scene stand in the scene's own table, the others at this call.
template <class Work>
auto at_scene(const Session& session, const CallSite& call, const Take& take, Work work) {
  try {
    return work();
  } catch (const FieldError& error) {
    static const std::set<std::string> own{"frames", "scene"};
    throw_at(session, own.count(error.field) ? call : take.site, error);
  }
}

// Mistakes that show when pictures are drawn stand at this call.
template <class Work>
auto at_call(lua_State* L, Work work) {
  const CallSite call = call_site(L);
  try {
    return work();
  } catch (const FieldError& error) {
    throw_at(session_of(L), call, error);
  }
}

std::vector<Take> takes_of(lua_State* L) {
  Session& session = session_of(L);
  std::vector<Take> takes;
  const auto add = [&](int index) {
    const SceneObject& object = scene_at(L, index);
    takes.push_back({object.scene, object.site, nullptr, nullptr});
  };
  if (lua_getfield(L, 1, "scene") != LUA_TNIL) add(-1);
  lua_pop(L, 1);
  if (lua_getfield(L, 1, "scenes") == LUA_TTABLE) {
    if (!takes.empty())
      throw_at(session, call_site(L), FieldError("scenes", "give scene, or scenes for several side by side"));
    for (lua_Integer i = 1; i <= length_of(L, -1); ++i) {
      lua_rawgeti(L, -1, i);
      add(-1);
      lua_pop(L, 1);
    }
  }
  lua_pop(L, 1);
  if (takes.empty())
    throw_at(session, call_site(L), FieldError("scene", "is missing: what is to be drawn (or scenes, for several)"));
  if (lua_getfield(L, 1, "titles") == LUA_TTABLE) {
    if (length_of(L, -1) != static_cast<lua_Integer>(takes.size()))
      throw_at(session, call_site(L),
               FieldError("titles", fmt::format("has {} texts for {} scenes", length_of(L, -1), takes.size())));
    for (std::size_t i = 0; i < takes.size(); ++i) {
      lua_rawgeti(L, -1, static_cast<lua_Integer>(i) + 1);
      takes[i].title = lua_tostring(L, -1);
      lua_pop(L, 1);
    }
  }
  lua_pop(L, 1);
  const CallSite call = call_site(L);
  for (Take& take : takes)
    at_scene(session, call, take, [&] {
      take.scene = with_chosen_step(session, take.scene);
      take.projectile = build_lattice(*take.scene.projectile);
      take.target = build_lattice(*take.scene.target);
      if (session.options.check) check_start(*take.projectile, *take.target, take.scene);
    });
  return takes;
}

Shooting shooting_of(lua_State* L) {
  Session& session = session_of(L);
  Shooting shooting;
  if (lua_getfield(L, 1, "show") == LUA_TTABLE) read_members(L, lua_gettop(L), shooting.show);
  lua_pop(L, 1);
  if (lua_getfield(L, 1, "size") == LUA_TTABLE) {
    if (length_of(L, -1) != 2) throw_at(session, call_site(L), FieldError("size", "takes a width and a height"));
    int* const axes[] = {&shooting.width, &shooting.height};
    for (int axis : {0, 1}) {
      lua_rawgeti(L, -1, axis + 1);
      const double pixels = lua_tonumber(L, -1);
      if (pixels != std::floor(pixels))
        throw_at(session, call_site(L), FieldError("size", fmt::format("counts pixels, which {} does not", pixels)));
      *axes[axis] = std::abs(pixels) <= 1e9 ? static_cast<int>(pixels) : 0;
      lua_pop(L, 1);
    }
  }
  lua_pop(L, 1);
  at_call(L, [&] {
    shooting.show.check();
    render::check_size(shooting.width, shooting.height);
  });
  shooting.origin = session.provenance().at("script_hash");
  shooting.threads = session.options.threads;
  return shooting;
}

// Runs every scene once; frames can then be placed in its course.
void follow(lua_State* L, std::vector<Take>& takes) {
  Session& session = session_of(L);
  const CallSite call = call_site(L);
  for (Take& take : takes) {
    at_scene(session, call, take,
             [&] { take.course = follow_course(*take.projectile, *take.target, take.scene, stop_requested); });
    if (stop_requested) throw Error("interrupted before the first picture", Exit::interrupted);
    const Outcome& outcome = take.course.outcome;
    session.count(outcome.status == Status::finished, name_of(outcome.status) + ": " + outcome.reason);
    if (outcome.status != Status::finished)
      session.warn(fmt::format("an impact that is drawn ended {}: {}", name_of(outcome.status), outcome.reason));
  }
}

Source source_of(const Take& take, std::vector<double> times) {
  Source source;
  source.subject = std::make_shared<render::Subject>(frame_mesh(take.scene, *take.projectile, *take.target));
  source.subject->title = take.title;
  source.hash = take.scene.hash();
  source.play = [&take, times = std::move(times)](const std::atomic<bool>& stop,
                                                  const std::function<void(Frame)>& use) {
    film_scene(*take.projectile, *take.target, take.scene, times, stop, use);
  };
  return source;
}

// The row of a scene, or a list of rows of scenes.
int push_rows(lua_State* L, const std::vector<Take>& takes) {
  lua_getfield(L, 1, "scenes");
  const bool list = !lua_isnil(L, -1);
  if (list) lua_createtable(L, static_cast<int>(takes.size()), 0);
  for (std::size_t i = 0; i < takes.size(); ++i) {
    push_row(L, row_of(takes[i].scene, takes[i].course.outcome, 0));
    if (list) lua_seti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  return 1;
}

// A path for what this call makes, which no other call of the script has made.
fs::path claimed(lua_State* L, const char* field, const std::string& name) {
  Session& session = session_of(L);
  const fs::path path = below_folder(L, name);
  if (is_of_the_run(name))
    throw_at(
        session, call_site(L),
        FieldError(field, fmt::format("'{}' is the name of a file that runs leave themselves; give another", name)));
  if (!session.first_picture_named(path))
    throw_at(
        session, call_site(L),
        FieldError(
            field,
            fmt::format(
                "'{}' was made, or holds what was made, by an earlier call of this script; give this one another name",
                name)));
  session.claim(session.own_folder());
  make_folder(path.parent_path());
  return path;
}

// Where the frames of all scenes lie: the same times for all, up to the end of the longest impact.
std::vector<double> times_of(lua_State* L, const std::vector<Take>& takes, double from, int frames) {
  Course course = takes[0].course;
  double until = 0;
  for (const Take& take : takes) {
    until = std::max(until, take.course.outcome.time);
    course.step = std::max(course.step, take.course.step);
    course.first_touch = std::min(course.first_touch, take.course.first_touch);
    course.last_touch = std::max(course.last_touch, take.course.last_touch);
  }
  const double duration = number_field(L, "duration", not_given);
  return frame_times(course, from, std::isnan(duration) ? until : from + duration, frames,
                     number_field(L, "slow_motion", 1));
}

int animate(lua_State* L) {
  check_table(L, 1, function_named("animate"));
  Session& session = session_of(L);
  const Shooting shooting = shooting_of(L);
  std::vector<Take> takes = takes_of(L);
  if (session.options.check) return push_rows(L, takes);
  Sequence sequence;
  const std::string film = text_field(L, "film", ""), out = text_field(L, "out", film.empty() ? "frames" : "");
  if (film.empty() && out.empty())
    throw_at(session, call_site(L),
             FieldError("out", "is empty, and no film is asked for: there would be nothing left of it"));
  sequence.columns = static_cast<int>(number_field(L, "columns", 0));
  if (!film.empty() && !film.ends_with(".mp4"))
    throw_at(session, call_site(L), FieldError("film", fmt::format("'{}' must end in .mp4", film)));
  if (!out.empty()) {
    sequence.folder = claimed(L, "out", out);
    make_folder(sequence.folder);
  }
  if (!film.empty()) sequence.film = claimed(L, "film", film);
  sequence.rate = number_field(L, "rate", 30);
  sequence.go_on = session.options.resume;
  follow(L, takes);
  const CallSite call = call_site(L);
  if (!out.empty()) {
    session.replace_product(sequence.folder);
    make_folder(sequence.folder);
  }
  const std::vector<double> times = at_scene(session, call, takes[0], [&] {
    return times_of(L, takes, number_field(L, "from", -1), static_cast<int>(number_field(L, "frames", 240)));
  });
  std::vector<Source> sources;
  for (const Take& take : takes) sources.push_back(source_of(take, times));
  const int count = at_call(L, [&] { return shoot_sequence(shooting, sources, sequence); });
  if (!out.empty()) session.print(fmt::format("{} frames in {}\n", count, sequence.folder.string()));
  if (!film.empty()) session.print(fmt::format("film: {}, {:.3g} s\n", sequence.film.string(), count / sequence.rate));
  return push_rows(L, takes);
}

// The scenes with frames over the whole impact, for colours and curves, and at the moments of each (which rise).
std::vector<Source> surveyed_sources(const std::vector<Take>& takes, const std::vector<std::vector<double>>& moments,
                                     std::vector<std::vector<std::size_t>>& places) {
  std::vector<Source> sources;
  for (std::size_t i = 0; i < takes.size(); ++i) {
    const Course& course = takes[i].course;
    const double until = std::max(course.outcome.time, moments[i].back()), from = std::min(-1.0, moments[i].front());
    const int count = std::max(2, std::min(survey_frames, static_cast<int>((until - from) / (2 * course.step))));
    std::vector<double> times;
    for (const double t :
         frame_times(course, from, until, count, 1))  // a moment takes the place of what is too close to it
      if (std::none_of(moments[i].begin(), moments[i].end(),
                       [&](double m) { return std::abs(m - t) < 1.5 * course.step; }))
        times.push_back(t);
    times.insert(times.end(), moments[i].begin(), moments[i].end());
    std::sort(times.begin(), times.end());
    places.emplace_back();
    for (const double m : moments[i])
      places.back().push_back(
          static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), m) - times.begin()));
    sources.push_back(source_of(takes[i], std::move(times)));
  }
  return sources;
}

int still(lua_State* L) {
  check_table(L, 1, function_named("still"));
  Session& session = session_of(L);
  const Shooting shooting = shooting_of(L);
  std::vector<Take> takes = takes_of(L);
  if (session.options.check) return push_rows(L, takes);
  const fs::path path = claimed(L, "out", text_field(L, "out", "still") + ".png");
  follow(L, takes);
  const double at = number_field(L, "at", not_given);
  std::vector<std::vector<double>> moments;
  for (const Take& take : takes) moments.push_back({std::isnan(at) ? take.course.tightest : at});
  std::vector<std::vector<std::size_t>> places;
  const std::vector<Source> sources = surveyed_sources(takes, moments, places);
  std::vector<Pick> picks;
  for (std::size_t i = 0; i < takes.size(); ++i) picks.push_back({i, places[i][0], takes[i].title});
  at_call(L, [&] { shoot_still(shooting, sources, picks, static_cast<int>(picks.size()), path); });
  session.print(fmt::format("picture: {}\n", path.string()));
  return push_rows(L, takes);
}

// The power of ten that tells moments apart: 0.1 or less.
double decimals_of(const std::vector<double>& moments) {
  double least = 0.1;
  for (std::size_t k = 1; k < moments.size(); ++k) least = std::min(least, moments[k] - moments[k - 1]);
  return std::pow(10.0, std::floor(std::log10(std::max(least, 1e-6))));
}

int contact_sheet(lua_State* L) {
  check_table(L, 1, function_named("contact_sheet"));
  Session& session = session_of(L);
  const Shooting shooting = shooting_of(L);
  std::vector<Take> takes = takes_of(L);
  if (session.options.check) return push_rows(L, takes);
  const fs::path path = claimed(L, "out", text_field(L, "out", "contact_sheet") + ".png");
  follow(L, takes);
  std::vector<double> times;
  if (lua_getfield(L, 1, "times") == LUA_TTABLE)
    for (lua_Integer i = 1; i <= length_of(L, -1); ++i) {
      lua_rawgeti(L, -1, i);
      times.push_back(lua_tonumber(L, -1));
      lua_pop(L, 1);
    }
  lua_pop(L, 1);
  for (const double t : times)
    if (std::abs(t) > 1e6)
      throw_at(session, call_site(L),
               FieldError("times", fmt::format("must lie between -1e6 and 1e6 R/c, one is {:g}", t)));
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const int count = static_cast<int>(number_field(L, "moments", 4));
  std::vector<std::vector<double>> moments;
  for (const Take& take : takes) {
    std::vector<double> of = times;
    // From the touch to the parting.
    for (int k = 0; times.empty() && k < count; ++k)
      of.push_back(count == 1 ? take.course.tightest
                              : take.course.first_touch +
                                    (take.course.last_touch - take.course.first_touch) * k / (count - 1));
    moments.push_back(of);
  }
  std::vector<std::vector<std::size_t>> places;
  const std::vector<Source> sources = surveyed_sources(takes, moments, places);
  std::vector<Pick> picks;
  for (std::size_t i = 0; i < takes.size(); ++i)
    for (std::size_t k = 0; k < moments[i].size(); ++k)
      picks.push_back({i, places[i][k],
                       fmt::format("{}{}t = {} R/c", takes[i].title, takes[i].title.empty() ? "" : ", ",
                                   render::number_text(moments[i][k], times.empty() ? decimals_of(moments[i]) : 0))});
  const int per_row = moments[0].size() > 1 ? static_cast<int>(moments[0].size()) : static_cast<int>(takes.size());
  const int columns =
      static_cast<int>(number_field(L, "columns", takes.size() == 1 ? std::ceil(std::sqrt(per_row)) : per_row));
  at_call(L, [&] { shoot_still(shooting, sources, picks, std::min(columns, static_cast<int>(picks.size())), path); });
  session.print(fmt::format("contact sheet: {}\n", path.string()));
  return push_rows(L, takes);
}

int record(lua_State* L) {
  check_table(L, 1, function_named("record"));
  Session& session = session_of(L);
  std::vector<Take> takes = takes_of(L);
  const Take& take = takes[0];
  if (session.options.check) return push_rows(L, takes);
  const fs::path path = claimed(L, "out", text_field(L, "out", "trajectory") + ".h5");
  follow(L, takes);
  const CallSite call = call_site(L);
  at_scene(session, call, take, [&] {
    const auto times = times_of(L, takes, number_field(L, "from", 0), static_cast<int>(number_field(L, "frames", 120)));
    Trajectory trajectory(frame_mesh(take.scene, *take.projectile, *take.target));
    if (!film_scene(*take.projectile, *take.target, take.scene, times, stop_requested,
                    [&](Frame frame) { trajectory.add(std::move(frame)); }))
      throw Error("interrupted", Exit::interrupted);
    Provenance provenance = session.provenance();
    provenance["scene"] = take.scene.text();
    provenance["scene_hash"] = take.scene.hash();
    trajectory.write(path, provenance);
    session.print(fmt::format("{} frames in {}\n", trajectory.frames().size(), path.string()));
  });
  return push_rows(L, takes);
}

// Writes OUT.data and OUT.in for LAMMPS.
int lammps(lua_State* L) {
  check_table(L, 1, function_named("lammps"));
  Session& session = session_of(L);
  const std::vector<Take> takes = takes_of(L);
  const Take& take = takes[0];
  if (session.options.check) return 0;
  at_scene(session, call_site(L), take, [&] {
    const fs::path data = below_folder(L, text_field(L, "out", "impact") + ".data");
    const LammpsFiles files = lammps_files(take.scene, *take.projectile, *take.target, data.stem().string());
    session.claim(session.own_folder());
    make_folder(data.parent_path());
    write_atomically(data, files.data);
    write_atomically(fs::path(data).replace_extension(".in"), files.input);
    session.print(fmt::format("LAMMPS files: {}, beside it .in\n", data.string()));
  });
  return 0;
}

}  // namespace

void add_pictures(lua_State* L) {
  const luaL_Reg list[] = {{"animate", guarded<animate>},
                           {"still", guarded<still>},
                           {"contact_sheet", guarded<contact_sheet>},
                           {"record", guarded<record>},
                           {"lammps", guarded<lammps>}};
  for (const luaL_Reg& f : list) {
    lua_pushcfunction(L, f.func);
    lua_setfield(L, -2, f.name);
  }
}

}  // namespace ricochet
