#pragma once
// When an impact is sampled: what ricochet.series and ricochet.waves take of times.

#include "script/filmed.hpp"

namespace ricochet {

/// When the points of a series are.
struct SeriesTimes {
  int points = 400;
  double from = 0;
  double duration = not_given;

  static const std::vector<Member<SeriesTimes>>& fields();
};

/// The times that are wanted of a scene whose course is known. Throws "from" at the call, past the impact's end. [R/c]
std::vector<double> series_times(lua_State* L, const FilmedScene& filmed, const SeriesTimes& wanted);

}  // namespace ricochet
