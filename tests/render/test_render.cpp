#include <png.h>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <set>

#include "core/error.hpp"
#include "render/picture.hpp"
#include "render/png.hpp"

using namespace ricochet;
using namespace ricochet::render;

namespace {

std::array<int, 3> pixel(const Image& image, int x, int y) {
  const std::size_t at = (static_cast<std::size_t>(y) * image.width + x) * 4;
  return {image.rgba[at], image.rgba[at + 1], image.rgba[at + 2]};
}

bool near(const std::array<int, 3>& a, const std::array<int, 3>& b, int tolerance = 2) {
  return std::abs(a[0] - b[0]) <= tolerance && std::abs(a[1] - b[1]) <= tolerance && std::abs(a[2] - b[2]) <= tolerance;
}

std::array<int, 3> rgb(const Colour& c) { return {c[0], c[1], c[2]}; }

constexpr std::array<int, 3> paper{255, 255, 255};

int dark_pixels(const Image& image, int x0, int y0, int x1, int y1) {
  int count = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) count += pixel(image, x, y)[1] < 128;
  return count;
}

// A wall of two triangles, 4 R wide and 1 R deep below y = 0, held at the bottom, and a projectile of one triangle
// above it.
Vec2 rest(const FrameMesh& mesh, int node) { return seen(mesh, mesh.rest, node); }

FrameMesh small_mesh() {
  FrameMesh mesh;
  mesh.bodies = {{0, 3, {0}, {{{0, 1, 2}}}}, {3, 4, {0}, {{{3, 4, 5, 6}}}}};
  mesh.psi1 = 1.5;
  mesh.rest = {-0.5, 0.2, 0.5, 0.2, 0, 1.2, -2, -1, 2, -1, 2, 0, -2, 0};
  mesh.mass.assign(7, 1.0);
  mesh.anchored = {false, false, false, true, true, false, false};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {3, 5, 6}};
  mesh.springs = {{0, 1}, {1, 2}, {0, 2}, {3, 5}, {5, 6}, {4, 5}, {3, 6}};
  for (const auto& s : mesh.springs) {
    mesh.length.push_back((rest(mesh, s[0]) - rest(mesh, s[1])).norm());
    mesh.stiffness.push_back(100);
  }
  return mesh;
}

Frame frame_of(const FrameMesh& mesh, const Vec2& shift = Vec2::Zero()) {
  Frame frame;
  for (int i = 0; i < mesh.nodes(); ++i) {
    const bool projectile = i < mesh.bodies[0].nodes;
    append(frame.position, rest(mesh, i) + (projectile ? shift : Vec2(0, 0)));
    append(frame.velocity, projectile ? Vec2(0.3, -0.4) : Vec2(0, 0));
    append(frame.contact_force, Vec2(0, 0));
  }
  frame.energy[0] = frame.energy[7] = 1;
  return frame;
}

Show bare(const std::string& material = "plain") {
  Show show;
  show.material = material;
  show.springs = "none";
  show.rims = show.anchors = show.colour_bar = show.clock = false;
  return show;
}

Image drawn(const Show& show, const FrameMesh& mesh, const Frame& frame, int width = 400, int height = 300) {
  Subject subject(mesh);
  subject.see(show, frame);
  Context context(width, height, show.how_smooth());
  Font font;
  const std::vector<Tile> tiles{{&subject, &frame, 0, ""}};
  return context.draw(paint(show, {width * context.scale(), height * context.scale(), 1}, font, tiles,
                            show.clock ? clock_text(tiles) : ""),
                      font);
}

}  // namespace

TEST_CASE("bodies stand where they belong: up is up, right is right, and nothing stands beside them") {
  const FrameMesh mesh = small_mesh();
  const Image image = drawn(bare(), mesh, frame_of(mesh));
  const std::array<int, 3> body{237, 237, 240};
  CHECK(near(pixel(image, 200, 100), body));  // the projectile, in the middle and above
  CHECK(near(pixel(image, 200, 240), body));  // the wall
  CHECK(near(pixel(image, 30, 200), body));   // its left end
  CHECK(near(pixel(image, 60, 60), paper));
  CHECK(near(pixel(image, 200, 154), paper));  // the gap between them
  const Image moved = drawn(bare(), mesh, frame_of(mesh, {1.2, 0}));
  CHECK(near(pixel(moved, 310, 100), body));
  CHECK(near(pixel(moved, 130, 100), paper));
}

