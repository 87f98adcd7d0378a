#include "script/render_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "core/spelling.hpp"
#include "script/filming.hpp"
#include "script/reader.hpp"
#include "store/files.hpp"
#include "store/trajectory.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

double number_of(const std::string& name, const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw Error(fmt::format("'{}' must be a number, is '{}'", name, text), Exit::usage);
  return value;
}

void set(render::Show& show, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  const std::string name = setting.substr(0, equals),
                    text = equals == std::string::npos ? "" : setting.substr(equals + 1);
  if (equals == std::string::npos)
    throw Error(fmt::format("'{}' is neither an option nor name=value; see ricochet render --help", setting),
                Exit::usage);
  std::vector<std::string> names;
  for (const auto& member : render::Show::fields()) {
    const Field& field = member.field;
    names.push_back(field.name);
    if (field.name != name) continue;
    if (!field.choices.empty() && std::find(field.choices.begin(), field.choices.end(), text) == field.choices.end()) {
      std::string all;
      for (const std::string& choice : field.choices) all += (all.empty() ? "" : ", ") + choice;
      throw Error(fmt::format("'{}' must be one of {}, is '{}'{}", name, all, text, did_you_mean(text, field.choices)),
                  Exit::usage);
    }
    std::visit(
        [&](auto place) {
          using Value = std::remove_reference_t<decltype(show.*place)>;
          if constexpr (std::is_same_v<Value, std::string>)
            show.*place = text;
          else if constexpr (std::is_same_v<Value, bool>) {
            if (text != "true" && text != "false")
              throw Error(fmt::format("'{}' must be true or false, is '{}'", name, text), Exit::usage);
            show.*place = text == "true";
          } else {
            const double value = number_of(name, text);
            if (!field.range.contains(value))
              throw Error(fmt::format("'{}' must be {}, is {}", name, accepted_range(field), text), Exit::usage);
            show.*place = static_cast<Value>(value);
          }
        },
        member.place);
    return;
  }
  throw Error(
      fmt::format("pictures have no '{}'{}; ricochet reference lists them under show", name, did_you_mean(name, names)),
      Exit::usage);
}

}  // namespace

void render_file(const RenderOptions& options) {
  Shooting shooting;
  for (const std::string& setting : options.settings) set(shooting.show, setting);
  const std::size_t by = options.size.find('x');
  if (by == std::string::npos)
    throw Error(fmt::format("--size takes WIDTHxHEIGHT, is '{}'", options.size), Exit::usage);
  const double width = number_of("--size", options.size.substr(0, by)),
               height = number_of("--size", options.size.substr(by + 1));
  if (width != std::floor(width) || height != std::floor(height))
    throw Error(fmt::format("--size counts pixels, which {} does not", options.size), Exit::usage);
  try {
    shooting.show.check();
    render::check_size(std::abs(width) < 1e9 ? static_cast<int>(width) : 0,
                       std::abs(height) < 1e9 ? static_cast<int>(height) : 0);
  } catch (const FieldError& error) {
    throw Error(fmt::format("{}: {}", error.field, error.what()), Exit::usage);
  }
  shooting.width = static_cast<int>(width);
  shooting.height = static_cast<int>(height);
  shooting.threads = options.threads;
  if (!options.film.empty() && !options.film.ends_with(".mp4"))
    throw Error(fmt::format("--film: '{}' must end in .mp4", options.film), Exit::usage);

  const Trajectory trajectory = read_trajectory(options.file);
  Provenance provenance = read_provenance(options.file);
  shooting.origin = provenance["script_hash"];
  Sequence sequence;
  if (options.film.empty() || !options.out.empty())
    sequence.folder =
        options.out.empty() ? fs::path(options.file).replace_extension("").string() + "_frames" : options.out;
  sequence.film = options.film;
  sequence.rate = options.rate;
  sequence.go_on = options.resume;
  std::error_code error;
  if (!options.resume && !options.force)
    for (const fs::path& path : {sequence.folder, sequence.film})
      if (!path.empty() && fs::exists(path, error) && (!fs::is_directory(path, error) || !fs::is_empty(path, error)))
        throw FileError(fmt::format(
            "{} is there already; --force replaces it, --resume goes on with its frames, or give another name",
            path.string()));
  if (!sequence.folder.empty()) make_folder(sequence.folder);
  if (sequence.film.has_parent_path()) make_folder(sequence.film.parent_path());
  const Source source{std::make_shared<render::Subject>(trajectory.mesh()), provenance["scene_hash"],
                      [&](const std::atomic<bool>& stop, const std::function<void(Frame)>& use) {
                        for (const Frame& frame : trajectory.frames())
                          if (!stop) use(frame);
                      }};
  const int count = shoot_sequence(shooting, {source}, sequence);
  if (options.quiet) return;
  if (!sequence.folder.empty()) fmt::print("{} frames in {}\n", count, sequence.folder.string());
  if (!sequence.film.empty()) fmt::print("film: {}\n", sequence.film.string());
}

}  // namespace ricochet
