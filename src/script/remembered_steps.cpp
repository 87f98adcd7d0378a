#include "script/remembered_steps.hpp"

#include <fmt/format.h>

#include <sstream>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "script/own_commit.hpp"
#include "script/version.hpp"
#include "store/files.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

constexpr const char* kind_of_file = "steps that trials chose, by ricochet ";
constexpr std::size_t most_choices = 20'000;  // 3.2 MB

std::string heading() { return fmt::format("{}{} (commit {})", kind_of_file, version_number, own_commit()); }

std::string line_of(const std::string& name, const TriedChoice& tried) {
  const Choice& c = tried.choice;
  std::string line = fmt::format("{} {} {:.17g} {:.17g} {:.17g} {:.17g} {} {} {:.17g} {:.17g} {}", name, c.method,
                                 c.step, c.theta, c.longest, c.error, static_cast<int>(c.found), c.trials,
                                 c.evaluations, tried.error_contact, c.left_out.size());
  for (const LeftOut& scene : c.left_out) line += fmt::format(" {} {:.17g}", scene.scene, scene.error);
  return line + "\n";
}

// A number as fmt wrote it, nan and inf too, which streams do not read.
double number(std::istream& in) {
  std::string word;
  in >> word;
  return word.empty() ? 0.0 : std::stod(word);
}

void read_line(const std::string& line, TriedChoices& all) {
  std::istringstream in(line);
  std::string name;
  TriedChoice tried{};
  Choice& c = tried.choice;
  int found = 0;
  std::size_t left_out = 0;
  in >> name >> c.method;
  for (double* value : {&c.step, &c.theta, &c.longest, &c.error}) *value = number(in);
  in >> found >> c.trials;
  c.found = static_cast<Found>(found);
  c.evaluations = number(in);
  tried.error_contact = number(in);
  in >> left_out;
  for (std::size_t i = 0; i < left_out; ++i) {
    LeftOut scene;
    in >> scene.scene;
    scene.error = number(in);
    c.left_out.push_back(scene);
  }
  all.emplace(name, tried);
}

TriedChoices choices_in(const fs::path& file, std::string& warning) {
  TriedChoices all;
  std::error_code error;
  if (!fs::exists(file, error)) return all;
  const std::string text = read_file(file);
  if (!text.starts_with(kind_of_file))
    throw FileError(
        fmt::format("{} is not a file of steps that trials chose; give another with --steps", file.string()));
  const std::size_t end = text.find('\n'), second = end == std::string::npos ? end : text.find('\n', end + 1);
  if (text.substr(0, end) != heading()) return all;  // of another version: trials may choose otherwise now
  if (second == std::string::npos || text.substr(end + 1, second - end - 1) != hash_text(text.substr(second + 1))) {
    warning =
        fmt::format("{} is damaged: what trials chose before is not taken from it; it is written anew", file.string());
    return all;
  }
  std::istringstream lines(text.substr(second + 1));
  for (std::string line; std::getline(lines, line);) read_line(line, all);
  if (all.size() > most_choices) all.clear();  // begins anew rather than grow for ever
  return all;
}

}  // namespace

TriedChoices& RememberedSteps::read(const fs::path& file) {
  if (was_read_) return tried_;
  std::error_code error;
  if (fs::exists(file, error) && !fs::is_regular_file(file, error))
    throw FileError(fmt::format("{} is not a file; give another with --steps", file.string()));
  tried_ = choices_in(file, warning);
  from_file_ = tried_.size();
  was_read_ = true;
  return tried_;
}

void RememberedSteps::write(const fs::path& file) const {
  if (tried_.size() == from_file_) return;
  std::string unused;
  TriedChoices all = tried_;
  all.merge(choices_in(file, unused));  // what another run has written since
  std::string lines;
  for (const auto& [name, tried] : all) lines += line_of(name, tried);
  write_atomically(file, fmt::format("{}\n{}\n{}", heading(), hash_text(lines), lines));
}

}  // namespace ricochet
