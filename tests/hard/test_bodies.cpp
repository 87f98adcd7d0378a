// Hard cases of bodies: shapes that are refused by name, and ugly ones that are not.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "hard/table.hpp"
#include "impact/batch.hpp"
#include "scenes.hpp"
#include "shape/triangulate.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

std::string refusal(const Points& outline, const BodyNumbers& n) {
  try {
    build_solid(Body{outline, n, {}, {}});
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("hard 14: outlines that make no body are refused by name") {
  Case of(14, "coincident nodes, isolated node, zero-length spring, empty, self-crossing or tiny outlines");
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  struct Refused {
    Points outline;
    BodyNumbers numbers;
    const char* words;
  };
  const BodyNumbers usual = numbers(100, 1, 0, 1);
  const std::vector<Refused> list{
      {{}, usual, "at least 3 points"},
      {{{0, 0}}, usual, "at least 3 points"},
      {{{0, 0}, {1, 0}}, usual, "at least 3 points"},
      {{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, usual, "crosses or touches itself"},
      {{{0, 0}, {1, 0}, {1, 0}, {0, 1}}, usual, "crosses or touches itself"},
      {{{0, 0}, {1, 0}, {2, 0}}, usual, "crosses or touches itself"},
      {{{0, 0}, {2, 0}, {1, 0}, {1, 1}}, usual, "crosses or touches itself"},
      {{{0, 0}, {1, 0}, {1, 1}, {0.5, 0}, {0, 1}}, usual, "crosses or touches itself"},
      {{{0, 0}, {1, 0}, {nan, 1}}, usual, "not finite"},
      {{{0, 0}, {1, 0}, {0, inf}}, usual, "not finite"},
      {circle(), numbers(3, 1, 0, 1), "cannot cover this outline"},
      {circle(), numbers(800, 1, 1.0, 1), "rough rim crosses itself"},
      {{{0, 0}, {100, 0}, {100, 0.001}, {0, 0.001}}, numbers(10, 1, 0, 1), "cannot cover this outline"},
  };
  int refused = 0;
  for (const Refused& r : list) {
    const std::string text = refusal(r.outline, r.numbers);
    INFO(r.words << " | " << text);
    const bool right = text.find(r.words) != std::string::npos;
    CHECK(right);
    refused += right;
  }
  bool coincident = false;
  try {
    triangulate({{0, 0}, {1, 0}, {0, 1}, {0.25, 0.25}, {0.25, 0.25}}, ring(3));
  } catch (const Error& error) {
    coincident = std::string(error.what()).find("coincide at (0.25, 0.25)") != std::string::npos;
  }
  CHECK(coincident);
  of.all(static_cast<int>(list.size()) + 1, refused + coincident, "refused, naming what is wrong");

  // A script names nodes and springs by its outline alone: what comes of it has no loose node and no spring of length
  // 0.
  int whole = 0, all = 0;
  for (int seed = 1; seed <= 200; ++seed) {
    Random random(static_cast<std::uint64_t>(seed), 31);
    Points star;
    const int corners = 3 + static_cast<int>(random.uniform(0, 9));
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * (i + random.uniform(0.1, 0.9)) / corners,
                   radius = random.uniform(0.2, 1);
      star.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    const char* placement = std::array{"uniform", "poisson_disk", "triangular"}[static_cast<std::size_t>(seed % 3)];
    std::shared_ptr<const Solid> lattice;
    try {
      lattice = build_solid(Body{star, numbers(150, 1, seed % 2 ? 0.01 : 0, seed, placement), {}, {}});
    } catch (const Error&) {
      continue;  // too slim a star, or too rough for it
    }
    std::vector<int> springs(static_cast<std::size_t>(lattice->nodes()));
    bool right = true;
    for (std::size_t s = 0; s < lattice->springs()->list.size(); ++s) {
      const Spring spring = lattice->springs()->list[s];
      ++springs[static_cast<std::size_t>(spring.node)];
      ++springs[static_cast<std::size_t>(spring.other)];
      right = right && spring.length > 0;
    }
    for (const int count : springs) right = right && count >= 2;
    CHECK(right);
    whole += right;
    ++all;
  }
  CHECK(all > 100);
  of.all(all, whole, "random stars in which every node has two springs at least, none of length 0");
}

TEST_CASE("hard 15: near-duplicate nodes and slivers run as usual") {
  Case of(15, "near-duplicate nodes at 1e-3 ... 1e-12 R, slivers");
  int right = 0, all = 0;
  double drift = 0;
  for (int decade = 3; decade <= 12; ++decade)
    for (const bool below : {true, false}) {
      // Two corners of the projectile so near each other, at the bottom or at the side.
      const double gap = std::pow(10, -decade);
      Points outline;
      for (const Vec2& p : circle(1, 24)) {
        outline.push_back(p);
        if ((below && p.y() < -0.999) || (!below && p.x() > 0.999))
          outline.push_back(p + gap * Vec2(below ? 1 : 0, below ? 0 : 1));
      }
      Scene scene = small_scene(1, 0.5, 0);
      scene.projectile = std::make_shared<Body>(Body{outline, numbers(80, 1e4, 0, 1, "uniform"), {}, {}});
      bool fine = false;
      try {
        const Outcome o = run_scene(BuiltSolids(scene), scene, go_on);
        INFO(name_of(o.status) << " " << o.reason);
        fine = o.status == Status::finished && std::isfinite(o.e);
        CHECK(fine);
        drift = std::max(drift, o.energy_drift);
      } catch (const Error& error) {
        FAIL_CHECK(gap << ": " << error.what());
      }
      right += fine;
      ++all;
    }
  of.all(all, right, "impacts that finish");
  of.at_most(1e-6, drift, "largest |E - E0| / E0");

  // The paper's nodes, thrown at random: the flattest of 1e5 triangles.
  double flattest = 1;
  for (int seed = 1; seed <= 30; ++seed) {
    const auto lattice =
        build_solid(*std::make_shared<Body>(Body{circle(), numbers(800, 1e4, 0.03, seed, "uniform"), {}, {}}));
    for (const Triangle& t : lattice->cells) {
      const Vec2 u = lattice->points[static_cast<std::size_t>(t[1])] - lattice->points[static_cast<std::size_t>(t[0])],
                 v = lattice->points[static_cast<std::size_t>(t[2])] - lattice->points[static_cast<std::size_t>(t[0])];
      flattest = std::min(flattest, cross(u, v) / std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()}));
    }
  }
  of.told(flattest, "height over longest side of the flattest of 45 000 triangles of the paper's disks");
}
