#pragma once
#include <limits>

#include "body/description.hpp"

namespace ricochet {

/// A body as the laws see it.
struct Elastic {
  double modulus = std::numeric_limits<double>::infinity(), poisson = 0;
  double density = std::numeric_limits<double>::infinity();
  bool held = true;  ///< infinitely heavy

  double wave_speed() const;  ///< c_P
  double shear_speed() const;
};

/// Of its means where moduli or density change from place to place.
Elastic elastic_of(const Body& body);

}  // namespace ricochet
