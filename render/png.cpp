#include "render/png.hpp"

#include <png.h>

#include "core/error.hpp"

namespace ricochet::render {
namespace {

void append(png_structp writer, png_bytep bytes, png_size_t count) {
  static_cast<std::string*>(png_get_io_ptr(writer))->append(reinterpret_cast<const char*>(bytes), count);
}

// libpng wants its error function not to return; an exception passes through its C frames, which hold nothing to release.
[[noreturn]] void fail(png_structp, png_const_charp message) { throw Error(std::string("libpng: ") + message); }
void ignore(png_structp, png_const_charp) {}

}  // namespace

std::string png(const Image& image, const std::map<std::string, std::string>& texts) {
  std::string bytes;
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
  png_infop info = png_create_info_struct(writer);
  try {
    png_set_write_fn(writer, &bytes, append, nullptr);
    png_set_IHDR(writer, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(writer, 3);
    std::vector<png_text> chunks;
    for (const auto& [key, text] : texts) {
      png_text chunk{};
      chunk.compression = PNG_TEXT_COMPRESSION_NONE;
      chunk.key = const_cast<char*>(key.c_str());
      chunk.text = const_cast<char*>(text.c_str());
      chunk.text_length = text.size();
      chunks.push_back(chunk);
    }
    png_set_text(writer, info, chunks.data(), static_cast<int>(chunks.size()));
    png_write_info(writer, info);
    for (int y = 0; y < image.height; ++y) png_write_row(writer, image.rgb.data() + static_cast<std::size_t>(y) * image.width * 3);
    png_write_end(writer, info);
  } catch (...) {
    png_destroy_write_struct(&writer, &info);
    throw;
  }
  png_destroy_write_struct(&writer, &info);
  return bytes;
}

}  // namespace ricochet::render
