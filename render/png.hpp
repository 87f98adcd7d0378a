#pragma once
#include <map>
#include <string>

#include "render/context.hpp"

namespace ricochet::render {

/// A PNG file's bytes, with text chunks. Equal pictures and texts give equal bytes.
std::string png(const Image& image, const std::map<std::string, std::string>& texts);

}  // namespace ricochet::render
