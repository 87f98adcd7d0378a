#pragma once
// What acts where a scene leaves its contact to the program.

#include "contact/quasi_static.hpp"
#include "impact/launch/start.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// What line contact says of an aimed scene: both bodies smooth, a free one as a disk of its own area, a held one as a
/// block of its own depth, the modulus that of an even lattice of its springs. Of bodies of revolution, what Hertz
/// says: a free one as a sphere of its own volume, a held one as flat. `arrives`: the projectile as it meets the
/// target.
QuasiStaticImpact expected_impact(const Scene& scene, const Solids& solids, const Placement& arrives);

/// The scene's contact, with what it leaves out. It is to be hard as the bodies see it: 1/xi is a 200th of the
/// expected indentation, of rough rims a fiftieth; where springs yield or break, it holds no more than `held` of the
/// energy besides, since it gives back what they would have kept; where elements yield, of what they give back. A
/// length R of rim has `strength` times the energy of the impact, so that neither the spacing of its nodes nor the
/// impact lets one pass. The reach is 30/xi. Beside an attraction, with which it makes one potential, V0 is 150 m0 c^2
/// and xi 300/R. [here]
ExponentialRepulsion acting_contact(const Scene& scene, const Solids& solids, const Placement& arrives);

/// Bound of the frequency at which a node of either rim vibrates in the contact, at the greatest pressure to be
/// expected: omega^2 = 2 xi p s/m, s its share of the rim; of a rough rim, if an asperity takes a quarter of the force.
/// 0 where V0 was given. [c/R]
double contact_frequency(const Scene& scene, const Solids& solids, const Placement& arrives,
                         const ExponentialRepulsion& acts);

}  // namespace ricochet
