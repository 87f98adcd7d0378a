// What a frame costs, part by part: an impact of 830 + 4170 nodes at 1280x720, material coloured by its energy density,
// springs, rims, text. `frames DIR` writes the mesh there as text for the peers in tests/bench/peers (matplotlib, VTK)
// and prints one line for them.

#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "record/film.hpp"
#include "render/picture.hpp"
#include "render/studio.hpp"
#include "scenes.hpp"
#include "store/files.hpp"

using namespace ricochet;
using Clock = std::chrono::steady_clock;

namespace {

constexpr int width = 1280, height = 720, repeats = 60;

double since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Times {
  double least, median;
};

template <class Work>
Times timed(int count, Work work) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) {
    const auto start = Clock::now();
    work(i);
    all.push_back(since(start));
  }
  std::sort(all.begin(), all.end());
  return {all.front(), all[all.size() / 2]};
}

void print(const std::string& what, const Times& t, const std::string& more = "") {
  fmt::print("{:<64} {:8.2f} {:8.2f}  {}\n", what, t.least, t.median, more);
}

// The file that libpng makes with other settings than ours.
std::string encoded(const render::Image& image, int level, int strategy, int filter) {
  std::string bytes;
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(writer);
  png_set_write_fn(
      writer, &bytes,
      [](png_structp w, png_bytep from, png_size_t count) {
        static_cast<std::string*>(png_get_io_ptr(w))->append(reinterpret_cast<const char*>(from), count);
      },
      nullptr);
  png_set_IHDR(writer, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(writer, level);
  png_set_compression_strategy(writer, strategy);
  png_set_filter(writer, PNG_FILTER_TYPE_BASE, filter);
  png_set_compression_buffer_size(writer, 1 << 16);
  png_write_info(writer, info);
  png_set_filler(writer, 0, PNG_FILLER_AFTER);
  for (int y = 0; y < image.height; ++y)
    png_write_row(writer, image.rgba.data() + static_cast<std::size_t>(y) * image.width * 4);
  png_write_end(writer, info);
  png_destroy_write_struct(&writer, &info);
  return bytes;
}

void write_mesh(const std::filesystem::path& folder, const FrameMesh& mesh, const std::vector<Frame>& frames,
                const std::vector<double>& values) {
  std::ofstream triangles(folder / "triangles.txt"), springs(folder / "springs.txt"), places(folder / "places.txt"),
      colours(folder / "values.txt");
  for (const auto& t : mesh.triangles) triangles << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  for (const auto& s : mesh.springs) springs << s[0] << ' ' << s[1] << '\n';
  for (std::size_t i = 0; i < mesh.mass.size(); ++i) colours << values[i] << '\n';
  for (const Frame& frame : frames)
    for (std::size_t i = 0; i < frame.position.size(); i += 2)
      places << frame.position[i] << ' ' << frame.position[i + 1] << '\n';
}

}  // namespace

int main(int count, char** words) {
  Scene scene = test::paper_scene();
  scene.projectile = test::disk(830, 1e4, 0.03, 1);
  scene.target = test::wall(4170, 100, 0.03, 1, 8, 2);
  scene.launch.psi1 = 1;
  const BuiltSolids solids(scene);
  const std::atomic<bool> stop = false;
  const Course course = follow_course(solids, scene, stop);
  render::Show show;
  render::Subject subject(frame_mesh(scene, solids));
  std::vector<Frame> frames;
  film_scene(solids, scene, frame_times(course, -1, course.outcome.time, repeats, 1), stop, [&](Frame frame) {
    subject.see(show, frame);
    frames.push_back(std::move(frame));
  });
  fmt::print("{} nodes, {} triangles, {} springs, {} x {}; ms a frame: least and median of {}\n", subject.mesh.nodes(),
             subject.mesh.triangles.size(), subject.mesh.springs.size(), width, height, repeats);

  render::Context context(width, height);
  render::Font font;
  const render::Layout layout{width, height};
  render::Painting painting;
  render::Image image;
  std::string bytes;
  const auto tiles = [&](int k) {
    return std::vector<render::Tile>{{&subject, &frames[static_cast<std::size_t>(k)], static_cast<std::size_t>(k), ""}};
  };
  const auto painted = [&](int k) {
    painting = render::paint(show, layout, font, tiles(k), render::clock_text(tiles(k)));
  };
  print("simulate (all of the impact, shared by its frames)",
        timed(3, [&](int) { film_scene(solids, scene, {course.outcome.time}, stop, [](Frame) {}); }),
        fmt::format("/ {} frames", repeats));
  print("paint: fields, vertices, text", timed(repeats, painted));
  print("draw: OSMesa, springs in the triangles' shader, and read",
        timed(repeats,
              [&](int k) {
                painted(k);
                image = context.draw(painting, font);
              }),
        "paint included");
  for (const auto& [name, smoothing] : {std::pair{"multisample", render::Smoothing::multisample},
                                        std::pair{"supersample", render::Smoothing::supersample}}) {
    render::Context other(width, height, smoothing);
    const render::Layout large{width * other.scale(), height * other.scale()};
    print(fmt::format("draw: {}", name),
          timed(repeats / 4, [&](int k) { other.draw(render::paint(show, large, font, tiles(k), ""), font); }),
          "paint included");
  }
  painted(repeats / 2);
  image = context.draw(painting, font);
  const auto print_encoding = [&](const std::string& what, auto encode) {
    const Times times = timed(repeats / 4, [&](int) { bytes = encode(); });
    print("encode: " + what, times, fmt::format("{:.0f} kB", static_cast<double>(bytes.size()) / 1e3));
  };
  print_encoding("libpng as it is used", [&] { return render::png(image, {}); });
  for (const auto& [name, strategy] :
       {std::pair{"Z_DEFAULT_STRATEGY", Z_DEFAULT_STRATEGY}, std::pair{"Z_FILTERED", Z_FILTERED},
        std::pair{"Z_RLE", Z_RLE}, std::pair{"Z_HUFFMAN_ONLY", Z_HUFFMAN_ONLY}})
    for (const auto& [filter_name, filter] :
         {std::pair{"none", PNG_FILTER_NONE}, std::pair{"sub", PNG_FILTER_SUB}, std::pair{"up", PNG_FILTER_UP}})
      print_encoding(fmt::format("level 1, {}, filter {}", name, filter_name),
                     [&, s = strategy, f = filter] { return encoded(image, 1, s, f); });
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "ricochet_bench_frames";
  std::filesystem::create_directories(folder);
  bytes = render::png(image, {});
  print("write: beside, synced, renamed",
        timed(repeats, [&](int k) { write_atomically(folder / fmt::format("{:06}.png", k), bytes); }));

  const int encoders = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const Times whole = timed(5, [&](int) {
    render::Studio studio(
        encoders, [](const std::filesystem::path& path, const std::string& png) { write_atomically(path, png); },
        nullptr);
    for (int k = 0; k < repeats; ++k) {
      painted(k);
      studio.take(context.draw(painting, font), folder / fmt::format("{:06}.png", k), {});
    }
    studio.finish();
  });
  fmt::print("all of it, {} encoders: {:.1f} frames a second at best, {:.1f} in the median\n", encoders,
             1000 * repeats / whole.least, 1000 * repeats / whole.median);
  std::filesystem::remove_all(folder);
  if (count > 1)
    write_mesh(words[1], subject.mesh, {frames.begin(), frames.begin() + 30},
               subject.fields.of_material("energy_density", frames[repeats / 2]));
}
