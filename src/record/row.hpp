#pragma once
// A result: what is kept of one impact, as a line of a table.

#include <string>
#include <vector>

#include "core/field.hpp"

namespace ricochet {

struct Outcome;
struct Scene;

struct Row {
  std::vector<double> outcomes;  ///< in the order of Outcome::fields(), in the scene's units
  double seconds = 0;
  std::string status, reason, hash, seed, units;

  /// The columns beside the outcomes.
  static const std::vector<Member<Row>>& fields();
  bool finished() const;
};

Row row_of(const Scene& scene, const Outcome& outcome, double seconds);
/// The same of a scene whose hash is known.
Row row_of(const Scene& scene, const Outcome& outcome, double seconds, std::string hash);

}  // namespace ricochet
