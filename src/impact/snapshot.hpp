#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "body/springs/rest.hpp"
#include "core/vec2.hpp"
#include "impact/outcome.hpp"

namespace ricochet {

/// What an observer sees of one body.
struct BodyShot {
  Points place, velocity, force;            ///< [node] [R], [c], of contact [m0 c^2/R]
  std::vector<SpringRest<double>> springs;  ///< [spring] what effects have left of each; empty without such effects
  /// [element] C_p^-1 (xx, xy, yy, zz) and plastic strain, as PlasticMemory; empty unless elements yield.
  std::vector<std::array<double, 5>> plastic;
};

/// What an observer sees of a body's rigid motion; a held body has none.
struct RigidShot {
  Vec2 centre, velocity;  ///< of mass [R], [c]
  double spin;            ///< [c/R]
};

/// What an observer sees of a run at the end of a step.
struct Snapshot {
  double time = 0;  ///< since the surfaces came within reach of each other [R/c]
  std::int64_t step = 0;
  std::vector<BodyShot> bodies;  ///< by index
  std::vector<RigidShot> rigid;  ///< by index
  Ledger energy;
  double first_touch = Outcome::undefined;  ///< when projectile and target first touched [R/c]; NaN before
};

/// Looks at a single impact without changing a bit of it. `due(time)` is asked at the end of every step whether to look
/// there.
struct Observer {
  double until = 0;  ///< go on up to this time, even past the end of the impact
  std::function<bool(double)> due;
  std::function<void(const Snapshot&)> look;
  bool no_longer = false;  ///< stop at `until`, even if the impact goes on: its outcome is then not_run
};

/// For `due`: true at the steps nearest to first, first + spacing, ... (count of them at most).
inline std::function<bool(double)> equally_spaced(double first, double spacing, std::int64_t count, double step) {
  return [=, seen = std::int64_t{0}](double time) mutable {
    if (seen >= count || time < first + static_cast<double>(seen) * spacing - step / 2) return false;
    ++seen;
    return true;
  };
}

}  // namespace ricochet
