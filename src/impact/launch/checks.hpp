#pragma once
// What must hold before an impact can start. Each check throws a FieldError that names the field and the remedy.

#include "impact/launch/start.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// The bodies can play their parts.
void check_bodies(const Solids& solids);

/// The projectile moves, or falls.
void check_motion(const Scene& scene, const Placement& launched);

/// No body of the law of small strains turns.
void check_small_turns(const Solids& solids, const Start& start);

/// The repulsion is cut neither where it shows nor beyond the smallest number.
void check_contact(const ExponentialRepulsion& contact);

/// Elements that yield are in space, follow no law beside that of yielding, and are evaluated once a step.
void check_yielding(const Scene& scene);

/// The effects can stand together, on these bodies, beside this contact.
void check_effects(const Scene& scene, const Solids& solids);

/// A given step may be ten times coarser than the contact's onset asks for: the ledger tells what that costs. A coarser
/// one may jump over the contact unseen, or through a body between two looks. `radius`: of the projectile.
void check_contact_is_seen(const Scene& scene, double step, double fastest, double radius);

/// A projectile so fast that following its contact would take more steps than anyone waits for. `fastest`: no node of
/// it is faster [c]; `radius`: of the projectile.
void check_patience(const Scene& scene, const Start& start, double fastest, double radius);

/// Time and places must move on in numbers of 53 bits.
void check_progress(const Scene& scene, const Start& start, double fastest);

/// In a shorter step what a node moves by is lost in rounding, but for so few digits that the impact does not notice.
/// `fastest`: no node of the projectile is faster [c]; `size`: of the places [R]. [R/c]
double least_step(double fastest, double size);

}  // namespace ricochet
