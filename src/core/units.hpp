#pragma once
// The units that a user of a scene sees. Inside all is in R, m0 and c; the script layer divides what it reads by what
// these units are worth, and multiplies what it gives back.

#include <string>

namespace ricochet {

/// What R, m0 and R/c are worth to the user: one each in the paper's units; metres, kilograms and seconds in SI.
struct Units {
  double length = 1, mass = 1, time = 1;
  bool si = false;

  /// What 1 of a unit in R, m0 and c ("m0 c^2/R", "R/c") is in the user's; 1 of any other (degrees, s).
  double worth(const std::string& unit) const;
  /// The user's name of such a unit: "m0 c^2" is "J" in SI.
  std::string name(const std::string& unit) const;
  /// A value as computed, with the user's unit: "1.2e-06 s"; `digits` that count.
  std::string shown(double value, const std::string& unit, int digits = 3) const;
  /// A sentence of the engine with its numbers in R, m0 and c ("0.5 R/c") told in the user's units.
  std::string explained(const std::string& sentence) const;
  /// "paper" or "SI".
  std::string system() const { return si ? "SI" : "paper"; }
  /// Those of a system alone, where only names are asked for.
  static Units named(const std::string& system) { return {1, 1, 1, system == "SI"}; }
};

}  // namespace ricochet
