#pragma once
// What a scene is refused for.

#include "core/error.hpp"
#include "scenes.hpp"

namespace ricochet::test {

/// "field: message" of the scene's refusal.
inline std::string refusal(const Scene& scene) {
  static const std::atomic<bool> go_on{false};
  try {
    run_scene(BuiltSolids(scene), scene, go_on);
  } catch (const FieldError& error) {
    return error.field + ": " + error.what();
  }
  return "nothing was refused";
}

}  // namespace ricochet::test
