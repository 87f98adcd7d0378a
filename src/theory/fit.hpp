#pragma once
// Walton's three parameters from a table of impacts, with standard errors. [Foerster, Louge, Chang & Allia 1994 fit the
// same two lines]

#include "theory/argument.hpp"

namespace ricochet::theory {

struct ImpactTable {
  Numbers psi1, psi2, e;
  double beta_x = 3;
  static Arguments<ImpactTable> fields();
};

struct WaltonFit {
  double e, e_se, mu, mu_se, beta0, beta0_se, psi1_0, residual, sticking, sliding;
  static Arguments<WaltonFit> fields();
};

/// Least squares of Psi2 = max(-beta0 Psi1, Psi1 - s), s = beta_x mu (1 + e): in Psi2, unlike in beta, the scatter does
/// not grow where Psi1 is small. Impacts below a break stick, those above slide; of every break with two impacts or
/// more of different Psi1 on either side, the one with the least sum of squares counts. e is the mean. The standard
/// errors are those of the two lines with a common scatter; that of mu carries that of e. They hold for independent
/// impacts and a break that the table leaves no doubt of; where impacts share lattices, or sliding begins between few
/// and scattered ones, resample (lua/ricochet/figures.lua does, by lattice).
WaltonFit fit_walton(const ImpactTable& table);

}  // namespace ricochet::theory
