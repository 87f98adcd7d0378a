#include "render/film.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.hpp"

extern char** environ;

namespace ricochet::render {

namespace {

// What ffmpeg makes of raw pictures, by the ending of the film's name.
std::vector<std::string> encoding_of(const std::string& ending) {
  // 96 colours are enough for a map of colours and text; without dither nothing flickers, and what rests costs nothing.
  if (ending == ".gif")
    return {
        "-vf",
        "split[a][b];[a]palettegen=max_colors=96:stats_mode=diff[p];[b][p]paletteuse=dither=none:diff_mode=rectangle",
        "-loop",
        "0",
        "-f",
        "gif"};
  if (ending == ".apng") return {"-vf", "format=rgb24", "-c:v", "apng", "-pred", "mixed", "-plays", "0", "-f", "apng"};
  // x264 wants even sizes: an odd picture gets a line of white.
  return {"-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,format=yuv420p",
          "-c:v",      "libx264",
          "-crf",      "18",
          "-movflags", "+faststart",
          "-f",        "mp4"};
}

std::vector<std::string> words_of(const std::filesystem::path& path, const std::filesystem::path& beside, int width,
                                  int height, double rate) {
  std::vector<std::string> words{"ffmpeg",
                                 "-nostdin",
                                 "-loglevel",
                                 "error",
                                 "-y",
                                 "-f",
                                 "rawvideo",
                                 "-pixel_format",
                                 "rgb0",
                                 "-video_size",
                                 fmt::format("{}x{}", width, height),
                                 "-framerate",
                                 fmt::format("{:g}", rate),
                                 "-i",
                                 "pipe:0"};
  for (const std::string& word : encoding_of(path.extension().string())) words.push_back(word);
  words.push_back("file:" + beside.string());
  return words;
}

}  // namespace

Film::Film(const std::filesystem::path& path, int width, int height, double rate)
    : path_(path), beside_(path.string() + ".new") {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw FileError(fmt::format("{} is a folder; give the film another name", path.string()));
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw FileError(std::string("cannot make a pipe to ffmpeg: ") + std::strerror(errno));
  std::vector<std::string> words = words_of(path, beside_, width, height, rate);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // ^C is ours: ffmpeg ends when the pipe does
  const int failed = posix_spawnp(&process_, "ffmpeg", &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(ends[0]);
  pipe_ = ends[1];
  if (failed) {
    close(pipe_);
    throw FileError(failed == ENOENT ? "a film needs ffmpeg, which is not installed; apt-get install ffmpeg"
                                     : std::string("ffmpeg cannot be started: ") + std::strerror(failed));
  }
}

Film::~Film() {
  if (process_ == 0) return;
  kill(process_, SIGKILL);
  close_and_wait();
  std::error_code ignored;
  std::filesystem::remove(beside_, ignored);
}

void Film::add(const Image& image) {
  for (std::size_t at = 0; at < image.rgba.size();) {
    const ssize_t count = write(pipe_, image.rgba.data() + at, image.rgba.size() - at);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      throw FileError(fmt::format(
          "ffmpeg could not write {} (its message stands above); see that its folder is there and can be written",
          path_.string()));
    at += static_cast<std::size_t>(count);
  }
}

int Film::close_and_wait() {
  close(pipe_);
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void Film::finish() {
  std::error_code error;
  if (close_and_wait() != 0) {
    std::filesystem::remove(beside_, error);
    throw FileError(fmt::format("ffmpeg could not write {} (its message stands above)", path_.string()));
  }
  std::filesystem::rename(beside_, path_, error);
  if (error) throw FileError(fmt::format("cannot name {}: {}", path_.string(), error.message()));
}

}  // namespace ricochet::render
