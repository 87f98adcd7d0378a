// ricochet.record, ricochet.lammps: impacts as files for other programs.

#include "script/records.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "record/film.hpp"
#include "record/lammps.hpp"
#include "script/fields.hpp"
#include "script/filmed.hpp"
#include "script/run_files.hpp"
#include "store/files.hpp"
#include "store/sinks.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// Without pictures the free flight before the impact is of no use, and fewer frames will do.
const FrameTimes record_times{.frames = 120, .from = 0};
const FileName trajectory_name{"trajectory"}, lammps_name{"impact"};

Trajectory trajectory_of(const FilmedScene& filmed, const std::vector<double>& times) {
  Trajectory trajectory(frame_mesh(filmed.scene, filmed.solids, filmed.course));
  if (!film_scene(filmed.solids, filmed.scene, times, stop_requested,
                  [&](Frame frame) { trajectory.add(std::move(frame)); }))
    throw Error("interrupted", Exit::interrupted);
  return trajectory;
}

}  // namespace

void store_recording(lua_State* L, const std::vector<FilmedScene>& scenes, const fs::path& path,
                     const FrameTimes& wanted) {
  Session& session = session_of(L);
  const FilmedScene& filmed = scenes[0];
  at_scene(session, call_site(L), filmed, [&] {
    const Trajectory trajectory = trajectory_of(filmed, times_of(scenes, wanted));
    Provenance provenance = session.provenance();
    provenance["scene"] = filmed.scene.text();
    provenance["scene_hash"] = filmed.scene.hash();
    write_everywhere(fs::path(path).replace_extension(), trajectory, provenance);
    session.inform(fmt::format("{} frames in {}\n", trajectory.frames().size(), path.string()));
  });
}

namespace {

int record(lua_State* L) {
  check_table(L, 1, function_named("record"));
  Session& session = session_of(L);
  std::vector<FilmedScene> scenes = filmed_scenes(L);
  const FilmedScene& filmed = scenes[0];
  if (session.options.check) return push_filmed_rows(L, scenes);
  const std::string name = members_of_call(L, trajectory_name).out;
  const fs::path path = claimed_files(L, "out", name, trajectory_sinks());
  const FrameTimes wanted = members_of_call(L, record_times, filmed.scene.units);
  follow(L, scenes);
  store_recording(L, scenes, path, wanted);
  return push_filmed_rows(L, scenes);
}

// Writes OUT.data and OUT.in.
int lammps(lua_State* L) {
  check_table(L, 1, function_named("lammps"));
  Session& session = session_of(L);
  const std::vector<FilmedScene> scenes = filmed_scenes(L);
  const FilmedScene& filmed = scenes[0];
  if (session.options.check) return 0;
  at_scene(session, call_site(L), filmed, [&] {
    const fs::path data = below_folder(L, members_of_call(L, lammps_name).out + ".data");
    const LammpsFiles files = lammps_files(filmed.scene, filmed.solids, data.stem().string());
    session.folders.claim(session.own_folder());
    const fs::path input = fs::path(data).replace_extension(".in");
    for (const fs::path& file : {data, input}) session.folders.own(file);
    make_folder(data.parent_path());
    write_atomically(data, files.data);
    write_atomically(input, files.input);
    session.inform(fmt::format("LAMMPS files: {}, beside it .in\n", data.string()));
  });
  return 0;
}

}  // namespace

Group record_functions() {
  return {.functions = {
              {.name = "record",
               .doc = "Stores an impact as H5MD (OUT.h5, for MDAnalysis and `ricochet render`) and OUT.xdmf (for "
                      "ParaView). Returns the impact's row.",
               .fields = std::vector<Field>{scene_field()} + fields_of(record_times) + fields_of(trajectory_name),
               .returns = "table",
               .example = "ricochet.record { scene = scene, frames = 200 }",
               .call = guarded<record>},
              {.name = "lammps",
               .doc = "Exports a scene without effects for LAMMPS: OUT.data and the input script OUT.in, with every "
                      "spring as a bond of bond_style class2, which carries the quartic term. "
                      "LAMMPS repels node from node, not from segment.",
               .fields = std::vector<Field>{scene_field()} + fields_of(lammps_name),
               .returns = "nothing",
               .example = "ricochet.lammps { scene = scene }",
               .call = guarded<lammps>}}};
}

}  // namespace ricochet
