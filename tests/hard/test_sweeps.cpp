// Hard cases of sweeps: the same bits whatever runs beside, golden hashes, and the paper's sweeps in full.

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "core/hash.hpp"
#include "core/lane.hpp"
#include "hard/random_scene.hpp"
#include "hard/table.hpp"
#include "impact/sweep.hpp"
#include "scenes.hpp"
#include "script/program.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

std::string hash_of(const std::vector<Scene>& list, int threads, int batch, std::size_t first_part) {
  std::vector<std::string> texts(list.size());
  const auto keep = [&](const std::vector<Result>& results) {
    for (const Result& r : results) texts[r.index] = exact_text(r.outcome);
  };
  // As a sweep that was stopped after some scenes and resumed.
  for (const bool resumed : {false, true}) {
    std::vector<bool> todo;
    for (std::size_t i = 0; i < list.size(); ++i) todo.push_back((i < first_part) != resumed);
    run_sweep(list, todo, {threads, batch}, go_on, keep);
  }
  std::string all;
  for (const std::string& text : texts) all += text;
  return hash_text(all);
}

/// Five scenes that between them use every kind of method, contact and effect.
std::map<std::string, Scene> reference_scenes() {
  std::map<std::string, Scene> list;
  list["soft wall"] = small_scene(1, 1);
  Scene& multirate = list["multirate, rough, grazing"] = small_scene(2, 6);
  multirate.integration.method = "multirate_3";
  Scene& disks = list["two free disks, spin, two-sided"];
  disks.projectile = disk(60, 1e4, 0.02, 1);
  disks.target = disk(80, 3e3, 0.02, 2);
  disks.launch.at = 0.5;
  disks.launch.psi1 = 0.4;
  disks.launch.spin = 0.5;
  disks.contact = paper_contact();
  disks.contact.sides = "two";
  disks.integration.method = "blanes_moan_srkn11b";
  Scene& effects = list["ten effects but one"] = small_scene(3, 2);
  effects.effects = {Gravity{1e-4, "both"},
                     Drag{0.1, "projectile"},
                     Absorbing{0.5, 2},
                     Damping{1e-3, "both"},
                     Plastic{1e-3, 0.1, "projectile"},
                     Breaking{0.01, "target"},
                     Adhesion{0.1, 200},
                     Friction{0.3, 1},
                     Thermal{1e-6, 3, "both"}};
  Scene& hard = list["hard wall, fast, force gradient"] = small_scene(4, 0.5);
  Body stiff = *hard.target;
  stiff.numbers.stiffness = 1e5;
  stiff.numbers.quartic = 100;
  hard.target = std::make_shared<Body>(stiff);
  hard.launch.speed = 0.3;
  hard.integration.method = "chin_4a";
  return list;
}

// The columns of an outcome that the golden hashes are made of, in their order: those that come later move no hash.
const std::vector<std::string>& golden_columns() {
  static const std::vector<std::string> names{"e",
                                              "beta",
                                              "mu",
                                              "psi1",
                                              "psi2",
                                              "vn",
                                              "vt",
                                              "omega",
                                              "impulse_n",
                                              "impulse_t",
                                              "touches",
                                              "indentation",
                                              "contact_length",
                                              "centre_offset",
                                              "tan_alpha",
                                              "e_alpha",
                                              "before_projectile_translation",
                                              "before_projectile_rotation",
                                              "before_projectile_vibration",
                                              "before_target_vibration",
                                              "before_total",
                                              "after_projectile_translation",
                                              "after_projectile_rotation",
                                              "after_projectile_vibration",
                                              "after_target_translation",
                                              "after_target_rotation",
                                              "after_target_vibration",
                                              "after_contact",
                                              "energy_closure",
                                              "energy_drift",
                                              "inverted",
                                              "inversion_time",
                                              "time",
                                              "step",
                                              "theta",
                                              "theta_most",
                                              "steps",
                                              "momentum_residual",
                                              "error_step",
                                              "gravity_energy",
                                              "drag_energy",
                                              "absorbing_energy",
                                              "moving_anchor_energy",
                                              "damping_energy",
                                              "plastic_energy",
                                              "plastic_springs",
                                              "breaking_energy",
                                              "breaking_springs",
                                              "adhesion_energy",
                                              "friction_energy"};
  return names;
}

std::string golden_text(const Outcome& outcome) {
  std::string text = name_of(outcome.status) + ";";
  for (const std::string& name : golden_columns()) {
    const auto& columns = Outcome::fields();
    const auto column =
        std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.first.name == name; });
    REQUIRE(column != columns.end());
    text += fmt::format("{:a};", column->second(outcome));
  }
  return text;
}

/// Every finished row of a script's sweep, run by the program.
struct Rows {
  int all = 0, finished = 0, tunnelled = 0;
  double closure = 0;
};

Rows rows_of(const std::string& script, const std::string& arguments) {
  const Workplace here;
  const Ended ended = here.run(std::string(RICOCHET_SOURCE) + "/scripts/" + script + ".lua --quiet " + arguments);
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  const Table table = read_table(here.path / "out" / script / "results.h5");
  Rows rows;
  rows.all = static_cast<int>(table.rows());
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const std::string& status = table.text("status")->values[i];
    rows.finished += status == "finished";
    rows.tunnelled += status == "tunnelled";
    rows.closure = std::max(rows.closure, table.number("energy_closure")->values[i]);
  }
  return rows;
}

}  // namespace

