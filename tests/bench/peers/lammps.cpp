// LAMMPS on the same lattices: do both vibrate alike, what does a spring cost in each, what does an impact cost in each
// at equal accuracy of e, and what do mean values of e cost.
// `./workbench bench` runs it with Debian's lammps, one core each, in turn.

#include "record/lammps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "body/interior.hpp"
#include "core/error.hpp"
#include "impact/accuracy.hpp"
#include "impact/batch.hpp"
#include "impact/launch/launch.hpp"
#include "impact/sweep.hpp"
#include "scenes.hpp"
#include "store/files.hpp"

using namespace ricochet;
using namespace ricochet::test;
namespace fs = std::filesystem;

namespace {

const std::atomic<bool> go_on{false};
const fs::path folder = fs::temp_directory_path() / "ricochet_peers";

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

template <class Work>
double seconds(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A line of the table in scripts/README.md: what was measured, theirs and ours, in the unit named.
struct Line {
  std::string what, unit;
  double theirs, ours;
};
std::vector<Line> table;

void print_table() {
  fmt::print("\n| | LAMMPS | Ricochet | ratio |\n|---|---|---|---|\n");
  for (const Line& line : table)
    fmt::print("| {} | {:.4g} {} | {:.3g} {} | {:.0f} |\n", line.what, line.theirs, line.unit, line.ours, line.unit,
               line.theirs / line.ours);
}

/// Runs an input script in `folder`; returns its log.
std::string run_lammps(const std::string& input) {
  write_atomically(folder / "peer.in", input);
  const std::string command = fmt::format(
      "cd {} && OMP_NUM_THREADS=1 lmp -in peer.in -log peer.log -screen none > lmp.out 2>&1", folder.string());
  if (std::system(command.c_str()) != 0)
    throw Error(fmt::format("lmp failed (Debian package lammps; its words: {})", (folder / "lmp.out").string()));
  return read_file(folder / "peer.log");
}

double number_after(const std::string& text, const std::string& mark) {
  const auto at = text.rfind(mark);
  if (at == std::string::npos) throw Error("no '" + mark + "' in LAMMPS's log");
  return std::stod(text.substr(at + mark.size()));
}

/// The input script as exported, for `steps` of `step`; without contact if not wanted.
std::string script(std::string input, double step, long steps, bool contact) {
  const auto replace_line = [&](const std::string& begin, const std::string& by) {
    for (std::size_t at; (at = input.find("\n" + begin)) != std::string::npos;)
      input.replace(at, input.find('\n', at + 1) - at, by.empty() ? "" : "\n" + by + "#");
  };
  replace_line("timestep ", "");
  replace_line("run ", "");
  if (!contact) {
    replace_line("pair_coeff ", "");
    replace_line("neigh_modify ", "");
    replace_line("pair_style ", "");
  }
  if (!contact) {
    input.insert(input.find("\nspecial_bonds"), "\npair_style zero 0.15\n");
    input.insert(input.find("\ngroup "), "\npair_coeff * *\n");
  }
  return input +
         fmt::format(
             "timestep {:.17g}\nrun {}\nwrite_dump all custom peer.dump id x y modify sort id format float %.17g\n",
             step, steps);
}

Scene paper_scene(double psi1) {
  Scene scene = test::paper_scene();
  scene.projectile = disk(800, 1e4, 0.03, 1);
  scene.target = wall(4000, 100, 0.03, 1, 8, 2);
  scene.launch.psi1 = psi1;
  return scene;
}

void same_vibration() {
  // A disk that spins at once is drawn out by its spin, and rings; its springs harden much.
  Scene scene = paper_scene(1);
  Body body = *scene.projectile;
  body.numbers.quartic = 100;
  scene.projectile = std::make_shared<Body>(body);
  scene.launch.spin = 0.5;
  const BuiltSolids solids(scene);
  const Solid& disk = solids[0];
  const LammpsFiles files = lammps_files(scene, solids, "vibration");
  write_atomically(folder / "vibration.data", files.data);
  const double h = 2e-3;
  const long steps = 2000;
  const std::string log = run_lammps(script(files.input, h, steps, false));

  // Velocity Verlet by the engine's own sweep: half a kick, then drift and kick in turn.
  const Start start = launch(scene, solids);
  const Placement& placement = start.bodies.front();
  const Vec2 centre = in_plane(placement.centre), velocity = in_plane(placement.velocity);
  Motion<1> moving = at_rest<1>(disk);
  moving.stiffness.setConstant(1e4);
  put(moving, 0, placement);
  const Motion<1> before = moving;
  const auto lane = [](double value) -> Lane<1> { return Lane<1>::Constant(value); };
  kick_and_drift(moving, lane(h / 2), lane(h));
  for (long i = 1; i < steps; ++i) kick_and_drift(moving, lane(h), lane(h));
  const double energy = interior_energy(moving)[0];
  kick_and_drift(moving, lane(h / 2), lane(0));

  std::ifstream dump(folder / "peer.dump");
  std::string line;
  for (int i = 0; i < 9; ++i) std::getline(dump, line);
  double furthest = 0, moved = 0;
  for (int i = 0; i < disk.nodes(); ++i) {
    long id;
    double x, y;
    dump >> id >> x >> y;
    furthest = std::max(furthest, (Vec2(x, y) - moving.q.at(i, 0)).norm());
    const Vec2 offset = before.q.at(i, 0) - centre;
    moved = std::max(moved, std::abs((moving.q.at(i, 0) - (centre + h * steps * velocity)).norm() - offset.norm()));
  }
  // The last line of thermodynamics: step, time, total, kinetic and potential energy.
  std::istringstream last(log.substr(log.rfind("\n", log.find("Loop time") - 2) + 1));
  double step, time, total, kinetic, potential;
  last >> step >> time >> total >> kinetic >> potential;
  fmt::print(
      "free vibration, {} springs with quartic = 100, spin 0.5 c/R, {} steps of velocity Verlet: radii change by "
      "{:.3g} R;\n"
      "  positions of LAMMPS and Ricochet differ by {:.1e} R at most, energies of the springs by {:.1e} of "
      "themselves\n",
      disk.springs()->list.size(), steps, moved, furthest, std::abs(potential / energy - 1));
}

void spring_cost() {
  const Scene scene = paper_scene(1);
  const BuiltSolids solids(scene);
  const LammpsFiles files = lammps_files(scene, solids, "vibration");
  write_atomically(folder / "vibration.data", files.data);
  double springs = 0;
  Motions<lanes> bodies;
  for (std::size_t b : {0, 1}) {
    springs += work_of_sweep(solids[b]);
    Motion<lanes>& body = bodies.emplace_back(at_rest<lanes>(solids[b]));
    body.stiffness.setConstant(scene.bodies()[b]->numbers.stiffness);
    for (int i = 0; i < body.solid->free; ++i)
      for (int l = 0; l < lanes; ++l) body.v.set(i, l, Vec2(1e-3 * std::sin(i), 0));
  }
  std::vector<double> theirs, ours, ratios;
  constexpr long steps = 1500;
  const Lane<lanes> step = Lane<lanes>::Constant(1e-3);
  for (int round = 0; round < 9; ++round) {
    theirs.push_back(number_after(run_lammps(script(files.input, 2e-3, steps, false)), "Loop time of ") / steps /
                     springs * 1e9);
    ours.push_back(seconds([&] {
                     for (long i = 0; i < steps; ++i)
                       for (Motion<lanes>& body : bodies) kick_and_drift(body, step, step);
                   }) /
                   steps / springs / lanes * 1e9);
    ratios.push_back(theirs.back() / ours.back());
  }
  fmt::print(
      "a spring and force evaluation, whole step, no contact, {:.0f} springs, 9 rounds in turn:\n"
      "  LAMMPS class2    least {:.2f} ns, median {:.2f} ns\n  Ricochet {} lanes least {:.2f} ns, median {:.2f} ns a "
      "lane\n  ratio {:.1f} of the medians, {:.1f} of the least\n",
      springs, *std::min_element(theirs.begin(), theirs.end()), median(theirs), lanes,
      *std::min_element(ours.begin(), ours.end()), median(ours), median(theirs) / median(ours),
      *std::min_element(theirs.begin(), theirs.end()) / *std::min_element(ours.begin(), ours.end()));
  table.push_back({"a spring and step", "ns", median(theirs), median(ours)});
}

/// Seconds of LAMMPS by psi1.
using ByAngle = std::map<double, double>;

ByAngle impact_cost() {
  constexpr double wanted = 1e-3;
  const std::vector<double> angles{0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0};
  std::vector<Scene> scenes;
  for (const double psi1 : angles) scenes.push_back(paper_scene(psi1));
  const BuiltSolids solids(scenes.front());

  // Nodes repel nodes in LAMMPS: the repulsion must reach over the gaps between them, or one rim slips through the
  // other.
  std::vector<LammpsFiles> files;
  std::vector<double> times;
  double omega = 0;
  for (const Scene& scene : scenes) {
    files.push_back(lammps_files(scene, solids, "vibration"));
    Scene stronger = scene;
    stronger.contact.V0 *= std::exp(scene.contact.xi * 0.03);
    files.back().input = lammps_files(stronger, solids, "vibration").input;
    times.push_back(1.2 * run_scene(solids, scene, go_on).time);
    const Start start = launch(scene, solids);
    omega = start.theta / start.step;
  }
  const auto e_and_seconds = [&](std::size_t i, double theta) {
    write_atomically(folder / "vibration.data", files[i].data);
    const double h = theta / omega;
    const std::string log = run_lammps(script(files[i].input, h, std::lround(times[i] / h), true));
    std::istringstream last(log.substr(log.rfind("\n", log.find("Loop time") - 2) + 1));
    double value = 0;
    for (int column = 0; column < 7; ++column) last >> value;
    return std::pair(-value / scenes[i].launch.velocity().y(), number_after(log, "Loop time of ") / 1.2);
  };
  std::vector<double> reference, seconds_of_theirs;
  for (std::size_t i = 0; i < scenes.size(); ++i) reference.push_back(e_and_seconds(i, 0.1).first);
  fmt::print(
      "an impact of one lattice, {} angles, e to {:g} at every angle\n  LAMMPS, velocity Verlet, nodes against nodes, "
      "beside its own runs at theta = 0.1:\n",
      scenes.size(), wanted);
  double theirs_theta = 0;
  for (double theta : {1.9, 1.6, 1.2, 0.8, 0.5, 0.3}) {
    double worst = 0;
    seconds_of_theirs.clear();
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const auto [e, took] = e_and_seconds(i, theta);
      worst = std::max(worst, std::abs(e - reference[i]));
      seconds_of_theirs.push_back(took);
    }
    fmt::print("    theta = {:.1f}: greatest error {:.1e}, median {:.2f} s an impact\n", theta, worst,
               median(seconds_of_theirs));
    if (worst <= wanted) {
      theirs_theta = theta;
      break;
    }
  }
  if (theirs_theta == 0) throw Error("LAMMPS reaches the accuracy at no theta tried");

  std::vector<double> exact;
  for (const Scene& scene : scenes) {
    Scene fine = scene;
    fine.integration.method = "blanes_moan_srkn6b";
    fine.integration.theta = 0.5;
    exact.push_back(run_scene(solids, fine, go_on).e);
  }
  // All scenes by one method: the greatest error of e, and seconds an impact, one thread, lattices and launch included.
  const auto error_and_seconds = [&](const std::string& method, double theta) {
    std::vector<Scene> ours = scenes;
    for (Scene& scene : ours) {
      scene.integration.method = method;
      scene.integration.theta = theta;
    }
    double worst = 0;
    const double took = seconds([&] {
      run_sweep(ours, std::vector<bool>(ours.size(), true), {1, lanes}, go_on, [&](const auto& done) {
        for (const auto& one : done) worst = std::max(worst, std::abs(one.outcome.e - exact[one.index]));
      });
    });
    return std::pair(worst, took / static_cast<double>(ours.size()));
  };
  struct Way {
    std::string how, method;
    double theta, error;
    std::vector<double> seconds{};
  };
  std::vector<TrialScene> tried;
  for (const Scene& scene : scenes) {
    tried.push_back({solids, scene});
    tried.back().scene.integration.accuracy = wanted;
  }
  const Choice choice = choose_for_accuracy(tried, tried.size(), 1, go_on);
  std::vector<Way> ways{{"as accuracy chooses, from its estimates", choice.method, choice.theta,
                         error_and_seconds(choice.method, choice.theta).first}};
  Way alike{"chosen like theirs, beside own fine runs", "", 0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (const char* method : {"takahashi_imada", "multirate_2", "multirate_3", "multirate_5"})
    for (double share : {0.8, 0.7, 0.6}) {
      const double theta = share * method_named(method).stability_limit;
      const auto [error, took] = error_and_seconds(method, theta);
      if (error <= wanted && took < least) {
        least = took;
        alike.method = method;
        alike.theta = theta;
        alike.error = error;
      }
    }
  if (!alike.method.empty()) ways.push_back(alike);
  // In turn, so that both meet the machine in the same mood.
  std::vector<double> theirs;
  std::vector<std::vector<double>> at_angle(angles.size());
  for (int round = 0; round < 5; ++round) {
    std::vector<double> each;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      each.push_back(e_and_seconds(i, theirs_theta).second);
      at_angle[i].push_back(each.back());
    }
    theirs.push_back(median(each));
    for (Way& way : ways) way.seconds.push_back(error_and_seconds(way.method, way.theta).second);
  }
  fmt::print(
      "  LAMMPS at theta = {:.1f}: median {:.2f} s an impact\n  Ricochet, one thread, lattices and launch included:\n",
      theirs_theta, median(theirs));
  for (const Way& way : ways)
    fmt::print("    {}: {}, theta {:.2f}, greatest error {:.1e}: median {:.3f} s an impact, ratio {:.1f}\n", way.how,
               way.method, way.theta, way.error, median(way.seconds), median(theirs) / median(way.seconds));
  table.push_back({"an impact, its e to 1e-3, as `accuracy` chooses", "s", median(theirs), median(ways[0].seconds)});
  ByAngle seconds;
  for (std::size_t i = 0; i < angles.size(); ++i) seconds[angles[i]] = median(at_angle[i]);
  return seconds;
}

/// Mean e at the ten angles of the paper's figure, each with a standard error of 0.02: Ricochet by its own plan, trials
/// and pilot included, against the impacts of that plan in LAMMPS, and of a fixed number at each angle, as its user
/// would run. Theirs: impacts times what one took above.
void means_cost(const ByAngle& theirs) {
  const std::string command = fmt::format(
      "{} run {}/scripts/soft_wall.lua standard_error=0.02 --threads 1 --quiet --no-report --force --out {}/means",
      RICOCHET_PROGRAM, RICOCHET_ROOT, folder.string());
  std::vector<double> ours;
  std::string told;
  for (int round = 0; round < 3; ++round) {
    fs::remove_all(folder / "means");
    ours.push_back(seconds([&] {
      if (std::system((command + " > " + (folder / "means.out").string() + " 2>&1").c_str()) != 0)
        throw Error(fmt::format("'{}' failed: {}", command, read_file(folder / "means.out")));
    }));
  }
  const std::string mark = "deviations ";
  const double fixed = number_after(read_file(folder / "means.out"), mark);
  std::ifstream counts(folder / "means" / "soft_wall" / "soft_wall_samples.csv");
  std::string line;
  std::getline(counts, line);
  double impacts = 0, planned = 0, all = 0;
  while (std::getline(counts, line)) {
    std::istringstream cells(line);
    std::vector<double> value;
    for (std::string cell; std::getline(cells, cell, ',');) value.push_back(std::stod(cell));
    const double of_angle = value.at(6), took = theirs.at(std::round(2 * value.at(0)) / 2);
    impacts += of_angle;
    planned += of_angle * took;
    all += fixed * took;
  }
  fmt::print(
      "mean e within a standard error of 0.02 at ten angles\n"
      "  Ricochet, one thread, pilot and trials included: {:.0f} impacts, {:.1f} s (median of {})\n"
      "  LAMMPS, the same impacts: {:.0f} s, ratio {:.0f}\n"
      "  LAMMPS, {:.0f} at every angle, as the pilot asks for: {:.0f} s, ratio {:.0f}\n",
      impacts, median(ours), ours.size(), planned, planned / median(ours), fixed, all, all / median(ours));
  table.push_back(
      {fmt::format("mean e within a standard error of 0.02 at ten angles, the same {:.0f} impacts in both", impacts),
       "s", planned, median(ours)});
  table.push_back(
      {fmt::format("the same with {:.0f} impacts at every angle in LAMMPS, as who does not plan must run", fixed), "s",
       all, median(ours)});
}

}  // namespace

int main() try {
  make_folder(folder);
  same_vibration();
  spring_cost();
  means_cost(impact_cost());
  print_table();
  fs::remove_all(folder);
} catch (const std::exception& error) {
  fmt::print(stderr, "error: peers: {}\n", error.what());
  return 1;
}
