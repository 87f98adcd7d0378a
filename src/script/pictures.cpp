// ricochet.animate, ricochet.still, ricochet.contact_sheet and their `show` table.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "script/fields.hpp"
#include "script/filmed.hpp"
#include "script/look.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// Frames over which a picture of single moments is surveyed.
constexpr int survey_frames = 60;

// The latest and earliest moment that may be asked for. [R/c]
constexpr double farthest_moment = 1e6;

const FileName still_name{"still"}, sheet_name{"contact_sheet"};

/// What animate leaves, and how.
struct Animation {
  std::string out, film;
  double rate = Sequence{}.rate;
  int columns = Sequence{}.columns;

  static const std::vector<Member<Animation>>& fields();
};

const std::vector<Member<Animation>>& Animation::fields() {
  static const std::vector<Member<Animation>> list{
      {{"out", "string", "", "folder of the frames, below the run's folder; \"frames\" unless only a film is asked for",
        any_number, "", true},
       &Animation::out},
      {{"film", "string", "", "name of an .mp4, .gif or .apng file, below the run's folder; needs ffmpeg", any_number,
        "", true},
       &Animation::film},
      {{"rate", "number", "1/s", "frames a second of the film", {1, 240}, by_struct}, &Animation::rate},
      {{"columns", "integer", "", "scenes in a row; up to three unless given, more in a square", {1, 100}, "", true},
       &Animation::columns},
  };
  return list;
}

/// The moment of a still.
struct Moment {
  double at = not_given;

  static const std::vector<Member<Moment>>& fields();
};

const std::vector<Member<Moment>>& Moment::fields() {
  static const std::vector<Member<Moment>> list{
      {{"at",
        "number",
        "R/c",
        "when, since the rims came within reach; when contact holds most energy unless given",
        {-farthest_moment, farthest_moment},
        "",
        true},
       &Moment::at}};
  return list;
}

/// The pictures of a contact sheet.
struct Grid {
  int moments = 4;
  int columns = 0;

  static const std::vector<Member<Grid>>& fields();
};

const std::vector<Member<Grid>>& Grid::fields() {
  static const std::vector<Member<Grid>> list{
      {{"moments", "integer", "", "how many of each impact, from its touch to its parting", {1, 100}, by_struct},
       &Grid::moments},
      {{"columns",
        "integer",
        "",
        "pictures in a row of the grid; all moments of a scene unless given, one scene alone in a square",
        {1, 100},
        "",
        true},
       &Grid::columns},
  };
  return list;
}

// Where an animation goes; claims its folder and its film.
Sequence sequence_of(lua_State* L) {
  const Session& session = session_of(L);
  Animation wanted = members_of_call<Animation>(L);
  if (wanted.film.empty() && !has_field(L, 1, "out")) wanted.out = "frames";
  if (wanted.film.empty() && wanted.out.empty())
    throw_here(L, FieldError("out", "is empty, and no film is asked for: there would be nothing left of it"));
  if (!wanted.film.empty() && !run_names::is_film(wanted.film))
    throw_here(L, FieldError("film", fmt::format("'{}' must end in {}, {} or {}", wanted.film, run_names::film,
                                                 run_names::film_gif, run_names::film_png)));
  Sequence sequence;
  if (!wanted.out.empty()) {
    sequence.folder = claimed_path(L, "out", wanted.out);
    make_folder(sequence.folder);
  }
  if (!wanted.film.empty()) sequence.film = claimed_path(L, "film", wanted.film);
  sequence.rate = wanted.rate;
  sequence.columns = wanted.columns;
  sequence.go_on = session.options.resume;
  return sequence;
}

int animate(lua_State* L) {
  check_table(L, 1, function_named("animate"));
  Session& session = session_of(L);
  const Shooting shooting = shooting_of(L);
  std::vector<FilmedScene> scenes = filmed_scenes(L);
  if (session.options.check) return push_filmed_rows(L, scenes);
  const Sequence sequence = sequence_of(L);
  follow(L, scenes);
  const std::vector<double> times = at_scene(session, call_site(L), scenes[0], [&] {
    return times_of(scenes, members_of_call<FrameTimes>(L, {}, scenes[0].scene.units));
  });
  std::vector<Source> sources;
  for (const FilmedScene& filmed : scenes) sources.push_back(source_of(filmed, times));
  const int count = at_call(L, [&] { return shoot_sequence(shooting, sources, sequence); });
  if (!sequence.folder.empty()) session.inform(fmt::format("{} frames in {}\n", count, sequence.folder.string()));
  if (!sequence.film.empty())
    session.inform(fmt::format("film: {}, {:.3g} s\n", sequence.film.string(), count / sequence.rate));
  return push_filmed_rows(L, scenes);
}

