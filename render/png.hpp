#pragma once
#include <map>
#include <string>

#include "render/context.hpp"

namespace ricochet::render {

using Texts = std::map<std::string, std::string>;

/// A PNG file's bytes, with text chunks. Equal pictures and texts give equal bytes.
std::string png(const Image& image, const Texts& texts);

/// The text chunks of a PNG file of ours; none if it is no whole PNG file with the right checksums.
Texts png_texts(const std::string& bytes);

}  // namespace ricochet::render
