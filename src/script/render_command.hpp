#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

#include "script/filming.hpp"

namespace ricochet {

/// What `ricochet render` was asked for.
struct RenderOptions {
  std::string file;                   ///< of a trajectory
  std::vector<std::string> settings;  ///< name=value of render::Show
  std::string size = fmt::format("{}x{}", Shooting{}.width, Shooting{}.height);
  std::string out, film;
  double rate = Sequence{}.rate;
  int threads = 0;
  bool resume = false, force = false, quiet = false;
};

/// Draws a stored impact as animate draws one that runs. Throws Error.
void render_file(const RenderOptions& options);

}  // namespace ricochet
