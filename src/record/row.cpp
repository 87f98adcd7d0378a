#include "record/row.hpp"

#include <fmt/format.h>

#include "impact/outcome.hpp"
#include "impact/scene.hpp"

namespace ricochet {

const std::vector<Member<Row>>& Row::fields() {
  static const std::vector<Member<Row>> list{
      {{"wall_seconds", "number", "s",
        "its share of the time of the thread that ran it; impacts in lanes share it evenly"},
       &Row::seconds},
      {{"status", "string", "",
        "how it ended: finished, energy_drift, not_finite, unstable, tunnelled, no_contact, out_of_time"},
       &Row::status},
      {{"reason", "string", "",
        "a sentence, if it did not finish, finished while the bodies touched, or leaves e_n undefined"},
       &Row::reason},
      {{"scene_hash", "string", "", "hash of the scene's canonical text"}, &Row::hash},
      {{"seed", "string", "", "seed of the projectile"}, &Row::seed},
      {{"units", "string", "", "those of the scene, in which its numbers are: paper or SI"}, &Row::units},
  };
  return list;
}

bool Row::finished() const { return status == name_of(Status::finished); }

Row row_of(const Scene& scene, const Outcome& outcome, double seconds) {
  return row_of(scene, outcome, seconds, scene.hash());
}

Row row_of(const Scene& scene, const Outcome& outcome, double seconds, std::string hash) {
  Row row;
  for (const auto& [field, value] : Outcome::fields())
    row.outcomes.push_back((scene.mirrored && turns_in_mirror(field.name) ? -value(outcome) : value(outcome)) *
                           scene.units.worth(field.unit));
  row.seconds = seconds;
  row.status = name_of(outcome.status);
  row.reason = scene.units.explained(outcome.reason);
  row.hash = std::move(hash);
  row.units = scene.units.system();
  row.seed = fmt::format("{}", scene.projectile->numbers.seed);
  return row;
}

}  // namespace ricochet
