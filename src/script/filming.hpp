#pragma once
// From impacts to picture files: simulate, draw and encode at the same time.

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "record/series.hpp"
#include "render/picture.hpp"
#include "render/png.hpp"
#include "script/session.hpp"

namespace ricochet {

/// Where the frames of one impact come from: a run, or a file.
struct Source {
  std::shared_ptr<render::Subject> subject;  ///< mesh and title; surveyed when it is filmed
  std::string hash;                          ///< of the scene
  /// Hands over every frame in order, the same ones at each call; ends early when `stop` is set. A run also shows what
  /// happens between them to `between`, if there is one.
  std::function<void(const std::atomic<bool>& stop, const std::function<void(Frame)>& use,
                     const std::function<void(const Sample&)>& between)>
      play;
};

/// How pictures are made.
struct Shooting {
  render::Show show;
  int width = 1280, height = 720;
  std::string origin;  ///< hash of the script that made the scenes
  int threads = 0;     ///< that encode; 0: as many as the machine has
  std::function<void(const std::string&)> warn = [](const std::string&) {};
};

/// A sequence of pictures: NNNNNN.png in `folder` (none if empty) and a film (none if empty).
struct Sequence {
  std::filesystem::path folder, film;
  double rate = 30;    ///< frames a second of the film
  int columns = 0;     ///< of the sources beside each other; 0: up to three in a row, more in a square
  bool go_on = false;  ///< pictures that are there already, whole and of the same scenes, settings and time, are kept
};

/// Draws sources side by side, as many frames as the shortest has, and removes pictures of an earlier, longer sequence.
/// Returns the count. Throws Error with Exit::interrupted if the user stopped it, FileError.
int shoot_sequence(const Shooting& shooting, const std::vector<Source>& sources, const Sequence& sequence);

/// Which frame of which source, and what stands above it.
struct Pick {
  std::size_t source, frame;
  std::string caption;
};

/// One picture of picked frames, `columns` a row, whose colours and scales are those of all frames of the sources.
void shoot_still(const Shooting& shooting, const std::vector<Source>& sources, const std::vector<Pick>& picks,
                 int columns, const std::filesystem::path& path);

/// Everything that fixes how pictures look, as text.
std::string text_of(const Shooting& shooting);

}  // namespace ricochet
