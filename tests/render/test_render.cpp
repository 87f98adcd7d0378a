#include <catch2/catch.hpp>
#include <cstdio>
#include <png.h>

#include "core/error.hpp"
#include "render/colour_map.hpp"
#include "render/picture.hpp"
#include "render/png.hpp"

using namespace ricochet;
using namespace ricochet::render;

namespace {

std::array<int, 3> pixel(const Image& image, int x, int y) {
  const std::size_t at = (static_cast<std::size_t>(y) * image.width + x) * 3;
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

Image drawn(double value = 1) {
  // A triangle in the lower left half of the square 0 ... 1, with one spring along its top edge.
  const Mesh mesh{{{1, 2}}, {{0, 1, 2}}, {}};
  const Frame frame{{{0.1, 0.1}, {0.9, 0.1}, {0.1, 0.9}}, {value}};
  Context context(200, 200);
  return draw(context, 200, 200, mesh, frame, {{0, 0}, {1, 1}});
}

}  // namespace

TEST_CASE("a picture has its parts where they belong, up is up, without a display") {
  const Image image = drawn();
  CHECK(pixel(image, 10, 10) == std::array<int, 3>{255, 255, 255});    // outside
  CHECK(pixel(image, 150, 50) == std::array<int, 3>{255, 255, 255});   // upper right: beyond the long side
  CHECK(pixel(image, 60, 140) == std::array<int, 3>{237, 237, 240});   // inside the triangle
  const Colour bright = cividis(1);
  for (int c = 0; c < 3; ++c) CHECK(std::abs(pixel(image, 100, 100)[c] - 255 * bright[c]) <= 1);  // on the spring
}

TEST_CASE("the colour of a spring follows its value") {
  const Colour dark = cividis(0);
  for (int c = 0; c < 3; ++c) CHECK(std::abs(pixel(drawn(0), 100, 100)[c] - 255 * dark[c]) <= 40);  // thin: smoothed at its edge
  CHECK(pixel(drawn(0), 100, 100)[0] < 60);
}

TEST_CASE("brightness of the colour map rises all the way") {
  double last = -1;
  for (double v = 0; v <= 1; v += 0.01) {
    const Colour c = cividis(v);
    const double luminance = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    CHECK(luminance > last);
    last = luminance;
  }
}

TEST_CASE("the same picture gives the same PNG bytes, which hold the picture and its texts") {
  const Image image = drawn();
  const std::string bytes = png(image, {{"ricochet.time", "1.5 R/c"}});
  CHECK(bytes == png(drawn(), {{"ricochet.time", "1.5 R/c"}}));
  CHECK(bytes.find("1.5 R/c") != std::string::npos);
  png_image reader{};
  reader.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&reader, bytes.data(), bytes.size()));
  reader.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> back(PNG_IMAGE_SIZE(reader));
  REQUIRE(png_image_finish_read(&reader, nullptr, back.data(), 0, nullptr));
  CHECK(back == image.rgb);
}

TEST_CASE("impossible sizes are refused") {
  CHECK_THROWS_AS(Context(0, 100), FieldError);
  CHECK_THROWS_AS(Context(100, 100000), FieldError);
}