TEST_CASE("hard 20: the same bits for 1 to 16 threads, every batch, and resumed after every scene") {
  Case of(20, "threads 1 ... 16, batches of every size, resumed after every scene");
  std::vector<Scene> list;
  for (int seed = 1; seed <= 2; ++seed)
    for (const double psi1 : {0.0, 1.0, 3.0, 8.0}) list.push_back(small_scene(seed, psi1));
  const std::string expected = hash_of(list, 1, 1, 0);
  int same = 0, all = 0;
  for (int threads = 1; threads <= 16; threads += sanitized ? 5 : 1)
    for (int batch = 1; batch <= lanes; ++batch) {
      same += hash_of(list, threads, batch, 0) == expected;
      ++all;
    }
  of.all(all, same, "sweeps of 8 scenes with the same hash");
  int resumed = 0;
  for (std::size_t part = 1; part < list.size(); ++part) resumed += hash_of(list, 2, lanes, part) == expected;
  of.all(static_cast<int>(list.size()) - 1, resumed, "the same, stopped after 1 ... 7 scenes and resumed");
}

TEST_CASE("hard 20: five reference scenes have their golden hashes") {
  Case of(20, "threads 1 ... 16, batches of every size, resumed after every scene");
  // Of x86-64 with glibc's sine and cosine. A change of these lines is a change of results: say so in the CHANGELOG.
  const std::map<std::string, std::string> golden{
      {"soft wall", "5c8ff4f0708cdee9e0eb375c908b8b28"},
      {"multirate, rough, grazing", "37e5baf32eba4b977e50b6413ce3875f"},
      {"two free disks, spin, two-sided", "7976cf02f13e56f65ee55fb8659d1e4b"},
      {"ten effects but one", "9e54a019f2acdf2c8f599f9b2cead237"},
      {"hard wall, fast, force gradient", "65a07b62d6ef33bd16b339fc00581513"},
  };
  int same = 0, all = 0;
  std::vector<Scene> list;
  std::vector<std::string> names;
  for (const auto& [name, scene] : reference_scenes()) {
    list.push_back(scene);
    names.push_back(name);
  }
  for (int threads = 1; threads <= 8; threads += sanitized ? 3 : 1)
    for (int batch = 1; batch <= lanes; ++batch) {
      std::vector<std::string> hashes(list.size());
      run_sweep(list, std::vector<bool>(list.size(), true), {threads, batch}, go_on,
                [&](const std::vector<Result>& results) {
                  for (const Result& r : results) {
                    INFO(names[r.index] << ": " << r.outcome.reason);
                    CHECK(r.outcome.status == Status::finished);
                    hashes[r.index] = hash_text(golden_text(r.outcome));
                  }
                });
      for (std::size_t i = 0; i < list.size(); ++i) {
        const auto expected = golden.find(names[i]);
        INFO(names[i] << " " << hashes[i]);
        const bool right = expected != golden.end() && hashes[i] == expected->second;
        CHECK(right);
        same += right;
        ++all;
      }
    }
  of.all(all, same, "golden hashes of five scenes, 8 numbers of threads, 4 of lanes (debug and release)");
}

TEST_CASE("hard 23: the paper's soft wall, 100 lattices, every angle", "[.slow]") {
  Case of(23, "soft wall (ratio 1/100) at 0.1 c, 100 lattices, psi1 from 0 to 8");
  for (const char* method : {"method=pefrl", "accuracy=1e-3"}) {
    const Rows rows = rows_of("soft_wall", std::string("samples=100 ") + method);
    of.all(rows.all, rows.finished, fmt::format("samples that finish, {}", method));
    of.all(0, rows.tunnelled, fmt::format("samples that tunnelled, {}", method));
    of.at_most(1e-4, rows.closure, fmt::format("largest energy closure, {}", method));
  }
}

TEST_CASE("hard 24: the paper's hard wall, rough, grazing, 100 lattices", "[.slow]") {
  Case of(24, "hard wall (ratio 10), roughness 0.03 R, psi1 = 4 ... 8, 100 lattices");
  for (const char* method : {"method=pefrl", "accuracy=1e-3"}) {
    const Rows rows = rows_of("soft_wall", std::string("samples=100 ratio=10 psi1=4,5,6,7,8 ") + method);
    of.all(rows.all, rows.finished, fmt::format("samples that finish, {}", method));
    of.all(0, rows.tunnelled, fmt::format("samples that tunnelled, {}", method));
    of.at_most(1e-4, rows.closure, fmt::format("largest energy closure, {}", method));
  }
}

TEST_CASE("hard matrix: random scenes of every kind end in a right result, or say truly why not") {
  Case of(25, "random scenes of every kind (more by ./workbench test --matrix)");
  constexpr int count = 40;
  int right = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const RandomScene random = random_scene(static_cast<std::uint64_t>(seed));
    const Verdict verdict = judged(random, 2e4);
    INFO(seed << ": " << verdict.wrong.value_or("") << "\n" << random.text);
    CHECK_FALSE(verdict.wrong);
    right += !verdict.wrong;
  }
  of.all(count, right, "scenes that end right, or with a status that is true and advice that helps");
}