TEST_CASE("a value has the colour that the map gives it") {
  const FrameMesh mesh = small_mesh();
  Show show = bare("speed");
  show.high = 1;
  const Image image = drawn(show, mesh, frame_of(mesh));
  CHECK(near(pixel(image, 200, 100), rgb(colour_of(colour_map_named("ylgnbu"), 0.5)), 3));  // |(0.3, -0.4)| of 1
  CHECK(near(pixel(image, 200, 240), rgb(colour_of(colour_map_named("ylgnbu"), 0)), 3));
  show = bare("velocity_y");
  show.high = 0.8;
  CHECK(near(pixel(drawn(show, mesh, frame_of(mesh)), 200, 100), rgb(colour_of(colour_map_named("puor"), 0.25)),
             3));  // -0.4 of -0.8 ... 0.8
  show.colours = "cividis";
  CHECK(near(pixel(drawn(show, mesh, frame_of(mesh)), 200, 100), rgb(colour_of(colour_map_named("cividis"), 0.25)), 3));
}

TEST_CASE("limits hold over the whole sequence, so that a colour means the same in all of its pictures") {
  const FrameMesh mesh = small_mesh();
  const Show show = bare("speed");
  Frame slow = frame_of(mesh), fast = frame_of(mesh);
  for (auto& v : fast.velocity) v *= 2;
  Subject subject(mesh);
  subject.see(show, slow);
  subject.see(show, fast);
  Context context(400, 300);
  Font font;
  const Image image = context.draw(paint(show, {400, 300, 1}, font, {{&subject, &slow, 0, ""}}, ""), font);
  CHECK(near(pixel(image, 200, 100), rgb(colour_of(colour_map_named("ylgnbu"), 0.5)), 3));
}

TEST_CASE("springs are dark lines on the sides of triangles and where one is broken there is a hole") {
  const FrameMesh mesh = small_mesh();
  Show show = bare();
  show.springs = "plain";
  const Frame frame = frame_of(mesh);
  const Image image = drawn(show, mesh, frame, 1600, 1200);
  const auto darkest = [](const Image& of, int x0, int x1, int y0, int y1) {
    int least = 255;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) least = std::min(least, pixel(of, x, y)[0]);
    return least;
  };
  CHECK(darkest(image, 785, 797, 825, 857) < 200);   // the wall's diagonal passes its middle
  CHECK(darkest(image, 200, 300, 860, 880) == 237);  // inside of a triangle
  Frame broken = frame;
  broken.elongation.assign(mesh.springs.size(), 0.0f);
  broken.elongation[3] = std::numeric_limits<float>::quiet_NaN();
  CHECK(darkest(drawn(show, mesh, broken, 1600, 1200), 785, 797, 825, 857) == 255);
}

TEST_CASE("springs alone are coloured by their tension") {
  const FrameMesh mesh = small_mesh();
  Show show = bare("none");
  show.springs = "tension";
  show.high = 10;
  Frame frame = frame_of(mesh);
  frame.elongation.assign(mesh.springs.size(), 0.0f);
  frame.elongation[0] = 0.1f;  // T = 100 * 0.1
  const Image image = drawn(show, mesh, frame, 800, 600);
  const auto wanted = rgb(colour_of(colour_map_named("puor"), 1));
  bool found = false;
  for (int y = 0; y < 600; ++y) found = found || near(pixel(image, 400, y), wanted, 12);
  CHECK(found);
}

TEST_CASE("text is there, dark and legible, and only where it is asked for") {
  const FrameMesh mesh = small_mesh();
  Show show = bare();
  CHECK(dark_pixels(drawn(show, mesh, frame_of(mesh), 640, 360), 0, 0, 200, 16) == 0);
  show.clock = true;
  const Image image = drawn(show, mesh, frame_of(mesh), 640, 360);
  CHECK(dark_pixels(image, 0, 0, 200, 20) > 100);  // "t = 0.00 R/c  Psi_1 = 1.5"
  show.clock = false;
  show.title = "A title";
  CHECK(dark_pixels(drawn(show, mesh, frame_of(mesh), 640, 360), 280, 0, 360, 24) > 60);
}