// Frames over the whole impact, for colours and curves, and at the moments (which rise).
std::vector<double> survey_times(const Course& course, const std::vector<double>& moments) {
  const double until = std::max(course.outcome.time, moments.back()), from = std::min(-1.0, moments.front());
  const int count = std::max(2, std::min(survey_frames, static_cast<int>((until - from) / (2 * course.step))));
  std::vector<double> times = frame_times(course, from, until, count, 1);
  std::erase_if(times, [&](double t) {  // a moment takes the place of what is too close to it
    return std::any_of(moments.begin(), moments.end(), [&](double m) { return std::abs(m - t) < 1.5 * course.step; });
  });
  times.insert(times.end(), moments.begin(), moments.end());
  std::sort(times.begin(), times.end());
  return times;
}

// One picture of every scene at its moments. `caption` gives what stands above moment k of a scene.
template <class Caption>
void shoot_moments(lua_State* L, const Shooting& shooting, const std::vector<FilmedScene>& scenes,
                   const std::vector<std::vector<double>>& moments, int columns, const fs::path& path,
                   Caption caption) {
  std::vector<Source> sources;
  std::vector<Pick> picks;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    std::vector<double> times = survey_times(scenes[i].course, moments[i]);
    for (std::size_t k = 0; k < moments[i].size(); ++k) {
      const auto place = std::lower_bound(times.begin(), times.end(), moments[i][k]) - times.begin();
      picks.push_back({i, static_cast<std::size_t>(place), caption(i, k)});
    }
    sources.push_back(source_of(scenes[i], std::move(times)));
  }
  at_call(L, [&] { shoot_still(shooting, sources, picks, std::min(columns, static_cast<int>(picks.size())), path); });
}

int still(lua_State* L) {
  check_table(L, 1, function_named("still"));
  Session& session = session_of(L);
  const Shooting shooting = shooting_of(L);
  std::vector<FilmedScene> scenes = filmed_scenes(L);
  if (session.options.check) return push_filmed_rows(L, scenes);
  const fs::path path = claimed_path(L, "out", members_of_call(L, still_name).out + run_names::picture);
  follow(L, scenes);
  const double at = members_of_call<Moment>(L, {}, scenes[0].scene.units).at;
  std::vector<std::vector<double>> moments;
  for (const FilmedScene& filmed : scenes) moments.push_back({std::isnan(at) ? filmed.course.tightest : at});
  shoot_moments(L, shooting, scenes, moments, static_cast<int>(scenes.size()), path,
                [&](std::size_t i, std::size_t) { return scenes[i].title; });
  session.inform(fmt::format("picture: {}\n", path.string()));
  return push_filmed_rows(L, scenes);
}

// The power of ten that tells moments apart: 0.1 or less.
double decimals_of(const std::vector<double>& moments) {
  double least = 0.1;
  for (std::size_t k = 1; k < moments.size(); ++k) least = std::min(least, moments[k] - moments[k - 1]);
  return std::pow(10.0, std::floor(std::log10(std::max(least, 1e-6))));
}

