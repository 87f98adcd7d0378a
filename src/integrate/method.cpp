#include "integrate/method.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/spelling.hpp"

namespace ricochet {
namespace {

Method forest_ruth() {
  const double t = 1 / (2 - std::cbrt(2.0));
  return {"forest_ruth", "Forest & Ruth 1990, Physica D 43, 105", 4, 1.573, 0.3,
          {t / 2, (1 - t) / 2, (1 - t) / 2, t / 2}, {t, 1 - 2 * t, t}};
}

Method verlet() { return {"verlet", "Verlet 1967; the drift-kick-drift form", 2, 2.0, 0.6, {0.5, 0.5}, {1}}; }

Method pefrl() {
  const double a = 0.178617895844809068, b = 0.712341831062605425, c = -0.0662645826698184867;
  return {"pefrl", "Omelyan, Mryglod & Folk 2002, Comput. Phys. Commun. 146, 188", 4, 2.989, 0.8,
          {a, c, 1 - 2 * (a + c), c, a}, {b, 0.5 - b, 0.5 - b, b}};
}

}  // namespace

std::span<const Method> methods() {
  static const std::vector<Method> list{pefrl(), forest_ruth(), verlet()};
  return list;
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method& m : methods()) names.push_back(m.name);
  return names;
}

const Method& method_named(const std::string& name) {
  for (const Method& m : methods())
    if (m.name == name) return m;
  throw FieldError("method", "unknown method '" + name + "'" + did_you_mean(name, method_names()));
}

}  // namespace ricochet