TEST_CASE("the Greek letter, the subscript and the true minus are glyphs of their own") {
  Font font;
  CHECK(characters("Ψ_1") == std::u32string{0x03a8, U'_', U'1'});
  CHECK(font.glyph(0x03a8, 20).width > 5);
  const int height = font.glyph(U'1', 20).height;
  CHECK(height > 10);
  Canvas canvas(font);
  CHECK(canvas.text_width("Ψ_1", 20) < canvas.text_width("Ψ1", 20));
  CHECK(number_text(-0.5) == "−0.5");
  CHECK_THROWS_WITH(Font("/nonexistent.ttf"), Catch::Matchers::Contains("apt-get install fonts-dejavu-core"));
}

TEST_CASE("the ledger's bar shares its length as the energy is shared") {
  const FrameMesh mesh = small_mesh();
  Show show = bare();
  show.ledger = true;
  Frame frame = frame_of(mesh);  // velocity (0.3, -0.4): 0.64 normal, 0.36 tangential
  const Image image = drawn(show, mesh, frame, 640, 360);
  std::array<int, 2> counts{0, 0};
  int best = 0;
  for (int y = 180; y < 360; ++y) {
    std::array<int, 2> here{0, 0};
    for (int x = 0; x < 640; ++x)
      for (int k : {0, 1}) here[k] += near(pixel(image, x, y), rgb(kind_colour(k)));
    if (here[0] + here[1] > best) {
      best = here[0] + here[1];
      counts = here;
    }
  }
  CHECK(best > 500);
  CHECK_THAT(static_cast<double>(counts[0]) / best, Catch::Matchers::WithinAbs(0.64, 0.01));
}

TEST_CASE("energy that stays fills all of the ledger's bar, whatever a potential owes") {
  const FrameMesh mesh = small_mesh();
  Show show = bare();
  show.ledger = true;
  Frame high = frame_of(mesh), low = frame_of(mesh);
  low.energy[0] = 3;
  low.energy[7] = 1;  // a potential has fallen by 2
  Subject subject(mesh);
  subject.see(show, high);
  subject.see(show, low);
  Context context(640, 360);
  Font font;
  const auto filled = [&](const Frame& frame, std::initializer_list<int> kinds) {
    const Image image = context.draw(paint(show, {640, 360, 1}, font, {{&subject, &frame, 0, ""}}, ""), font);
    int most = 0;
    for (int y = 180; y < 360; ++y) {
      int here = 0;
      for (int x = 0; x < 640; ++x)
        for (const int kind : kinds) here += near(pixel(image, x, y), rgb(kind_colour(kind)));
      most = std::max(most, here);
      for (int x = 630; x < 640; ++x) CHECK(near(pixel(image, x, y), paper));
    }
    return most;
  };
  const int all = filled(low, {0, 1});  // nothing is owed any more
  CHECK(all > 580);
  CHECK(std::abs(filled(high, {0, 1, 6}) - all) <= 2);
  CHECK(std::abs(filled(high, {6}) - 2 * all / 3) <= 4);  // two of three
}

TEST_CASE("a tip beyond the bar of colours says that values lie beyond it") {
  const FrameMesh mesh = small_mesh();
  Show show = bare("speed");
  show.colour_bar = true;
  const auto dark = [&](double limit) {  // pixels of the last colour, which nothing else has
    show.high = limit;
    const Image image = drawn(show, mesh, frame_of(mesh), 640, 360);
    int count = 0;
    for (int y = 0; y < 60; ++y)
      for (int x = 500; x < 640; ++x) count += near(pixel(image, x, y), rgb(colour_of(colour_map_named("ylgnbu"), 1)));
    return count;
  };
  CHECK(dark(0.25) > dark(1) + 20);  // the projectile has 0.5
}

TEST_CASE("arrows of force have a scale, and a camera that follows holds all of the body") {
  const FrameMesh mesh = small_mesh();
  Show show = bare();
  Frame frame = frame_of(mesh);
  frame.contact_force[1] = 3;
  const int without = dark_pixels(drawn(show, mesh, frame, 640, 360), 0, 330, 200, 360);
  show.forces = true;
  CHECK(dark_pixels(drawn(show, mesh, frame, 640, 360), 0, 330, 200, 360) > without + 40);
  show.forces = false;
  show.camera = "follow";
  const Image image = drawn(show, mesh, frame, 640, 100);
  int rows = 0;  // of 100, in which the body shows: it would be 1 R of 0.78 R with the width of 5 R
  for (int y = 0; y < 100; ++y) rows += near(pixel(image, 320, y), {237, 237, 240});
  CHECK(rows > 20);
  CHECK(near(pixel(image, 320, 0), paper));
}

