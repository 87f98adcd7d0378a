#include "impact/lammps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.hpp"
#include "impact/launch.hpp"

namespace ricochet {

LammpsFiles lammps_files(const Scene& scene, const Lattice& projectile, const Lattice& target,
                         const std::string& name) {
  if (!scene.effects.empty())
    throw FieldError("effects", "LAMMPS files hold springs and repulsion only; leave the effects out");
  const Start start = launch(scene, projectile, target);
  if (!start.touches) throw FieldError("scene", "the projectile passes by the target: there is nothing to export");

  Points points = posed(projectile.points, projectile.centre(), start.pose);
  points.insert(points.end(), target.points.begin(), target.points.end());
  const int of_projectile = projectile.nodes();
  std::vector<int> type(points.size(), 1);
  for (const int node : projectile.rim) type[static_cast<std::size_t>(node)] = 2;
  for (int i = 0; i < target.nodes(); ++i) type[static_cast<std::size_t>(of_projectile + i)] = i < target.free ? 3 : 5;
  for (const int node : target.rim)
    if (node < target.free) type[static_cast<std::size_t>(of_projectile + node)] = 4;
  double far = 0;
  for (const Vec2& p : points) far = std::max(far, p.lpNorm<Eigen::Infinity>());

  std::string atoms, velocities, coefficients, bonds;
  const auto add = [](std::string& text, const auto& form, const auto&... values) {
    fmt::format_to(std::back_inserter(text), fmt::runtime(form), values...);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool flies = static_cast<int>(i) < of_projectile;
    const Vec2& p = points[i];
    const Vec2 v = flies ? Vec2(start.velocity + start.spin * perpendicular(p - start.pose.centre)) : Vec2(0, 0);
    add(atoms, "{} {} {} {:.17g} {:.17g} 0\n", i + 1, flies ? 1 : 2, type[i], p.x(), p.y());
    add(velocities, "{} {:.17g} {:.17g} 0\n", i + 1, v.x(), v.y());
  }
  std::size_t bond = 0;
  for (const auto& [lattice, body, before] :
       {std::tuple(&projectile, scene.projectile.get(), 0), std::tuple(&target, scene.target.get(), of_projectile)})
    for (std::size_t s = 0; s < lattice->spring.size(); ++s) {
      const Spring spring = lattice->spring[s];
      const double ka = spring.stiffness * body->numbers.stiffness;
      ++bond;
      add(coefficients, "{} {:.17g} {:.17g} 0 {:.17g}\n", bond, spring.length, ka / 2, ka * lattice->quartic / 4);
      add(bonds, "{} {} {} {}\n", bond, bond, before + spring.node + 1, before + spring.other + 1);
    }

  LammpsFiles files;
  add(files.data,
      "{} by ricochet; units R, m0, c\n\n{} atoms\n{} bonds\n5 atom types\n{} bond types\n{} extra bond per atom\n\n",
      name, points.size(), bond, bond, 0);
  // A box with room for the flight: the boundaries are fixed, and an atom beyond them would be lost.
  add(files.data, "{0:.17g} {1:.17g} xlo xhi\n{0:.17g} {1:.17g} ylo yhi\n-0.5 0.5 zlo zhi\n\n", -3 * far - 1,
      3 * far + 1);
  add(files.data, "Masses\n\n1 {0:.17g}\n2 {0:.17g}\n3 {1:.17g}\n4 {1:.17g}\n5 {1:.17g}\n\n", projectile.mass,
      target.mass);
  files.data += "Bond Coeffs # class2\n\n" + coefficients + "\nAtoms # bond\n\n" + atoms + "\nVelocities\n\n" +
                velocities + "\nBonds\n\n" + bonds;

  const ExponentialRepulsion& contact = start.energy > 0 ? start.contact : scene.contact;
  const double step = start.step;
  const auto steps = static_cast<std::int64_t>(
      std::ceil((start.energy > 0 ? 4 / std::max(1e-9, -start.velocity.y()) * contact.reach + 10 : 10) / step));
  files.input = fmt::format(
      "# {0}: an impact of two lattices by LAMMPS; lmp -in {0}.in\n"
      "# Repulsion acts between rim nodes, not between nodes and segments: this is another law of contact than "
      "Ricochet's.\n"
      "units lj\ndimension 2\nboundary f f p\natom_style bond\nnewton on\natom_modify map array\n"
      "neighbor {1:.17g} bin\nbond_style class2\npair_style born {2:.17g}\nspecial_bonds lj 1 1 1\nread_data {0}.data\n"
      "pair_coeff * * 0 1 0 0 0\npair_coeff 2 4 {3:.17g} {4:.17g} 0 0 0\n"
      "neigh_modify every 1 delay 0 check yes\n",
      name, contact.reach / 2, contact.reach, contact.V0, 1 / contact.xi);
  for (int a = 1; a <= 5; ++a)
    for (int b = a; b <= 5; ++b)
      if (a != 2 || b != 4) files.input += fmt::format("neigh_modify exclude type {} {}\n", a, b);
  files.input += fmt::format(
      "group projectile type 1 2\ngroup free type 1 2 3 4\nfix move free nve\n"
      "thermo 1000\nvariable vx equal vcm(projectile,x)\nvariable vy equal vcm(projectile,y)\nthermo_style custom step "
      "time etotal ke pe v_vx v_vy\nthermo_modify format float %.15g\n"
      "timestep {:.17g}\nvariable steps index {}\nrun ${{steps}}\n",
      step, steps);
  return files;
}

}  // namespace ricochet
