#pragma once
// A body of modes in motion, in W lanes.

#include <array>
#include <limits>
#include <vector>

#include "core/carrier.hpp"
#include "core/place.hpp"
#include "core/vec2.hpp"

namespace ricochet {

/// Where a body of modes is and how it moves; the places and velocities of its nodes follow from it.
template <int W>
struct ModalState {
  Place<W, 2> centre, velocity;     ///< of mass [R], [c]
  Lane<W> angle = Lane<W>::Zero();  ///< by how much the frame has turned from where the body was built
  Lane<W> spin = Lane<W>::Zero();   ///< L/I [c/R]
  Lane<W> cosine = Lane<W>::Ones(), sine = Lane<W>::Zero();  ///< of the angle, when nodes were last placed
  std::vector<Lane<W>> q, p;  ///< [mode] its displacement [R m0^1/2] and momentum [c m0^1/2]

  /// Passes on an impact.
  void carry(int lane, Carrier& carrier) {
    for (Lane<W>* number :
         {&centre.at[0], &centre.at[1], &velocity.at[0], &velocity.at[1], &angle, &spin, &cosine, &sine})
      carrier.pass((*number)[lane]);
    for (std::vector<Lane<W>>* modes : {&q, &p})
      for (Lane<W>& number : *modes) carrier.pass(number[lane]);
  }
};

/// How each mode turns in a time: q -> q cosine + p sine/omega, p -> p cosine - q omega sine. Written with a sum in
/// both lines, as core/turn.hpp says.
template <int W>
struct ModalTurn {
  Lane<W> time = Lane<W>::Constant(std::numeric_limits<double>::quiet_NaN());  ///< [R/c]
  Lane<W> stiffness = Lane<W>::Zero();                                         ///< of the body, in each lane
  std::vector<Lane<W>> cosine, sine_per_omega, minus_omega_sine;               ///< [mode]
};

template <int W>
struct ModalMotion {
  ModalState<W> state;
  std::array<ModalTurn<W>, 4> turns;  ///< of the last times: the drifts of a method are a few
  std::size_t oldest = 0;             ///< of `turns`

  /// Where the body was built, in every lane.
  void rest(std::size_t modes, const Vec2& centre) {
    for (int d = 0; d < 2; ++d) {
      state.centre.at[d].setConstant(centre[d]);
      state.velocity.at[d].setZero();
    }
    state.q.assign(modes, Lane<W>::Zero());
    state.p = state.q;
  }

  // Kept for their memory.
  std::vector<Lane<W>> displacement, rate;  ///< [coordinate of the nodes at hand] in the frame
  std::vector<Lane<W>> push;                ///< [coordinate of the surface] what kicks it, in the frame
  std::vector<std::size_t> pushed;          ///< its nodes that are pushed in any lane
};

}  // namespace ricochet
