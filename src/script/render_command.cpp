#include "script/render_command.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "core/spelling.hpp"
#include "record/whole_section.hpp"
#include "script/report.hpp"
#include "script/terminal.hpp"
#include "script/value_types.hpp"
#include "store/files.hpp"
#include "store/h5md.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(message, Exit::usage); }

double number_of(const std::string& name, const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    refuse(fmt::format("'{}' must be a number, is '{}'", name, text));
  return value;
}

void assign(std::string& value, const Field& field, const std::string& text) {
  const std::vector<std::string>& choices = field.choices;
  if (!choices.empty() && std::find(choices.begin(), choices.end(), text) == choices.end())
    refuse(fmt::format("'{}' must be one of {}, is '{}'{}", field.name, joined(choices), text,
                       did_you_mean(text, choices)));
  value = text;
}

void assign(bool& value, const Field& field, const std::string& text) {
  if (text != "true" && text != "false") refuse(fmt::format("'{}' must be true or false, is '{}'", field.name, text));
  value = text == "true";
}

template <class Number>
void assign(Number& value, const Field& field, const std::string& text) {
  const double number = number_of(field.name, text);
  if (!field.range.contains(number))
    refuse(fmt::format("'{}' must be {}, is {}", field.name, accepted_range(field), text));
  value = static_cast<Number>(number);
}

// Takes a setting "name=value".
void set(render::Show& show, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos)
    refuse(fmt::format("'{}' is neither an option nor name=value; see ricochet render --help", setting));
  const std::string name = setting.substr(0, equals), text = setting.substr(equals + 1);
  std::vector<std::string> names;
  for (const auto& member : render::Show::fields()) {
    names.push_back(member.field.name);
    if (member.field.name != name) continue;
    std::visit([&](auto place) { assign(show.*place, member.field, text); }, member.place);
    return;
  }
  refuse(fmt::format("pictures have no '{}'{}; ricochet reference lists them under show", name,
                     did_you_mean(name, names)));
}

void read_size(const std::string& size, Shooting& shooting) {
  const std::size_t by = size.find('x');
  if (by == std::string::npos) refuse(fmt::format("--size takes WIDTHxHEIGHT, is '{}'", size));
  const double width = number_of("--size", size.substr(0, by)), height = number_of("--size", size.substr(by + 1));
  if (width != std::floor(width) || height != std::floor(height))
    refuse(fmt::format("--size counts pixels, which {} does not", size));
  shooting.width = std::abs(width) < 1e9 ? static_cast<int>(width) : 0;
  shooting.height = std::abs(height) < 1e9 ? static_cast<int>(height) : 0;
}

Shooting shooting_of(const RenderOptions& options) {
  Shooting shooting;
  for (const std::string& setting : options.settings) set(shooting.show, setting);
  read_size(options.size, shooting);
  try {
    shooting.show.check();
    render::check_size(shooting.width, shooting.height);
  } catch (const FieldError& error) {
    refuse(fmt::format("{}: {}", error.field, error.what()));
  }
  shooting.threads = options.threads;
  shooting.warn = [](const std::string& text) { say("warning: " + text + "\n"); };
  return shooting;
}

Sequence sequence_of(const RenderOptions& options) {
  Sequence sequence;
  if (options.film.empty() || !options.out.empty())
    sequence.folder =
        options.out.empty() ? fs::path(options.file).replace_extension("").string() + "_frames" : options.out;
  sequence.film = options.film;
  sequence.rate = options.rate;
  sequence.go_on = options.resume;
  return sequence;
}

void refuse_what_is_there(const fs::path& path) {
  std::error_code error;
  if (path.empty() || !fs::exists(path, error)) return;
  if (fs::is_directory(path, error) && fs::is_empty(path, error)) return;
  throw FileError(
      fmt::format("{} is there already; --force replaces it, --resume goes on with its frames, or give another name",
                  path.string()));
}

}  // namespace

void render_file(const RenderOptions& options) {
  if (options.resume && options.force)
    refuse("--resume keeps earlier frames and --force replaces them; give one of them");
  Shooting shooting = shooting_of(options);
  if (!options.film.empty() && !run_names::is_film(options.film))
    refuse(fmt::format("--film: '{}' must end in {}, {} or {}", options.film, run_names::film, run_names::film_gif,
                       run_names::film_png));
  const Trajectory trajectory = read_trajectory(options.file);
  Provenance provenance = read_provenance(options.file);
  shooting.origin = provenance["script_hash"];
  const Sequence sequence = sequence_of(options);
  if (!options.resume && !options.force)
    for (const fs::path& path : {sequence.folder, sequence.film}) refuse_what_is_there(path);
  if (!sequence.folder.empty()) make_folder(sequence.folder);
  if (sequence.film.has_parent_path()) make_folder(sequence.film.parent_path());
  const Source source{std::make_shared<render::Subject>(whole_section(trajectory.mesh())), provenance["scene_hash"],
                      [&](const std::atomic<bool>& stop, const std::function<void(Frame)>& use,
                          const std::function<void(const Sample&)>&) {
                        for (const Frame& frame : trajectory.frames())
                          if (!stop) use(whole_section(trajectory.mesh(), frame));
                      }};
  const int count = shoot_sequence(shooting, {source}, sequence);
  if (options.quiet) return;
  if (!sequence.folder.empty()) putf("{} frames in {}\n", count, sequence.folder.string());
  if (!sequence.film.empty()) putf("film: {}\n", sequence.film.string());
}

}  // namespace ricochet
