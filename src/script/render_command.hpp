#pragma once
#include <string>
#include <vector>

namespace ricochet {

/// What `ricochet render` was asked for.
struct RenderOptions {
  std::string file;                   ///< of a trajectory
  std::vector<std::string> settings;  ///< name=value of render::Show
  std::string size = "1280x720", out, film;
  double rate = 30;
  int threads = 0;
  bool resume = false, force = false, quiet = false;
};

/// Draws a stored impact as animate draws one that runs. Throws Error.
void render_file(const RenderOptions& options);

}  // namespace ricochet
