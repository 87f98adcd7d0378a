// ricochet.ringing: what rings in a body after an impact.

#include <fmt/format.h>

#include <algorithm>

#include "body/modes.hpp"
#include "impact/batch.hpp"
#include "impact/roles.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "script/step_choice.hpp"

namespace ricochet {
namespace {

struct RingingAsked {
  int count = 40;
  std::string of = "projectile";

  static const std::vector<Member<RingingAsked>>& fields() {
    static const std::vector<Member<RingingAsked>> list{
        {{"count", "integer", "", "how many modes, the slowest first", {1, 2000}, "40"}, &RingingAsked::count},
        {{"of", "string", "", "the body", any_number, "projectile", false, {"projectile", "target"}},
         &RingingAsked::of}};
    return list;
  }
};

/// A body at the end of an impact.
struct Rung {
  std::vector<Mode> modes;
  std::vector<double> energy;  ///< [mode] [m0 c^2]
  double vibration = not_given,
         before = not_given;  ///< all that vibrates; the projectile's energy of translation [m0 c^2]
};

// Where springs or elements keep a strain, or anchors a displacement, the places of the nodes tell no vibration.
void check_elastic(const Scene& scene, std::size_t body) {
  for (const Effect& effect : scene.effects) {
    const std::vector<int> on = bodies_of(effect, static_cast<int>(scene.bodies().size()));
    const bool moves_rest =
        std::visit([]<class E>(const E&) { return SpringChange<E> || ElementFlow<E> || AnchorMotion<E>; }, effect);
    if (moves_rest && std::find(on.begin(), on.end(), static_cast<int>(body)) != on.end())
      throw FieldError("effects", fmt::format("{} leaves the {} at rest elsewhere than where its modes are those of; "
                                              "leave it out to see what rings",
                                              name_of(effect), body_name(body)));
  }
}

Rung ring(Session& session, const Scene& scene, const RingingAsked& asked) {
  const BuiltSolids solids(scene);
  const std::size_t b = asked.of == "projectile" ? role::projectile : role::target;
  const Solid& solid = *Solids(solids)[b];
  check_elastic(scene, b);
  Rung rung;
  try {
    rung.modes = slowest_modes(solid, scene.bodies()[b]->numbers.stiffness, asked.count);
  } catch (const FieldError&) {
    throw;
  } catch (const Error& error) {
    throw FieldError(asked.of, error.what());
  }
  rung.energy.assign(rung.modes.size(), not_given);
  if (session.options.check) return rung;
  const Outcome outcome = run_scene(solids, scene, stop_requested);
  if (stop_requested) throw Error("interrupted", Exit::interrupted);
  if (outcome.status != Status::finished) throw FieldError("scene", "its impact does not finish: " + outcome.reason);
  Snapshot last;
  const Observer observer{outcome.time, equally_spaced(outcome.time, 1, 1, outcome.step),
                          [&](const Snapshot& shot) { last = shot; }};
  run_scene(solids, scene, stop_requested, &observer);
  if (stop_requested) throw Error("interrupted", Exit::interrupted);
  rung.energy = mode_energies(solid, rung.modes, last.bodies[b].place, last.bodies[b].velocity);
  rung.vibration = last.energy.of(b).vibration;
  rung.before = outcome.before.of(role::projectile).translation;
  return rung;
}

int ringing(lua_State* L) {
  check_table(L, 1, function_named("ringing"));
  Session& session = session_of(L);
  RingingAsked asked;
  read_members(L, 1, asked);
  lua_getfield(L, 1, "scene");
  const SceneObject& object = scene_at(L, -1);
  Rung rung;
  try {
    rung = ring(session, with_chosen_step(session, object.scene), asked);
  } catch (const FieldError& error) {
    throw_at(session, object.site, explained(error, object.scene));
  }
  const Units& units = object.scene.units;
  const double energy = units.worth("m0 c^2");
  lua_createtable(L, static_cast<int>(rung.modes.size()), 2);
  for (std::size_t k = 0; k < rung.modes.size(); ++k) {
    lua_createtable(L, 0, 4);
    set_number(L, "mode", static_cast<double>(k + 1));
    set_number(L, "omega", units.worth("c/R") * rung.modes[k].omega);
    set_number(L, "energy", energy * rung.energy[k]);
    set_number(L, "share", rung.energy[k] / rung.before);
    push_strict(L, "a mode that rings");
    lua_seti(L, -2, static_cast<lua_Integer>(k) + 1);
  }
  set_number(L, "vibration", energy * rung.vibration);
  set_number(L, "before", energy * rung.before);
  return 1;
}

}  // namespace

Group ringing_functions() {
  return {
      .functions = {
          {.name = "ringing",
           .doc = "What rings in a body after an impact: the energy of each of its free vibrations, the "
                  "slowest first. A list of tables: `mode`, its number, as in `modes`; `omega`; `energy`; "
                  "`share` of the energy with which the projectile came. The list holds `vibration` and "
                  "`before` too: all that vibrates in the body after the impact, and the energy with "
                  "which the projectile came. In small impacts the modes together hold what vibrates.",
           .fields = std::vector<Field>{{"scene", "scene", "", "whose impact finishes"}} + fields_of<RingingAsked>(),
           .returns = "table",
           .example = "ricochet.ringing { scene = scene, count = 20 }[1].share",
           .call = guarded<ringing>}}};
}

}  // namespace ricochet
