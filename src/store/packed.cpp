#include "store/packed.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numeric>

#include "core/error.hpp"

namespace ricochet {

namespace {

constexpr double greatest = 32767;
constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// Of bodies that have an inside: the ends of a plane are drawn as far away as one likes.
double reach_of(const Trajectory& trajectory) {
  std::vector<bool> inside(static_cast<std::size_t>(trajectory.mesh().nodes()));
  for (const auto& triangle : trajectory.mesh().triangles)
    for (const int node : triangle) inside[static_cast<std::size_t>(node)] = true;
  double reach = 0;
  for (const Frame& frame : trajectory.frames())
    for (std::size_t n = 0; n < inside.size(); ++n)
      for (std::size_t k = 0; inside[n] && k < 2; ++k)
        reach = std::max(reach, std::abs(static_cast<double>(frame.position[2 * n + k])));
  return reach;
}

// Of a number that is not negative.
std::int32_t rounded(double number) { return static_cast<std::int32_t>(number + 0.5); }

std::int32_t on_grid(double place, double grid) {
  const double steps = std::clamp(place / grid, -greatest, greatest);
  return steps < 0 ? -rounded(-steps) : rounded(steps);
}

// [item][frame], from what gives it frame by frame: `numbers(frame, item)`. By blocks of items, so that what is read
// and what is written both stay in the cache.
template <class Number, class Numbers>
std::vector<Number> courses(std::size_t frames, std::size_t items, const Numbers& numbers) {
  constexpr std::size_t block = 64;
  std::vector<Number> all(frames * items);
  for (std::size_t first = 0; first < items; first += block)
    for (std::size_t f = 0; f < frames; ++f)
      for (std::size_t k = first; k < std::min(first + block, items); ++k) all[k * frames + f] = numbers(f, k);
  return all;
}

// Each course from 0 on, as what it changes by from frame to frame.
template <class Number>
void as_steps(std::vector<Number>& courses, std::size_t frames) {
  for (std::size_t begin = 0; begin < courses.size(); begin += frames)
    std::adjacent_difference(courses.begin() + static_cast<std::ptrdiff_t>(begin),
                             courses.begin() + static_cast<std::ptrdiff_t>(begin + frames),
                             courses.begin() + static_cast<std::ptrdiff_t>(begin));
}

std::string packed_places(const Trajectory& trajectory, double grid) {
  const std::vector<Frame>& frames = trajectory.frames();
  std::vector<std::uint32_t> steps = courses<std::uint32_t>(
      frames.size(), frames.front().position.size(),
      [&](std::size_t f, std::size_t k) { return static_cast<std::uint32_t>(on_grid(frames[f].position[k], grid)); });
  as_steps(steps, frames.size());
  return deflated(byte_planes(steps, 2));
}

// [node][frame]
std::vector<double> speeds_of(const Trajectory& trajectory) {
  const std::vector<Frame>& frames = trajectory.frames();
  return courses<double>(frames.size(), frames.front().velocity.size() / 2, [&](std::size_t f, std::size_t n) {
    const double x = frames[f].velocity[2 * n], y = frames[f].velocity[2 * n + 1];
    return std::sqrt(x * x + y * y);
  });
}

// All but one in 2000 are slower: a few nodes of the rim would take the colours of all others.
double top_speed(std::vector<double> speeds) {
  const auto place = speeds.begin() + static_cast<std::ptrdiff_t>(0.9995 * static_cast<double>(speeds.size() - 1));
  std::nth_element(speeds.begin(), place, speeds.end());
  return *place;
}

std::string packed_colours(const std::vector<double>& speeds, std::size_t frames, double top, int levels) {
  std::vector<std::uint8_t> steps;
  steps.reserve(speeds.size());
  for (const double speed : speeds) {
    const double share = top > 0 ? std::min(1.0, speed / top) : 0;
    steps.push_back(static_cast<std::uint8_t>(rounded(levels * std::sqrt(share))));
  }
  as_steps(steps, frames);
  return deflated(std::string(steps.begin(), steps.end()));
}

std::string packed_triangles(const FrameMesh& mesh) {
  std::vector<std::uint32_t> steps;
  std::uint32_t before = 0;
  for (const auto& triangle : mesh.triangles)
    for (const int node : triangle) {
      steps.push_back(static_cast<std::uint32_t>(node) - before);
      before = static_cast<std::uint32_t>(node);
    }
  return deflated(byte_planes(steps, 4));
}

}  // namespace

std::string byte_planes(const std::vector<std::uint32_t>& numbers, int size) {
  std::string bytes(numbers.size() * static_cast<std::size_t>(size), '\0');
  auto next = bytes.begin();
  for (int k = 0; k < size; ++k)
    for (const std::uint32_t number : numbers) *next++ = static_cast<char>(number >> (8 * k) & 255);
  return bytes;
}

std::string deflated(const std::string& bytes) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(5), libdeflate_free_compressor);
  if (!compressor) throw Error("libdeflate has no memory");
  std::string small(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  small.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), small.data(), small.size()));
  if (small.empty()) throw Error("libdeflate cannot compress a replay");
  return small;
}

std::optional<std::string> inflated(const std::string& bytes, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> decompressor(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (!decompressor) throw Error("libdeflate has no memory");
  std::string whole(size, '\0');
  std::size_t written = 0;
  const libdeflate_result result =
      libdeflate_zlib_decompress(decompressor.get(), bytes.data(), bytes.size(), whole.data(), whole.size(), &written);
  return result == LIBDEFLATE_SUCCESS && written == size ? std::optional(whole) : std::nullopt;
}

std::string from_base64(const std::string& text) {
  std::string bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    const char* place = std::strchr(letters, c);
    if (!place || c == '\0') break;
    word = word << 6 | static_cast<std::uint32_t>(place - letters);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<char>(word >> bits & 255));
  }
  return bytes;
}

std::string base64(const std::string& bytes) {
  std::string text;
  text.reserve(4 * (bytes.size() + 2) / 3);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text.push_back(i + k <= bytes.size() ? letters[word >> (18 - 6 * k) & 63] : '=');
  }
  return text;
}

PackedReplay packed(const Trajectory& trajectory) {
  PackedReplay replay;
  replay.grid = std::max(replay.grid, reach_of(trajectory) / 32000);
  const std::vector<double> speeds = speeds_of(trajectory);
  replay.top = top_speed(speeds);
  replay.place = packed_places(trajectory, replay.grid);
  replay.colour = packed_colours(speeds, trajectory.frames().size(), replay.top, replay.levels);
  replay.triangles = packed_triangles(trajectory.mesh());
  return replay;
}

}  // namespace ricochet
