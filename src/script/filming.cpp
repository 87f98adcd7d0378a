#include "script/filming.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

#include "core/bounded_queue.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "render/studio.hpp"
#include "script/version.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t frames_ahead = 4;

void stop_if_asked(const char* what, std::size_t done) {
  if (stop_requested)
    throw Error(fmt::format("interrupted: {} {}; --resume goes on from there", done, what), Exit::interrupted);
}

void survey(const Shooting& shooting, const std::vector<Source>& sources) {
  for (const Source& source : sources) {
    source.subject->survey = {};
    std::function<void(const Sample&)> between;
    if (const render::Quantity* plotted = render::plotted_quantity(shooting.show))
      between = [&source, value = Sample::value_named(plotted->name)](const Sample& sample) {
        source.subject->survey.see_between(sample.time, value(sample));
      };
    source.play(
        stop_requested, [&](const Frame& frame) { source.subject->see(shooting.show, frame); }, between);
    stop_if_asked("pictures are drawn", 0);
    if (source.subject->survey.times.empty()) throw Error("there is not one frame to draw");
  }
}

/// Plays a source in a thread of its own, some frames ahead of whoever takes them.
class Player {
 public:
  explicit Player(const Source& source)
      : thread_([this, &source] {
          try {
            const auto use = [&](Frame frame) {
              if (!queue_.push(std::move(frame))) halt_ = true;
            };
            source.play(halt_, use, {});
          } catch (...) {
            error_ = std::current_exception();
          }
          queue_.close();
        }) {}
  ~Player() {
    halt_ = true;
    queue_.close();
  }

  /// The next frame; none once the user asks to stop. Throws what the source has thrown.
  std::optional<Frame> next() {
    using namespace std::chrono_literals;
    std::optional<Frame> frame;
    while (!stop_requested && !(frame = queue_.pop(100ms)) && !queue_.over()) {
    }
    if (stop_requested) return std::nullopt;
    if (!frame && error_) std::rethrow_exception(error_);
    return frame;
  }

 private:
  BoundedQueue<Frame> queue_{frames_ahead};
  std::atomic<bool> halt_ = false;
  std::exception_ptr error_;
  std::jthread thread_;
};

std::string hashes_of(const std::vector<Source>& sources) {
  std::string text;
  for (const Source& source : sources) text += (text.empty() ? "" : " ") + source.hash;
  return text;
}

render::Texts texts_of(const Shooting& shooting, const std::vector<Source>& sources, const std::string& which,
                       double time) {
  std::string titles;
  for (const Source& source : sources) titles += source.subject->title + "\n";
  const std::string scenes = hashes_of(sources);
  return {{"Software", fmt::format("ricochet {} (commit {})", version_number, version_commit)},
          {"ricochet.script", shooting.origin},
          {"ricochet.scene", scenes},
          {"ricochet.time", sources[0].subject->mesh.units.shown(time, "R/c", 6)},
          {"ricochet.picture", hash_text(text_of(shooting) + titles + scenes + which)}};
}

int columns_of(const Sequence& sequence, std::size_t sources) {
  const int count = static_cast<int>(sources);
  return sequence.columns > 0 ? std::min(sequence.columns, count)
         : count <= 3         ? count
                              : static_cast<int>(std::ceil(std::sqrt(count)));
}

bool is_drawn(const fs::path& path, const render::Texts& texts) {
  std::error_code error;
  return fs::exists(path, error) && render::png_texts(read_file(path)) == texts;
}

void warn_of_missing(const Shooting& shooting, const render::Font& font) {
  if (font.missing().empty()) return;
  shooting.warn(
      fmt::format("the font of pictures lacks {} and draws boxes; for Chinese, Japanese and Korean: apt-get "
                  "install fonts-noto-cjk, for others give a font by RICOCHET_FONT",
                  font.missing()));
}

// As many frames as the shortest source has.
std::size_t count_of(const std::vector<Source>& sources) {
  std::size_t count = sources[0].subject->survey.times.size();
  for (const Source& source : sources) count = std::min(count, source.subject->survey.times.size());
  return count;
}

// What tells a sequence from another one of the same scenes.
std::string times_text(const std::vector<Source>& sources) {
  std::string text;
  for (const Source& source : sources) {
    const std::vector<double>& times = source.subject->survey.times;
    text += fmt::format(" of {:.9g} ... {:.9g}", times.front(), times.back());
  }
  return text;
}

int encoders_of(const Shooting& shooting) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return shooting.threads > 0 ? std::min(shooting.threads, cores) : cores;
}

// Frame k of every source.
std::vector<Frame> next_frames(const std::vector<std::unique_ptr<Player>>& players, std::size_t k) {
  std::vector<Frame> frames;
  for (const auto& player : players) {
    auto frame = player->next();
    stop_if_asked("pictures are drawn", k);
    if (!frame) throw Error("a sequence ended before its survey did");  // the same run ends in the same way
    frames.push_back(std::move(*frame));
  }
  return frames;
}

// Where pictures are drawn. Those of an earlier run stay until all of the new ones are there: these wait beside them.
fs::path drawn_into(const Sequence& sequence) {
  if (sequence.folder.empty()) return "";
  const fs::path beside = run_names::unfinished(sequence.folder);
  const bool replaces = !sequence.go_on && fs::exists(run_names::frame(sequence.folder, 0));
  if (!replaces && !fs::exists(beside)) return sequence.folder;
  make_folder(beside);
  return beside;
}