TEST_CASE("a negative and a positive limit have the middle of the colours at 0") {
  const Scale scale{-0.05, 0.2, false};
  CHECK(scale(0) == 0.5);
  CHECK(scale(-0.05) == 0);
  CHECK(scale(0.1) == 0.75);
}

TEST_CASE("the contact is found where the rims are nearest, wherever the bodies are") {
  const FrameMesh mesh = small_mesh();
  const Vec2 place = contact_place(mesh, frame_of(mesh, {-1.4, 0.1}));
  CHECK(place.x() < -1.2);
  CHECK(place.y() > -0.2);
}

TEST_CASE("texts that are too long are made smaller, then cut between characters") {
  Font font;
  Canvas canvas(font);
  canvas.text_within(100, {0, 50}, "ΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨΨ", 20, {0, 0, 0, 255});
  float right = 0;
  for (const ShapeVertex& v : canvas.vertices()) right = std::max(right, v.x);
  CHECK(right < 102);
  CHECK(right > 60);
  CHECK(canvas.text_width("soft_wall", 20) > canvas.text_width("soft wall", 20));  // no subscript in words
}

TEST_CASE("the deformation is magnified, a rigid motion is not") {
  const FrameMesh mesh = small_mesh();
  Show show;
  show.magnify = 10;
  Frame frame = frame_of(mesh, {0.7, 0.1});
  const Points rigid = shown_places(show, mesh, frame);
  for (int i = 0; i < 3; ++i) CHECK((rigid[i] - rest(mesh, i) - Vec2(0.7, 0.1)).norm() < 1e-5);
  frame.position[2 * 5 + 1] -= 0.01f;  // a node of the wall
  CHECK_THAT(shown_places(show, mesh, frame)[5].y(), Catch::Matchers::WithinAbs(-0.1, 1e-5));
}

TEST_CASE("the nearest rigid motion of a body is the one that it made") {
  FrameMesh mesh = small_mesh();
  Frame frame;
  const Eigen::Rotation2Dd turn(0.7);
  for (int i = 0; i < 3; ++i) {
    append(frame.position, turn * rest(mesh, i) + Vec2(1, 2));
    append(frame.velocity, 2.0 * perpendicular(turn * rest(mesh, i)) + Vec2(0, 3));
  }
  const Motion motion = motion_of(mesh, frame, 0);
  CHECK_THAT(motion.angle, Catch::Matchers::WithinAbs(0.7, 1e-6));
  CHECK_THAT(motion.spin, Catch::Matchers::WithinAbs(2, 1e-5));
  for (int i = 0; i < 3; ++i) CHECK((motion.moved(rest(mesh, i)) - (turn * rest(mesh, i) + Vec2(1, 2))).norm() < 1e-6);
}

namespace {

// A triangular lattice of unit springs, for which the stress is known.
FrameMesh triangular(int side) {
  FrameMesh mesh;
  mesh.bodies = {{0, side * side, {0}, {}}};
  const auto node = [&](int i, int j) { return j * side + i; };
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) append(mesh.rest, Vec2(i + 0.5 * j, j * std::sqrt(3.0) / 2));
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      if (i + 1 < side) mesh.springs.push_back({node(i, j), node(i + 1, j)});
      if (j + 1 < side) mesh.springs.push_back({node(i, j), node(i, j + 1)});
      if (i > 0 && j + 1 < side) mesh.springs.push_back({node(i, j), node(i - 1, j + 1)});
      if (i + 1 < side && j + 1 < side) {
        mesh.triangles.push_back({node(i, j), node(i + 1, j), node(i, j + 1)});
        mesh.triangles.push_back({node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
      }
    }
  mesh.mass.assign(mesh.rest.size() / 2, 1.0);
  mesh.anchored.assign(mesh.mass.size(), false);
  mesh.length.assign(mesh.springs.size(), 1.0);
  mesh.stiffness.assign(mesh.springs.size(), 7.0);
  return mesh;
}

}  // namespace

