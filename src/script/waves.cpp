// ricochet.waves (lua/ricochet/waves.lua): the velocity along an axis in slices of the bodies, over time.

#include <fmt/format.h>
#include <unistd.h>

#include "record/slices.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/run_files.hpp"
#include "script/series_times.hpp"
#include "script/sweep_report.hpp"
#include "store/sinks.hpp"

namespace ricochet {
namespace {

/// How bodies are cut.
struct WavesAsked {
  std::string along = "y";
  int slices = 80;

  static const std::vector<Member<WavesAsked>>& fields() {
    static const std::vector<Member<WavesAsked>> list{
        {{"along", "string", "", "the axis", any_number, "y", false, {"x", "y"}}, &WavesAsked::along},
        {{"slices",
          "integer",
          "",
          "of the bodies that move, one beside the other; more than rows of nodes leave some empty: NaN",
          {2, 1e4},
          "80"},
         &WavesAsked::slices}};
    return list;
  }

  int axis() const { return along == "x" ? 0 : 1; }
};

// The bodies of a first frame, cut into as many slices as are asked for in all; nothing of a held one.
std::vector<std::pair<int, Slices>> cut(const FrameMesh& mesh, const Frame& first, const WavesAsked& asked) {
  std::vector<int> moving;
  double length = 0;
  for (int b = 0; b < static_cast<int>(mesh.bodies.size()); ++b) {
    if (!moves(mesh, b)) continue;
    moving.push_back(b);
    length += extent(mesh, first, b, asked.axis());
  }
  std::vector<std::pair<int, Slices>> all;
  for (const int b : moving) all.emplace_back(b, Slices(mesh, first, b, asked.axis(), length / asked.slices));
  return all;
}

// Appends to the list on top of the stack a row of every slice.
void push_slices(lua_State* L, const Frame& frame, const std::vector<std::pair<int, Slices>>& bodies,
                 const Units& units) {
  for (const auto& [body, slices] : bodies) {
    const std::vector<double> velocity = slices.velocity(frame);
    for (int s = 0; s < slices.count(); ++s) {
      const auto k = static_cast<std::size_t>(s);
      lua_createtable(L, 0, 5);
      set_number(L, "time", units.worth("R/c") * frame.time);
      set_number(L, "body", body + 1);
      set_number(L, "place", units.worth("R") * slices.place()[k]);
      set_number(L, "velocity", units.worth("c") * velocity[k]);
      lua_seti(L, -2, list_length(L, -2) + 1);
    }
  }
}

// wave_rows(waves): a row of every slice at each time; with --check those of the start alone.
int wave_rows(lua_State* L) {
  Session& session = session_of(L);
  std::vector<FilmedScene> scenes = filmed_scenes(L);
  const FilmedScene& filmed = scenes[0];
  const Units& units = filmed.scene.units;
  const WavesAsked asked = members_of_call<WavesAsked>(L);
  const SeriesTimes wanted = members_of_call<SeriesTimes>(L, {}, units);
  std::vector<double> times{0};
  if (!session.options.check) {
    lua_getfield(L, 1, "name");
    claimed_files(L, "name", lua_tostring(L, -1), rows_sinks());
    follow(L, scenes);
    times = series_times(L, filmed, wanted);
  }
  const FrameMesh mesh = frame_mesh(filmed.scene, filmed.solids);
  std::vector<std::pair<int, Slices>> bodies;
  lua_createtable(L, static_cast<int>(times.size()) * asked.slices, 0);
  RunProgress progress(session.options.quiet, isatty(STDERR_FILENO), times.back(), filmed.scene.units);
  at_scene(session, call_site(L), filmed, [&] {
    const bool whole = film_scene(filmed.solids, filmed.scene, times, stop_requested, [&](const Frame& frame) {
      progress.tell(frame.time);
      if (bodies.empty()) bodies = cut(mesh, frame, asked);
      push_slices(L, frame, bodies, units);
    });
    if (!whole) throw Error("interrupted", Exit::interrupted);
  });
  return 1;
}

}  // namespace

Group wave_functions() {
  return {
      .functions =
          {{.name = "waves",
            .doc =
                "How waves run through bodies: both cut into slices at right angles to an axis, and the mean "
                "velocity along it of the matter in each, over time. Draws it as NAME.png and NAME.svg, time across, "
                "the place in the first moment upwards, and leaves NAME.h5 and NAME.csv. Returns rows, one a slice "
                "and time: `time`; `body`, 1 the projectile, 2 the target; `place` of the slice's middle in the "
                "first moment; `velocity`, NaN in a slice without nodes.",
            .fields = std::vector<Field>{scene_field()} + fields_of<WavesAsked>() + fields_of<SeriesTimes>() +
                      std::vector<Field>{{"name", "string", "", "file name without extension", any_number, "waves"},
                                         {"title", "string", "", "above the picture", any_number, "", true},
                                         {"caption", "string", "", "below the title", any_number, "", true}},
            .returns = "rows",
            .example = "ricochet.waves { scene = scene, along = \"y\", slices = 100, name = \"rods\" }"}},
      .natives = {{"wave_rows", guarded<wave_rows>}}};
}

}  // namespace ricochet