// The moments that a script names, in order, each once.
std::vector<double> given_times(lua_State* L, const Units& units) {
  std::vector<double> times;
  each_in_field(L, 1, "times", [&](lua_Integer) { times.push_back(lua_tonumber(L, -1) / units.worth("R/c")); });
  for (const double t : times)
    if (std::abs(t) > farthest_moment)
      throw_here(L, FieldError("times", fmt::format("must lie between {} and {}, one is {}",
                                                    units.shown(-farthest_moment, "R/c", 2),
                                                    units.shown(farthest_moment, "R/c", 2), units.shown(t, "R/c", 6))));
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

// From the touch to the parting.
std::vector<double> moments_of(const Course& course, int count) {
  if (count == 1) return {course.tightest};
  std::vector<double> moments;
  for (int k = 0; k < count; ++k)
    moments.push_back(course.first_touch + (course.last_touch - course.first_touch) * k / (count - 1));
  return moments;
}

int contact_sheet(lua_State* L) {
  check_table(L, 1, function_named("contact_sheet"));
  Session& session = session_of(L);
  const Shooting shooting = shooting_of(L);
  std::vector<FilmedScene> scenes = filmed_scenes(L);
  if (session.options.check) return push_filmed_rows(L, scenes);
  const fs::path path = claimed_path(L, "out", members_of_call(L, sheet_name).out + run_names::picture);
  follow(L, scenes);
  const std::vector<double> times = given_times(L, scenes[0].scene.units);
  const Grid grid = members_of_call<Grid>(L);
  std::vector<std::vector<double>> moments;
  for (const FilmedScene& filmed : scenes)
    moments.push_back(times.empty() ? moments_of(filmed.course, grid.moments) : times);
  const auto caption = [&](std::size_t i, std::size_t k) {
    const double decimals = times.empty() ? decimals_of(moments[i]) : 0;
    const Units& units = scenes[i].scene.units;
    const std::string moment =
        units.si ? units.shown(moments[i][k], "R/c") : render::number_text(moments[i][k], decimals) + " R/c";
    return fmt::format("{}{}t = {}", scenes[i].title, scenes[i].title.empty() ? "" : ", ", moment);
  };
  const std::size_t in_row = moments[0].size() > 1 ? moments[0].size() : scenes.size();
  int columns = static_cast<int>(in_row);
  if (scenes.size() == 1) columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(in_row))));
  shoot_moments(L, shooting, scenes, moments, grid.columns > 0 ? grid.columns : columns, path, caption);
  session.inform(fmt::format("contact sheet: {}\n", path.string()));
  return push_filmed_rows(L, scenes);
}

Function animate_function() {
  return {.name = "animate",
          .doc =
              "Draws an impact as a sequence of PNG files, and as a film, without a display, while it runs. "
              "Colours and scales are those of the whole sequence. "
              "Stopped and run again with --resume it goes on. Returns the impact's row, or a list of rows if "
              "`scenes` was given.",
          .fields = scenes_fields() + fields_of<FrameTimes>() + look_fields() + fields_of<Animation>(),
          .returns = "table",
          .example =
              "ricochet.animate { scene = scene, frames = 120, size = {960, 540}, show = { material = "
              "\"speed\", ledger = true } }",
          .call = guarded<animate>};
}

Function show_table() {
  return {.name = "show",
          .doc =
              "The `show` table of animate, still and contact_sheet: layers by name. What is not switched on is not "
              "computed. `ricochet render FILE.h5 name=value` takes the same.",
          .fields = fields_of<render::Show>(),
          .is_table = true};
}

Function still_function() {
  return {.name = "still",
          .doc =
              "Draws one moment of an impact as OUT.png. Colours and scales are those of the whole impact. Returns "
              "the row, or a list of rows if `scenes` was given.",
          .fields = scenes_fields() + fields_of<Moment>() + look_fields() + fields_of(still_name),
          .returns = "table",
          .example = "ricochet.still { scene = scene, at = 3, show = { camera = \"contact\" } }",
          .call = guarded<still>};
}

Function contact_sheet_function() {
  std::vector<Field> grid = fields_of<Grid>();
  grid.insert(grid.begin() + 1, {"times", "numbers", "R/c", "the moments, instead", any_number, "", true});
  return {.name = "contact_sheet",
          .doc =
              "Draws a grid of moments of one or several impacts as OUT.png: a row for each scene. Returns the row, "
              "or a list of rows if `scenes` was given.",
          .fields = scenes_fields() + grid + look_fields() + fields_of(sheet_name),
          .returns = "table",
          .example =
              "ricochet.contact_sheet { scenes = { soft, hard }, titles = { \"soft\", \"hard\" }, moments = 3 "
              "}",
          .call = guarded<contact_sheet>};
}

}  // namespace

Group picture_functions() {
  return {.functions = {animate_function(), show_table(), still_function(), contact_sheet_function()}};
}

}  // namespace ricochet
