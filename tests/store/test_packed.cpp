// A replay as a page carries it, read back by a decoder of the tests' own.

#include <libdeflate.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "store/packed.hpp"

using namespace ricochet;

namespace {

std::string inflated(const std::string& small, std::size_t size) {
  std::string bytes(size, '\0');
  std::size_t written = 0;
  libdeflate_decompressor* decompressor = libdeflate_alloc_decompressor();
  const auto result =
      libdeflate_zlib_decompress(decompressor, small.data(), small.size(), bytes.data(), size, &written);
  libdeflate_free_decompressor(decompressor);
  REQUIRE(result == LIBDEFLATE_SUCCESS);
  REQUIRE(written == size);
  return bytes;
}

// A ring of nodes about the origin that flies, turns and shakes; the last node lies as far out as a plane's end.
Trajectory flight(double stretch) {
  constexpr int nodes = 50, frames = 40;
  FrameMesh mesh;
  mesh.mass.assign(nodes, 1.0);
  for (int n = 0; n + 3 < nodes; ++n) mesh.triangles.push_back({n + 2, n, n + 1});
  Trajectory trajectory(mesh);
  for (int f = 0; f < frames; ++f) {
    Frame frame;
    frame.time = f;
    for (int n = 0; n < nodes; ++n) {
      const double angle = n + 0.05 * f, far = n + 1 == nodes ? 1000 : stretch;
      frame.position.push_back(static_cast<float>(far * (std::cos(angle) + 0.02 * f)));
      frame.position.push_back(static_cast<float>(far * (std::sin(angle) - 0.01 * f * f / 40)));
      frame.velocity.push_back(static_cast<float>(0.1 * std::sin(angle * n)));
      frame.velocity.push_back(static_cast<float>(0.02 * f));
    }
    trajectory.add(frame);
  }
  return trajectory;
}

void check_round_trip(double stretch) {
  const Trajectory trajectory = flight(stretch);
  const std::size_t nodes = 50, frames = 40, count = 2 * nodes * frames;
  const PackedReplay replay = packed(trajectory);
  const std::string place = inflated(replay.place, 2 * count), colour = inflated(replay.colour, nodes * frames);
  double worst = 0, worst_colour = 0;
  for (std::size_t k = 0; k < 2 * nodes; ++k) {
    std::int16_t q = 0;
    for (std::size_t f = 0; f < frames; ++f) {
      const std::size_t at = k * frames + f;
      q = static_cast<std::int16_t>(
          q + (static_cast<unsigned char>(place[at]) | static_cast<unsigned char>(place[count + at]) << 8));
      if (k < 2 * (nodes - 1))
        worst = std::max(worst, std::abs(q * replay.grid - static_cast<double>(trajectory.frames()[f].position[k])));
    }
  }
  for (std::size_t n = 0; n < nodes; ++n) {
    std::uint8_t level = 0;
    for (std::size_t f = 0; f < frames; ++f) {
      level = static_cast<std::uint8_t>(level + static_cast<std::uint8_t>(colour[n * frames + f]));
      const auto& v = trajectory.frames()[f].velocity;
      const double speed = std::hypot(static_cast<double>(v[2 * n]), static_cast<double>(v[2 * n + 1]));
      const double share = std::sqrt(std::min(1.0, speed / replay.top));
      worst_colour = std::max(worst_colour, std::abs(static_cast<double>(level) / replay.levels - share));
    }
  }
  CHECK(worst <= 0.5 * replay.grid * (1 + 1e-9));
  CHECK(worst_colour <= 0.5 / replay.levels + 1e-12);
  const std::size_t corners = 3 * trajectory.mesh().triangles.size();
  const std::string triangles = inflated(replay.triangles, 4 * corners);
  std::uint32_t node = 0;
  for (std::size_t i = 0; i < corners; ++i) {
    std::uint32_t step = 0;
    for (std::size_t k = 0; k < 4; ++k)
      step |= static_cast<std::uint32_t>(static_cast<unsigned char>(triangles[k * corners + i])) << (8 * k);
    node += step;
    CHECK(node == static_cast<std::uint32_t>(trajectory.mesh().triangles[i / 3][i % 3]));
  }
}

}  // namespace

TEST_CASE("a packed replay has every place within half a grid step and every colour within half a level") {
  check_round_trip(1);
  CHECK(packed(flight(1)).grid == 1e-3);
}

TEST_CASE("a body too wide for the grid takes a coarser one") {
  check_round_trip(50);
  CHECK(packed(flight(50)).grid > 1e-3);
}

TEST_CASE("equal replays are packed to equal bytes, and bytes are spelt in base 64") {
  CHECK(packed(flight(1)).place == packed(flight(1)).place);
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string("\xff\x00\xfe", 3)) == "/wD+");
}
