#include "record/lammps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "core/error.hpp"
#include "impact/axes.hpp"
#include "impact/launch/aim.hpp"
#include "impact/launch/launch.hpp"
#include "impact/roles.hpp"

namespace ricochet {

namespace {

template <class... Values>
void add(std::string& text, const char* form, const Values&... values) {
  fmt::format_to(std::back_inserter(text), fmt::runtime(form), values...);
}

/// What the data file says of each body, in the order of atoms.
struct Sections {
  std::string atoms, masses, velocities, coefficients, bonds;
  std::size_t atom_count = 0, bond_count = 0;
  double far = 0;  ///< greatest coordinate [R]
};

// Types of a body's nodes: inside, rim, held.
std::vector<int> types_of(const Solid& solid, int inside, int rim, int held) {
  std::vector<int> type(static_cast<std::size_t>(solid.nodes()), inside);
  for (const int node : surface_nodes(solid.surface)) type[static_cast<std::size_t>(node)] = rim;
  for (int i = solid.free; i < solid.nodes(); ++i) type[static_cast<std::size_t>(i)] = held;
  return type;
}

void add_springs(Sections& sections, const Springs& springs, double stiffness, std::size_t before) {
  const std::array<double, 3> series = with_spring_law(springs.law, [](const auto& law) { return law.series(); });
  for (std::size_t s = 0; s < springs.list.size(); ++s) {
    const Spring spring = springs.list[s];
    const double ka = spring.stiffness * stiffness;
    const std::size_t bond = ++sections.bond_count;
    add(sections.coefficients, "{} {:.17g} {:.17g} {:.17g} {:.17g}\n", bond, spring.length, ka * series[0],
        ka * series[1], ka * series[2]);
    add(sections.bonds, "{} {} {} {}\n", bond, bond, before + static_cast<std::size_t>(spring.node) + 1,
        before + static_cast<std::size_t>(spring.other) + 1);
  }
}

void add_body(Sections& sections, const Solid& solid, const Placement& placement, int molecule,
              const std::vector<int>& types, double stiffness) {
  const Points points = placed(solid.points, solid.centre(), placement);
  const std::size_t before = sections.atom_count;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2& p = points[i];
    const Vec2 v = in_plane(placement.velocity) + about(placement.spin) * perpendicular(p - in_plane(placement.centre));
    const std::size_t atom = ++sections.atom_count;
    add(sections.atoms, "{} {} {} {:.17g} {:.17g} 0\n", atom, molecule, types[i], tangential(p), normal(p));
    add(sections.masses, "{} {:.17g}\n", atom, solid.mass[static_cast<int>(i)]);
    add(sections.velocities, "{} {:.17g} {:.17g} 0\n", atom, tangential(v), normal(v));
    sections.far = std::max(sections.far, p.lpNorm<Eigen::Infinity>());
  }
  add_springs(sections, *solid.springs(), stiffness, before);
}

std::string data_file(const Sections& s, const std::string& name) {
  std::string data;
  add(data,
      "{} by ricochet; units R, m0, c\n\n{} atoms\n{} bonds\n5 atom types\n{} bond types\n{} extra bond per atom\n\n",
      name, s.atom_count, s.bond_count, s.bond_count, 0);
  // A box with room for the flight: the boundaries are fixed, and an atom beyond them would be lost.
  add(data, "{0:.17g} {1:.17g} xlo xhi\n{0:.17g} {1:.17g} ylo yhi\n-0.5 0.5 zlo zhi\n\n", -3 * s.far - 1,
      3 * s.far + 1);
  add(data, "Masses  # of types: the atoms' own, below, count\n\n1 1\n2 1\n3 1\n4 1\n5 1\n\n");
  // What a fix reads comes last: Debian 12's LAMMPS does not find the section after it.
  return data + "Bond Coeffs # class2\n\n" + s.coefficients + "\nAtoms # bond\n\n" + s.atoms + "\nVelocities\n\n" +
         s.velocities + "\nBonds\n\n" + s.bonds + "\nRMass\n\n" + s.masses;
}

// Of a rim node: where V0 is that of a length R of rim, its mean share. [m0 c^2]
double node_V0(const ExponentialRepulsion& contact, const Solid& projectile) {
  if (!contact.by_length) return contact.V0;
  const std::vector<double>& share = std::get<Mesh<2>>(projectile.surface).weight;
  return contact.V0 * std::accumulate(share.begin(), share.end(), 0.0) / static_cast<double>(share.size());
}

std::string input_file(const Solid& projectile, const Start& start, const std::string& name) {
  const ExponentialRepulsion& contact = start.contact;
  const double step = start.step;
  const auto steps = static_cast<std::int64_t>(std::ceil(
      (start.energy > 0 ? 4 / std::max(1e-9, -normal(seen_by_target(start).velocity)) * contact.reach + 10 : 10) /
      step));
  std::string input = fmt::format(
      "# {0}: an impact of two lattices by LAMMPS; lmp -in {0}.in\n"
      "# Repulsion acts between rim nodes, not between nodes and segments: this is another law of contact than "
      "Ricochet's.\n"
      "units lj\ndimension 2\nboundary f f p\natom_style bond\nnewton on\natom_modify map array\n"
      "neighbor {1:.17g} bin\nbond_style class2\npair_style born {2:.17g}\nspecial_bonds lj 1 1 1\nfix own all "
      "property/atom rmass\n"
      "read_data {0}.data fix own NULL RMass\n"
      "pair_coeff * * 0 1 0 0 0\npair_coeff 2 4 {3:.17g} {4:.17g} 0 0 0\n"
      "neigh_modify every 1 delay 0 check yes\n",
      name, contact.reach / 2, contact.reach, node_V0(contact, projectile), 1 / contact.xi);
  for (int a = 1; a <= 5; ++a)
    for (int b = a; b <= 5; ++b)
      if (a != 2 || b != 4) input += fmt::format("neigh_modify exclude type {} {}\n", a, b);
  input += fmt::format(
      "group projectile type 1 2\ngroup free type 1 2 3 4\nfix move free nve\n"
      "thermo 1000\nvariable vx equal vcm(projectile,x)\nvariable vy equal vcm(projectile,y)\nthermo_style custom step "
      "time etotal ke pe v_vx v_vy\nthermo_modify norm no format float %.15g\n"
      "timestep {:.17g}\nvariable steps index {}\nrun ${{steps}}\n",
      step, steps);
  return input;
}

}  // namespace

LammpsFiles lammps_files(const Scene& scene, const Solids& solids, const std::string& name) {
  if (!scene.effects.empty())
    throw FieldError("effects", "LAMMPS files hold springs and repulsion only; leave the effects out");
  const Solid &projectile = *solids[role::projectile], &target = *solids[role::target];
  for (const std::size_t b : {role::projectile, role::target})
    if (!solids[b]->springs())
      throw FieldError(body_name(b), fmt::format("LAMMPS files hold bodies of springs only, and this one is {}; take "
                                                 "one of springs",
                                                 solids[b]->elements() ? "of elements"
                                                 : solids[b]->modes()  ? "of modes"
                                                                       : "rigid"));
  const Start start = launch(scene, solids);
  if (!start.touches) throw FieldError("scene", "the projectile passes by the target: there is nothing to export");
  Sections sections;
  add_body(sections, projectile, start.bodies[role::projectile], 1, types_of(projectile, 1, 2, 5),
           start.stiffness[role::projectile]);
  add_body(sections, target, start.bodies[role::target], 2, types_of(target, 3, 4, 5), start.stiffness[role::target]);
  return {data_file(sections, name), input_file(projectile, start, name)};
}

}  // namespace ricochet
