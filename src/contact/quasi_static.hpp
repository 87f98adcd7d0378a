#pragma once

namespace ricochet {

/// What a contact law that knows no waves says of an impact at its greatest compression; the time is that of all the
/// contact. Forces of plane bodies are per unit of thickness.
struct QuasiStaticImpact {
  double force;       ///< [m0 c^2/R]
  double approach;    ///< of the bodies: the indentation of smooth outlines [R]
  double half_width;  ///< a: the contact is 2a long, or a circle of that radius [R]
  double time;        ///< [R/c]
  double pressure;    ///< in the middle of the contact [m0 c^2/R^2, m0 c^2/R^3 of a circle]
  bool in_range;      ///< the contact is narrower than the bodies
};

}  // namespace ricochet
