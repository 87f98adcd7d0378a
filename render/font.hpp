#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ricochet::render {

/// The font of $RICOCHET_FONT, or DejaVu Sans, from Debian's fonts-dejavu-core; what it lacks is taken from a font of
/// Chinese, Japanese and Korean if one of Debian's is there. Throws FileError naming the package if there is no font.
/// Glyphs are drawn once (FreeType) and kept in an atlas, a square of coverages from 0 to 255.
class Font {
 public:
  explicit Font(const char* path = nullptr);
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  /// A glyph's place in the atlas, where it lies from the pen (right and up), and how far the pen goes on. [pixels]
  struct Glyph {
    int x = 0, y = 0, width = 0, height = 0, left = 0, top = 0;
    double advance = 0;
  };

  /// The glyph of a character of `size` pixels an em. What the font lacks is its box for missing ones.
  const Glyph& glyph(char32_t character, int size);

  /// The text with a box (U+25A1) for every character that no font has; broken UTF-8 becomes U+FFFD.
  std::string drawable(const std::string& utf8);

  /// The characters that were asked for and that no font has: "U+65E5, U+672C".
  std::string missing() const;

  static constexpr int side = 2048;  ///< of the atlas
  const std::vector<std::uint8_t>& atlas() const { return atlas_; }
  int version() const { return version_; }  ///< changes with the atlas

 private:
  struct Face;
  std::unique_ptr<Face> face_;
  std::set<char32_t> missing_;
  std::map<std::pair<int, char32_t>, Glyph> glyphs_;
  std::vector<std::uint8_t> atlas_;
  int pen_x_ = 0, pen_y_ = 0, row_height_ = 0, version_ = 0;
};

/// DejaVu Sans, whatever $RICOCHET_FONT says.
extern const char* const usual_font;

/// The characters of UTF-8 text; a broken sequence becomes U+FFFD.
std::u32string characters(const std::string& utf8);

}  // namespace ricochet::render
