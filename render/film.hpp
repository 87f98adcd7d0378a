#pragma once
#include <filesystem>

#include "render/context.hpp"

namespace ricochet::render {

/// A film, by its ending of H.264 in yuv420p (.mp4, which every player shows), .gif or animated PNG (.apng), which
/// pages and slides show: raw pictures go to ffmpeg through a pipe. The film takes its name when it is whole.
class Film {
 public:
  /// Throws FileError naming Debian's package if ffmpeg is not installed.
  Film(const std::filesystem::path& path, int width, int height, double rate);
  /// Without finish() ffmpeg is ended and what it wrote removed.
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  /// Throws FileError if ffmpeg has ended early.
  void add(const Image& image);
  void finish();

 private:
  int close_and_wait();

  std::filesystem::path path_, beside_;
  int pipe_ = -1, process_ = 0;
};

}  // namespace ricochet::render