// Uniform stretch eps of a triangular lattice of springs k and length a: tension T = k a eps in each, stress sqrt(3) T
// / a (1 + eps)^-1, energy sqrt(3) k eps^2 a^2 / (a^2) per rest area: three springs of k eps^2 / 2 in an area of
// sqrt(3)/2.
TEST_CASE(
    "pressure, von Mises stress and energy density of a uniformly stretched triangular lattice are the known ones") {
  const FrameMesh mesh = triangular(12);
  const double eps = 0.01;
  Frame frame;
  for (int i = 0; i < mesh.nodes(); ++i) {
    append(frame.position, (1 + eps) * rest(mesh, i));
    append(frame.velocity, Vec2(0, 0));
  }
  const Fields fields(mesh);
  const int inside = 5 * 12 + 5;
  CHECK_THAT(fields.of_material("pressure", frame)[inside],
             Catch::Matchers::WithinRel(-std::sqrt(3.0) * 7 * eps / (1 + eps), 1e-3));
  // A hydrostatic plane stress s has the von Mises stress |s|.
  CHECK_THAT(fields.of_material("von_mises", frame)[inside],
             Catch::Matchers::WithinRel(std::sqrt(3.0) * 7 * eps / (1 + eps), 1e-3));
  CHECK_THAT(fields.of_material("energy_density", frame)[inside],
             Catch::Matchers::WithinRel(3 * 7 * eps * eps / 2 / (std::sqrt(3.0) / 2), 1e-3));
  CHECK_THAT(fields.of_material("stretch", frame)[inside], Catch::Matchers::WithinRel(eps, 1e-3));
  double total = 0;
  for (const double e : fields.of_springs("energy", frame)) total += e;
  CHECK_THAT(total, Catch::Matchers::WithinRel(static_cast<double>(mesh.springs.size()) * 7 * eps * eps / 2, 1e-3));
}

TEST_CASE("brightness of ylgnbu falls and of cividis rises all the way, puor is darkest at both ends") {
  const auto luminance = [](const char* map, double v) {
    const Colour c = colour_of(colour_map_named(map), v);
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  };
  for (int i = 0; i < 50; ++i) {
    const double v = i / 50.0, w = v + 0.02;
    CHECK(luminance("ylgnbu", w) < luminance("ylgnbu", v));
    CHECK(luminance("cividis", w) > luminance("cividis", v));
    if (w <= 0.5) CHECK(luminance("puor", w) > luminance("puor", v));
    if (v >= 0.5) CHECK(luminance("puor", w) < luminance("puor", v));
  }
}

TEST_CASE("smoothing by samples gives the same picture, smoother") {
  const FrameMesh mesh = small_mesh();
  for (const char* smoothing : {"lines", "multisample", "supersample"}) {
    Show show = bare();
    show.smoothing = smoothing;
    const Image image = drawn(show, mesh, frame_of(mesh));
    INFO(smoothing);
    CHECK(image.width == 400);
    CHECK(near(pixel(image, 200, 100), {237, 237, 240}));
    CHECK(near(pixel(image, 60, 60), paper));
    std::set<int> shades;  // along the slanted side of the projectile
    for (int y = 60; y < 140; ++y)
      for (int x = 100; x < 200; ++x) shades.insert(pixel(image, x, y)[0]);
    CHECK((shades.size() > 2) == (std::string(smoothing) != "lines"));
  }
}

TEST_CASE("the same picture gives the same PNG bytes, which hold the picture and its texts") {
  const FrameMesh mesh = small_mesh();
  const Show show;
  const Image image = drawn(show, mesh, frame_of(mesh));
  const Texts texts{{"ricochet.time", "1.5 R/c"}, {"Software", "test"}};
  const std::string bytes = png(image, texts);
  CHECK(bytes == png(drawn(show, mesh, frame_of(mesh)), texts));
  CHECK(png_texts(bytes) == texts);
  CHECK(png_texts(bytes.substr(0, bytes.size() - 1)).empty());
  CHECK(png_texts("no picture").empty());
  png_image reader{};
  reader.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&reader, bytes.data(), bytes.size()));
  reader.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> back(PNG_IMAGE_SIZE(reader));
  REQUIRE(png_image_finish_read(&reader, nullptr, back.data(), 0, nullptr));
  bool same = true;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        same = same && back[(static_cast<std::size_t>(y) * image.width + x) * 3 + c] == pixel(image, x, y)[c];
  CHECK(same);
}

TEST_CASE("fifty contexts opened and closed leave the memory where it was") {
  const auto resident = [] {  // [MB]
    std::ifstream statm("/proc/self/statm");
    long size = 0, pages = 0;
    statm >> size >> pages;
    return static_cast<double>(pages) * 4096 / 1e6;
  };
  const FrameMesh mesh = small_mesh();
  for (int i = 0; i < 5; ++i) drawn({}, mesh, frame_of(mesh));  // what stays once
  const double before = resident();
  for (int i = 0; i < 50; ++i) drawn({}, mesh, frame_of(mesh));
  INFO(before << " MB before, " << resident() << " MB after");
#ifdef __SANITIZE_ADDRESS__
  constexpr double kept = 280;  // the sanitizer holds 256 MB of what was freed, to catch whoever uses it
#else
  constexpr double kept = 15;
#endif
  CHECK(resident() < before + kept);  // one context holds more than 10 MB while it is open: fifty kept would be 500
}

