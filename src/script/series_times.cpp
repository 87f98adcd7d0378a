#include "script/series_times.hpp"

#include <fmt/format.h>

#include <cmath>

#include "script/fields.hpp"

namespace ricochet {

const std::vector<Member<SeriesTimes>>& SeriesTimes::fields() {
  static const std::vector<Member<SeriesTimes>> list{
      {{"points",
        "integer",
        "",
        "how many, equally spaced in time; one a step where the steps are fewer",
        {2, 1e5},
        by_struct},
       &SeriesTimes::points},
      {{"from", "number", "R/c", "first time; before 0 the projectile is in free flight", {-1e6, 1e6}, by_struct},
       &SeriesTimes::from},
      {{"duration", "number", "R/c",
        "time covered, from `from` on, past the end of the impact if it is longer; up to that end unless given",
        positive, "", true},
       &SeriesTimes::duration},
  };
  return list;
}

std::vector<double> series_times(lua_State* L, const FilmedScene& filmed, const SeriesTimes& wanted) {
  const double end = filmed.course.outcome.time;
  if (std::isnan(wanted.duration) && wanted.from >= end)
    throw_here(
        L, FieldError("from", fmt::format("is not before the impact's end at {}; give an earlier time, or a duration",
                                          filmed.scene.units.shown(end, "R/c", 4))));
  const double until = std::isnan(wanted.duration) ? end : wanted.from + wanted.duration;
  return equal_times(wanted.from, until, wanted.points, filmed.course.step);
}

}  // namespace ricochet
