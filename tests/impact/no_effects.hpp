#pragma once
#include "impact/engine.hpp"

namespace ricochet::test {

/// Stands in for ActingEffects and does nothing: what the engine asks of it is known to the compiler.
template <int W>
struct NoEffects {
  static constexpr bool catalogue = false;
  using Bodies = std::array<Moving<W>, 2>;
  using Energies = std::array<Lane<W>, effect_kinds>;
  NoEffects(const std::vector<Effect>&, const Lattice&, const Lattice&) {}
  static constexpr bool empty() { return true; }
  struct Flying {
    Vec2 velocity;
    double spin;
  };
  static Flying at_parting(int, const Flying& later, double) { return later; }
  static constexpr bool split() { return false; }
  static constexpr bool shakes() { return false; }
  void begin(int, double, const std::vector<Effect>&, Bodies&, double) {}
  void add_forces(int, Moving<W>&) {}
  void release_anchors(Moving<W>&) const {}
  void book_anchors(const Moving<W>&, const Lane<W>&) {}
  void drift_anchors(Moving<W>&, const Lane<W>&) {}
  void dissipate(Bodies&, const Lane<W>&, bool) {}
  Lane<W> spring_change(int, const Moving<W>&) const { return Lane<W>::Zero(); }
  static constexpr bool changes_springs(int) { return false; }
  SpringRest<Lane<W>> rest(int, int, const Lane<W>& stretch) const { return {stretch, Lane<W>::Ones()}; }
  std::array<double, effect_kinds> counts(int) const { return Outcome::no_effects(); }
  Energies energies(const Bodies&) const {
    Energies none;
    none.fill(Lane<W>::Zero());
    return none;
  }
};

}  // namespace ricochet::test