TEST_CASE("impossible sizes and contradictions are refused") {
  CHECK_THROWS_AS(Context(0, 100), FieldError);
  CHECK_THROWS_AS(Context(100, 100000), FieldError);
  const auto refused = [](auto change) {
    Show show;
    change(show);
    try {
      show.check();
    } catch (const FieldError& error) {
      return error.field;
    }
    return std::string("nothing");
  };
  CHECK(refused([](Show& s) { s.springs = "energy"; }) == "springs");
  CHECK(refused([](Show& s) {
          s.low = 2;
          s.high = 1;
        }) == "high");
  CHECK(refused([](Show& s) {
          s.material = "plain";
          s.high = 1;
        }) == "high");
  CHECK(refused([](Show& s) {
          s.material = "pressure";
          s.scale = "sqrt";
        }) == "scale");
  CHECK(refused([](Show& s) { s.width = 2; }) == "width");
  CHECK(refused([](Show&) {}) == "nothing");
}

TEST_CASE("fronts of waves are arcs in the target about the first touch, as far as their speeds have brought them") {
  FrameMesh mesh = small_mesh();
  mesh.bodies[1].wave_speeds = {0.6, 0.3, 1.5};
  mesh.first_touch = 1;
  Frame frame = frame_of(mesh);
  frame.time = 2;
  Show show = bare();
  const Image without = drawn(show, mesh, frame);
  show.fronts = true;
  const Image with = drawn(show, mesh, frame);
  // The bodies touch at (0, 0.1), which is in the middle of the picture; P waves are 0.6 R from there.
  const auto outermost = [](const Image& image, int y) {  // dark pixels of a row
    std::vector<int> dark;
    for (int x = 20; x < 380; ++x)
      if (dark_pixels(image, x, y, x + 1, y + 1) > 0) dark.push_back(x);
    return dark.empty() ? 0 : dark.back() - dark.front();
  };
  const double scale = 386.0 / 4;
  for (const int y : {176, 190}) {
    const double wide = 2 * std::sqrt(std::pow(0.6 * scale, 2) - std::pow(y - 150, 2));
    CHECK_THAT(outermost(with, y), Catch::Matchers::WithinAbs(wide, 5));
    CHECK(outermost(without, y) == 0);
  }
  frame.time = 0.5;  // before the touch
  CHECK(drawn(show, mesh, frame).rgba == without.rgba);
  mesh.bodies[1].wave_speeds[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(drawn(show, mesh, frame), Catch::Matchers::Contains("needs a target whose waves have one speed"));
}

TEST_CASE("the ledger names the effects that hold energy or have taken some") {
  FrameMesh mesh = small_mesh();
  Show show = bare();
  show.ledger = true;
  Frame frame = frame_of(mesh);
  frame.energy[7] = 1.5;
  const Image unnamed = drawn(show, mesh, frame, 640, 360);
  mesh.effects = {"moving_anchor", "damping"};
  CHECK(drawn(show, mesh, frame, 640, 360).rgba != unnamed.rgba);
  mesh.effects = {"effects"};
  CHECK(drawn(show, mesh, frame, 640, 360).rgba == unnamed.rgba);
}

TEST_CASE("of scenes that share a scale each tells how far its target goes on it") {
  const FrameMesh mesh = small_mesh();
  Show show = bare("speed");
  Subject one(mesh), other(mesh);
  Frame frame = frame_of(mesh);
  frame.velocity.back() = 0.1f;  // of a node of the wall
  one.see(show, frame);
  other.see(show, frame);
  CHECK(one.survey.target_most == static_cast<double>(0.1f));
  Context context(800, 300);
  Font font;
  const auto corner = [&](const Subject& second) {  // upper right of the right half
    const Image image =
        context.draw(paint(show, {800, 300, 2}, font, {{&one, &frame, 0, ""}, {&second, &frame, 0, ""}}, ""), font);
    return dark_pixels(image, 660, 0, 800, 16);
  };
  CHECK(corner(other) > 20);
  CHECK(corner(one) == 0);
}
