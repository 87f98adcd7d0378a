#include "render/font.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "core/error.hpp"

namespace ricochet::render {

const char* const usual_font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

namespace {

// Of fonts-noto-cjk, fonts-wqy-microhei and fonts-droid-fallback.
constexpr const char* fallbacks[] = {"/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
                                     "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc",
                                     "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf"};

// UTF-8.
std::string encoded(char32_t c) {
  const auto byte = [](char32_t bits) { return static_cast<char>(bits); };
  const auto more = [&](int shift) { return byte(0x80 | (c >> shift & 0x3f)); };
  if (c < 0x80) return {byte(c)};
  if (c < 0x800) return {byte(0xc0 | c >> 6), more(0)};
  if (c < 0x10000) return {byte(0xe0 | c >> 12), more(6), more(0)};
  return {byte(0xf0 | c >> 18), more(12), more(6), more(0)};
}

}  // namespace

struct Font::Face {
  FT_Library library = nullptr;
  std::vector<FT_Face> faces;  // the first one's glyphs go before those of the others
  ~Face() {
    for (const FT_Face face : faces) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }
  bool add(const char* path) {
    FT_Face face = nullptr;
    if (FT_New_Face(library, path, 0, &face)) return false;
    faces.push_back(face);
    return true;
  }
  // The first that has the character; the first of all, with its box, if none has. The others are opened when needed.
  FT_Face of(char32_t character) {
    for (std::size_t i = 0;; ++i) {
      if (i == faces.size() && (i > 1 || std::none_of(std::begin(fallbacks), std::end(fallbacks),
                                                      [this](const char* path) { return add(path); })))
        return nullptr;
      if (FT_Get_Char_Index(faces[i], character) != 0) return faces[i];
    }
  }
};

Font::Font(const char* path) : face_(std::make_unique<Face>()), atlas_(static_cast<std::size_t>(side) * side, 0) {
  if (FT_Init_FreeType(&face_->library)) throw Error("FreeType cannot start");
  const char* const own = std::getenv("RICOCHET_FONT");
  const bool by_user = !path && own && *own;
  const char* const file = path ? path : by_user ? own : usual_font;
  if (face_->add(file)) return;
  if (by_user)
    throw FileError(
        fmt::format("the font {} of RICOCHET_FONT cannot be read; give a TrueType or OpenType file there, or "
                    "unset it",
                    file));
  throw FileError(fmt::format("the font {} is missing; apt-get install fonts-dejavu-core", file));
}

Font::~Font() = default;

const Font::Glyph& Font::glyph(char32_t character, int size) {
  const auto known = glyphs_.find({size, character});
  if (known != glyphs_.end()) return known->second;
  FT_Face face = face_->of(character);
  if (!face) {
    missing_.insert(character);
    face = face_->faces.front();
  }
  FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size));
  if (FT_Load_Char(face, character, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT))
    throw Error(fmt::format("FreeType cannot draw the character U+{:04X}", static_cast<unsigned>(character)));
  const FT_GlyphSlotRec* slot = face->glyph;
  const FT_Bitmap& bitmap = slot->bitmap;
  Glyph glyph;
  glyph.width = static_cast<int>(bitmap.width);
  glyph.height = static_cast<int>(bitmap.rows);
  glyph.left = slot->bitmap_left;
  glyph.top = slot->bitmap_top;
  glyph.advance = static_cast<double>(slot->advance.x) / 64;
  if (pen_x_ + glyph.width + 1 > side) {
    pen_x_ = 0;
    pen_y_ += row_height_ + 1;
    row_height_ = 0;
  }
  if (pen_y_ + glyph.height + 1 > side)
    throw Error("the texts of a picture have more different characters than one picture has room for");
  glyph.x = pen_x_;
  glyph.y = pen_y_;
  for (int y = 0; y < glyph.height; ++y)
    std::copy_n(bitmap.buffer + y * bitmap.pitch, glyph.width,
                atlas_.begin() + static_cast<std::ptrdiff_t>(pen_y_ + y) * side + pen_x_);
  pen_x_ += glyph.width + 1;
  row_height_ = std::max(row_height_, glyph.height);
  ++version_;
  return glyphs_.emplace(std::pair{size, character}, glyph).first->second;
}

std::string Font::drawable(const std::string& utf8) {
  constexpr char32_t box = 0x25a1;
  std::string text;
  for (const char32_t c : characters(utf8)) {
    const bool is_there = c < 0x80 || face_->of(c);
    if (!is_there) missing_.insert(c);
    text += encoded(is_there ? c : box);
  }
  return text;
}

std::string Font::missing() const {
  std::string list;
  for (const char32_t c : missing_)
    list += fmt::format("{}U+{:04X}", list.empty() ? "" : ", ", static_cast<unsigned>(c));
  return list;
}

std::u32string characters(const std::string& utf8) {
  std::u32string text;
  for (std::size_t i = 0; i < utf8.size();) {
    const unsigned char first = static_cast<unsigned char>(utf8[i]);
    const int more = first < 0x80            ? 0
                     : first >> 5 == 0b110   ? 1
                     : first >> 4 == 0b1110  ? 2
                     : first >> 3 == 0b11110 ? 3
                                             : -1;
    char32_t c = more == 0 ? first : more > 0 ? first & (0x3f >> more) : 0xfffd;
    ++i;
    for (int k = 0; k < more; ++k, ++i) {
      if (i >= utf8.size() || (static_cast<unsigned char>(utf8[i]) & 0xc0) != 0x80) {
        c = 0xfffd;
        break;
      }
      c = c << 6 | (static_cast<unsigned char>(utf8[i]) & 0x3f);
    }
    text.push_back(c);
  }
  return text;
}

}  // namespace ricochet::render