// In place of the earlier ones; those of a longer sequence would pass for the end of this one.
void put_in_place(const fs::path& drawn, const Sequence& sequence, std::size_t count) {
  if (drawn != sequence.folder) {
    make_folder(sequence.folder);
    for (std::size_t k = 0; k < count; ++k)
      fs::rename(run_names::frame(drawn, k), run_names::frame(sequence.folder, k));
    run_names::remove_product(drawn);
  }
  if (sequence.folder.empty()) return;
  for (std::size_t stale = count; fs::remove(run_names::frame(sequence.folder, stale)); ++stale) {
  }
}

}  // namespace

std::string text_of(const Shooting& shooting) {
  std::string text = fmt::format("{} x {}\n", shooting.width, shooting.height);
  for (const auto& member : render::Show::fields())
    std::visit([&](auto place) { text += fmt::format("{} = {}\n", member.field.name, shooting.show.*place); },
               member.place);
  return text;
}

int shoot_sequence(const Shooting& shooting, const std::vector<Source>& sources, const Sequence& sequence) {
  render::Context context(shooting.width, shooting.height, shooting.show.how_smooth());
  render::Font font;
  std::optional<render::Film> film;
  std::string no_film;
  try {
    if (!sequence.film.empty()) film.emplace(sequence.film, shooting.width, shooting.height, sequence.rate);
  } catch (const FileError& error) {
    if (sequence.folder.empty()) throw;
    no_film = error.what();  // the pictures were asked for: they come first
  }
  survey(shooting, sources);
  const std::size_t count = count_of(sources);
  const std::string times = times_text(sources);
  const render::Layout layout{shooting.width * context.scale(), shooting.height * context.scale(),
                              columns_of(sequence, sources.size())};
  render::Studio studio(
      encoders_of(shooting), [](const fs::path& path, const std::string& bytes) { write_atomically(path, bytes); },
      film ? &*film : nullptr);
  const fs::path folder = drawn_into(sequence);
  std::vector<std::unique_ptr<Player>> players;
  for (const Source& source : sources) players.push_back(std::make_unique<Player>(source));
  for (std::size_t k = 0; k < count; ++k) {
    const std::vector<Frame> frames = next_frames(players, k);
    std::vector<render::Tile> tiles;
    for (std::size_t i = 0; i < sources.size(); ++i)
      tiles.push_back({sources[i].subject.get(), &frames[i], k, sources[i].subject->title});
    const render::Texts texts = texts_of(shooting, sources, fmt::format("{} of {}{}", k, count, times), frames[0].time);
    const fs::path file = folder.empty() ? fs::path() : run_names::frame(folder, k);
    const bool drawn = !file.empty() && sequence.go_on && is_drawn(file, texts);
    if (drawn && !film) continue;
    const std::string clock = shooting.show.clock ? render::clock_text(tiles) : "";
    studio.take(context.draw(render::paint(shooting.show, layout, font, tiles, clock), font), drawn ? fs::path() : file,
                texts);
  }
  studio.finish();
  if (film) film->finish();
  put_in_place(folder, sequence, count);
  warn_of_missing(shooting, font);
  if (!no_film.empty())
    throw FileError(fmt::format("{} ({} frames are in {})", no_film, count, sequence.folder.string()));
  return static_cast<int>(count);
}

void shoot_still(const Shooting& shooting, const std::vector<Source>& sources, const std::vector<Pick>& picks,
                 int columns, const fs::path& path) {
  render::Context context(shooting.width, shooting.height, shooting.show.how_smooth());
  render::Font font;
  survey(shooting, sources);
  // Picked frames only are kept.
  std::vector<std::map<std::size_t, Frame>> kept(sources.size());
  for (const Pick& pick : picks) kept[pick.source][pick.frame] = {};
  for (std::size_t i = 0; i < sources.size(); ++i) {
    std::size_t k = 0;
    const auto use = [&](Frame frame) {
      if (const auto wanted = kept[i].find(k++); wanted != kept[i].end()) wanted->second = std::move(frame);
    };
    sources[i].play(stop_requested, use, {});
    stop_if_asked("pictures are drawn", 0);
  }
  std::vector<render::Tile> tiles;
  std::string which;
  for (const Pick& pick : picks) {
    const Frame& frame = kept[pick.source].at(pick.frame);
    if (frame.position.empty())
      throw Error(fmt::format("the impact of scene {} ended before the moment that was to be shown", pick.source + 1),
                  Exit::numerical);
    tiles.push_back({sources[pick.source].subject.get(), &frame, pick.frame, pick.caption});
    which += fmt::format("{} {} {}\n", pick.source, frame.time, pick.caption);
  }
  std::string clock = render::clock_text(tiles);
  if (tiles.size() > 1) {  // each has its own time above it
    const std::size_t psi1 = clock.find("Ψ");
    clock = psi1 == std::string::npos ? "" : clock.substr(psi1);
  }
  const render::Layout layout{shooting.width * context.scale(), shooting.height * context.scale(), columns};
  const render::Image image =
      context.draw(render::paint(shooting.show, layout, font, tiles, shooting.show.clock ? clock : ""), font);
  write_atomically(path, render::png(image, texts_of(shooting, sources, which, tiles[0].frame->time)));
  warn_of_missing(shooting, font);
}

}  // namespace ricochet
