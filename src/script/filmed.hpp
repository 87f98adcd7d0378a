#pragma once
// Scenes of a script that are drawn or recorded: run once, to know when what happens, and once more frame by frame.

#include <filesystem>
#include <lua.hpp>
#include <memory>
#include <string>
#include <vector>

#include "impact/batch.hpp"
#include "record/film.hpp"
#include "script/filming.hpp"
#include "script/reader.hpp"

namespace ricochet {

struct FilmedScene {
  Scene scene;
  CallSite site;  ///< of the scene in the script
  BuiltSolids solids;
  Course course{};
  std::string title{};
};

/// When the frames of a sequence are.
struct FrameTimes {
  int frames = 240;
  double from = -1;
  double duration = not_given;
  double slow_motion = 1;

  static const std::vector<Member<FrameTimes>>& fields();
};

/// A file that a script asks for, without its extension.
struct FileName {
  std::string out;

  static const std::vector<Member<FileName>>& fields();
};

/// The fields of one scene or several.
std::vector<Field> scenes_fields();

/// The scenes of the table at index 1, with lattices and steps.
std::vector<FilmedScene> filmed_scenes(lua_State* L);

/// Runs every scene once; frames can then be placed in its course.
void follow(lua_State* L, std::vector<FilmedScene>& scenes);

/// Where the frames of all scenes lie: the same times for all, up to the end of the longest impact.
std::vector<double> times_of(const std::vector<FilmedScene>& scenes, const FrameTimes& wanted);

/// `count` equally spaced times, or as many as there are steps if those are fewer. [R/c]
std::vector<double> equal_times(double from, double until, int count, double step);

/// The scene's frames at these times, for as long as the scene lives.
Source source_of(const FilmedScene& scene, std::vector<double> times);

/// Pushes the row of a scene, or a list of rows of scenes; returns 1.
int push_filmed_rows(lua_State* L, const std::vector<FilmedScene>& scenes);

/// A path for what this call makes, which no other call of the script has made. `field`: where its name stands.
std::filesystem::path claimed_path(lua_State* L, const char* field, const std::string& name);
/// The same of a file in each of some formats (store/sinks.hpp); the first one's path.
template <class Sinks>
std::filesystem::path claimed_files(lua_State* L, const char* field, const std::string& name, const Sinks& formats) {
  std::filesystem::path first;
  for (const auto& format : formats) {
    const std::filesystem::path path = claimed_path(L, field, name + format.extension);
    if (first.empty()) first = path;
  }
  return first;
}

/// Mistakes in fields of a scene stand in the scene's own table, the others at this call.
template <class Work>
auto at_scene(const Session& session, const CallSite& call, const FilmedScene& scene, Work work) {
  try {
    return work();
  } catch (const FieldError& error) {
    const bool of_this_call = error.field == "frames" || error.field == "scene";
    throw_at(session, of_this_call ? call : scene.site, explained(error, scene.scene));
  }
}

/// The table at index 1 as a plain struct, with these values where it has none.
template <class Struct>
Struct members_of_call(lua_State* L, Struct values = {}, const Units& units = {}) {
  read_members(L, 1, values, units);
  return values;
}

}  // namespace ricochet
