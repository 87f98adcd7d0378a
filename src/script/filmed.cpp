#include "script/filmed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "impact/batch.hpp"
#include "record/whole_section.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/run_files.hpp"
#include "script/step_choice.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

const std::vector<Member<FrameTimes>>& FrameTimes::fields() {
  static const std::vector<Member<FrameTimes>> list{
      {{"frames", "integer", "", "how many", {1, 1e6}, by_struct}, &FrameTimes::frames},
      {{"from", "number", "R/c", "first time; before 0 the projectile is in free flight", {-1e6, 0}, by_struct},
       &FrameTimes::from},
      {{"duration", "number", "R/c", "time covered, from `from` on; the whole impact unless given", positive, "", true},
       &FrameTimes::duration},
      {{"slow_motion",
        "number",
        "",
        "so many times denser frames while the bodies touch; 1: equally spaced in time",
        {1, 1000},
        by_struct},
       &FrameTimes::slow_motion},
  };
  return list;
}

const std::vector<Member<FileName>>& FileName::fields() {
  static const std::vector<Member<FileName>> list{
      {{"out", "string", "", "file name without extension, below the run's folder", any_number, by_struct},
       &FileName::out}};
  return list;
}

std::vector<Field> scenes_fields() {
  Field one = scene_field();
  one.optional = true;
  return {
      one,
      {"scenes", "scenes", "", "several instead, side by side, with common colours and times", any_number, "", true},
      {"titles", "strings", "", "above each scene", any_number, "", true}};
}

namespace {

std::vector<FilmedScene> named_scenes(lua_State* L) {
  std::vector<FilmedScene> scenes;
  const auto add = [&] {
    const SceneObject& object = scene_at(L, -1);
    scenes.push_back({object.scene, object.site, BuiltSolids()});
  };
  if (lua_getfield(L, 1, "scene") != LUA_TNIL) add();
  lua_pop(L, 1);
  if (!scenes.empty() && has_field(L, 1, "scenes"))
    throw_here(L, FieldError("scenes", "give scene, or scenes for several side by side"));
  each_in_field(L, 1, "scenes", [&](lua_Integer) { add(); });
  if (scenes.empty()) throw_here(L, FieldError("scene", "is missing: what is to be drawn (or scenes, for several)"));
  return scenes;
}

void read_titles(lua_State* L, std::vector<FilmedScene>& scenes) {
  std::vector<std::string> titles;
  each_in_field(L, 1, "titles", [&](lua_Integer) { titles.push_back(lua_tostring(L, -1)); });
  if (titles.empty()) return;
  if (titles.size() != scenes.size())
    throw_here(L, FieldError("titles", fmt::format("has {} texts for {} scenes", titles.size(), scenes.size())));
  for (std::size_t i = 0; i < scenes.size(); ++i) scenes[i].title = titles[i];
}

}  // namespace

std::vector<FilmedScene> filmed_scenes(lua_State* L) {
  Session& session = session_of(L);
  std::vector<FilmedScene> scenes = named_scenes(L);
  read_titles(L, scenes);
  const CallSite call = call_site(L);
  for (FilmedScene& filmed : scenes)
    at_scene(session, call, filmed, [&] {
      filmed.scene = with_chosen_step(session, filmed.scene);
      filmed.solids = BuiltSolids(filmed.scene);
      if (session.options.check) check_start(filmed.solids, filmed.scene);
    });
  return scenes;
}

void follow(lua_State* L, std::vector<FilmedScene>& scenes) {
  Session& session = session_of(L);
  const CallSite call = call_site(L);
  for (FilmedScene& filmed : scenes) {
    at_scene(session, call, filmed,
             [&] { filmed.course = follow_course(filmed.solids, filmed.scene, stop_requested); });
    if (stop_requested) throw Error("interrupted before the first picture", Exit::interrupted);
    const Row row = row_of(filmed.scene, filmed.course.outcome, 0);
    session.count(row);
    if (!row.finished()) session.warn(fmt::format("an impact that is drawn ended {}: {}", row.status, row.reason));
  }
}

std::vector<double> times_of(const std::vector<FilmedScene>& scenes, const FrameTimes& wanted) {
  Course course = scenes[0].course;
  double until = 0;
  for (const FilmedScene& filmed : scenes) {
    until = std::max(until, filmed.course.outcome.time);
    course.step = std::max(course.step, filmed.course.step);
    course.first_touch = std::min(course.first_touch, filmed.course.first_touch);
    course.last_touch = std::max(course.last_touch, filmed.course.last_touch);
  }
  if (!std::isnan(wanted.duration)) until = wanted.from + wanted.duration;
  return frame_times(course, wanted.from, until, wanted.frames, wanted.slow_motion);
}

namespace {

// How many points a plot that grows has at least, beside those of the frames: more than it is wide in pixels.
constexpr int points_of_a_plot = 2000;

}  // namespace

std::vector<double> equal_times(double from, double until, int count, double step) {
  const double spacing = std::max((until - from) / std::max(1, count - 1), step);
  const auto last = static_cast<std::int64_t>(std::floor((until - from) / spacing * (1 + 1e-9)));
  std::vector<double> times;
  for (std::int64_t k = 0; k <= last; ++k) times.push_back(from + static_cast<double>(k) * spacing);
  return times;
}

Source source_of(const FilmedScene& filmed, std::vector<double> times) {
  Source source;
  const FrameMesh mesh = frame_mesh(filmed.scene, filmed.solids, filmed.course);
  source.subject = std::make_shared<render::Subject>(whole_section(mesh));
  source.subject->title = filmed.title;
  source.hash = filmed.scene.hash();
  source.play = [&filmed, mesh, times = std::move(times)](const std::atomic<bool>& stop,
                                                          const std::function<void(Frame)>& use,
                                                          const std::function<void(const Sample&)>& between) {
    Sampling sampling;
    if (between) sampling = {equal_times(times.front(), times.back(), points_of_a_plot, filmed.course.step), between};
    film_scene(
        filmed.solids, filmed.scene, times, stop, [&](const Frame& frame) { use(whole_section(mesh, frame)); },
        sampling);
  };
  return source;
}

int push_filmed_rows(lua_State* L, const std::vector<FilmedScene>& scenes) {
  const bool list = has_field(L, 1, "scenes");
  if (list) lua_createtable(L, static_cast<int>(scenes.size()), 0);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    push_row(L, row_of(scenes[i].scene, scenes[i].course.outcome, 0));
    if (list) lua_seti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  return 1;
}

fs::path claimed_path(lua_State* L, const char* field, const std::string& name) {
  Session& session = session_of(L);
  const fs::path path = below_folder(L, name);
  if (run_names::is_of_the_run(name))
    throw_here(
        L, FieldError(field, fmt::format("'{}' is the name of a file that runs leave themselves; give another", name)));
  if (!session.first_picture_named(path))
    throw_here(
        L,
        FieldError(
            field,
            fmt::format(
                "'{}' was made, or holds what was made, by an earlier call of this script; give this one another name",
                name)));
  session.folders.claim(session.own_folder());
  session.folders.own(path);
  make_folder(path.parent_path());
  return path;
}

}  // namespace ricochet
