#include "render/png.hpp"

#include <libdeflate.h>
#include <png.h>

#include <memory>
#include <string_view>

#include "core/error.hpp"

namespace ricochet::render {
namespace {

void append(png_structp writer, png_bytep bytes, png_size_t count) {
  static_cast<std::string*>(png_get_io_ptr(writer))->append(reinterpret_cast<const char*>(bytes), count);
}

// libpng wants its error function not to return; an exception passes through its C frames, which hold nothing to
// release.
[[noreturn]] void fail(png_structp, png_const_charp message) { throw Error(std::string("libpng: ") + message); }
void ignore(png_structp, png_const_charp) {}

// The rows without filters, compressed by libdeflate at its fastest: as fast as the fastest of libpng's own strategies
// (Z_RLE), files a quarter smaller (tests/bench/frames.cpp).
std::string deflated(const Image& image) {
  std::string rows;
  rows.reserve(static_cast<std::size_t>(image.height) * (1 + 3 * static_cast<std::size_t>(image.width)));
  const std::uint8_t* pixel = image.rgba.data();
  for (int y = 0; y < image.height; ++y) {
    rows.push_back(PNG_FILTER_VALUE_NONE);
    const std::size_t start = rows.size();
    rows.resize(start + 3 * static_cast<std::size_t>(image.width));
    char* to = rows.data() + start;
    for (int x = 0; x < image.width; ++x, pixel += 4, to += 3) {
      to[0] = static_cast<char>(pixel[0]);
      to[1] = static_cast<char>(pixel[1]);
      to[2] = static_cast<char>(pixel[2]);
    }
  }
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(1), libdeflate_free_compressor);
  if (!compressor) throw Error("libdeflate has no memory");
  std::string bytes(libdeflate_zlib_compress_bound(compressor.get(), rows.size()), '\0');
  bytes.resize(libdeflate_zlib_compress(compressor.get(), rows.data(), rows.size(), bytes.data(), bytes.size()));
  if (bytes.empty()) throw Error("libdeflate cannot compress a picture");
  return bytes;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// Walks the chunks: length, type, data, checksum of type and data; the last is IEND.
bool is_whole(const std::string& bytes) {
  constexpr std::size_t signature = 8;
  std::string_view type;
  std::size_t at = signature;
  while (at + 12 <= bytes.size()) {
    const std::size_t length = big_endian(bytes, at);
    if (length > bytes.size() - at - 12) return false;
    if (libdeflate_crc32(0, bytes.data() + at + 4, length + 4) != big_endian(bytes, at + 8 + length)) return false;
    type = std::string_view(bytes).substr(at + 4, 4);
    at += 12 + length;
  }
  return at == bytes.size() && type == "IEND";
}

struct Reading {
  const std::string& bytes;
  std::size_t at = 0;
};

void take(png_structp reader, png_bytep to, png_size_t count) {
  Reading& reading = *static_cast<Reading*>(png_get_io_ptr(reader));
  if (count > reading.bytes.size() - reading.at) png_error(reader, "the file ends too early");
  reading.bytes.copy(reinterpret_cast<char*>(to), count, reading.at);
  reading.at += count;
}

}  // namespace

std::string png(const Image& image, const Texts& texts) {
  std::string bytes;
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
  png_infop info = png_create_info_struct(writer);
  try {
    png_set_write_fn(writer, &bytes, append, nullptr);
    png_set_IHDR(writer, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
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
    const std::string pixels = deflated(image);
    png_write_chunk(writer, reinterpret_cast<png_const_bytep>("IDAT"), reinterpret_cast<png_const_bytep>(pixels.data()),
                    pixels.size());
    png_write_chunk(writer, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
  } catch (...) {
    png_destroy_write_struct(&writer, &info);
    throw;
  }
  png_destroy_write_struct(&writer, &info);
  return bytes;
}

Texts png_texts(const std::string& bytes) {
  if (!is_whole(bytes)) return {};
  Texts texts;
  png_structp reader = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
  png_infop info = png_create_info_struct(reader);
  Reading reading{bytes};
  try {
    png_set_read_fn(reader, &reading, take);
    png_read_info(reader, info);
    png_textp chunks = nullptr;
    int count = 0;
    png_get_text(reader, info, &chunks, &count);
    for (int i = 0; i < count; ++i) texts[chunks[i].key] = chunks[i].text;
  } catch (const Error&) {
    texts.clear();
  }
  png_destroy_read_struct(&reader, &info, nullptr);
  return texts;
}

}  // namespace ricochet::render
