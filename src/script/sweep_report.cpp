#include "script/sweep_report.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "impact/estimate.hpp"
#include "impact/outcome.hpp"
#include "script/terminal.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void include(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  std::string text(int digits = 4) const {
    return low == high ? fmt::format("{:.{}g}", low, digits)
                       : fmt::format("{:.{}g} to {:.{}g}", low, digits, high, digits);
  }
};

struct Steps {
  Extent step, theta, most, bound;
};

std::size_t column(const std::string& name) {
  std::size_t i = 0;
  while (Outcome::fields()[i].first.name != name) ++i;
  return i;
}

}  // namespace

Progress::Progress(const Session& session, std::string name, std::size_t total, std::size_t before)
    : name_(std::move(name)),
      total_(total),
      before_(before),
      done_(before),
      quiet_(session.options.quiet),
      terminal_(isatty(STDERR_FILENO)) {}

void Progress::add(std::size_t count, std::size_t failed) {
  done_ += count;
  failed_ += failed;
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  const double rate = static_cast<double>(done_ - before_) / std::max(seconds, 1e-9);
  const std::string line = fmt::format("{}: {}/{}  {:.2f}/s  {:.0f} s left  {} failed", name_, done_, total_, rate,
                                       static_cast<double>(total_ - done_) / rate, failed_);
  if (quiet_) return;
  if (terminal_) {
    say(fmt::format("\r\033[K{}{}", line, done_ == total_ ? "\n" : ""));
  } else if (done_ * 10 / total_ > tenth_) {
    tenth_ = done_ * 10 / total_;
    say(line + "\n");
  }
}

namespace {

// What an estimate doubts that no column of the rows and no number of the line tells, by its kind.
void collect_doubts(const Estimate& e, std::map<std::string, std::string>& doubts) {
  for (const Doubt& doubt : e.doubts)
    if (doubt.kind == "few_modes" || doubt.kind == "fast_modes" || doubt.kind == "corner" || doubt.kind == "supersonic")
      doubts.emplace(doubt.kind, doubt.reason);
}

std::string listed(const std::map<std::string, std::string>& doubts) {
  std::string text;
  for (const auto& [kind, reason] : doubts) text += fmt::format("  {}: {}\n", kind, reason);
  return text;
}

}  // namespace

std::string scale_text(const std::vector<Scene>& scenes) {
  Extent speed, depth, length;
  std::map<std::string, std::string> doubts;
  std::size_t unknown = 0;
  bool elements = false;
  const std::size_t every = scenes.size() / 200 + 1;  // enough to tell the extent of a sweep
  for (std::size_t i = 0; i < scenes.size(); i += every) {
    const Estimate e = estimate(scenes[i]);
    collect_doubts(e, doubts);
    if (!e.no_law.empty()) {
      ++unknown;
      continue;
    }
    for (const Body* body : scenes[i].bodies()) elements = elements || body->numbers.of_elements();
    const Box box = bounding_box(scenes[i].projectile->outline);
    speed.include(e.normal_speed / e.slowest_wave);
    depth.include(2 * e.impact.approach / (box.high - box.low).maxCoeff());
    length.include(2 * e.impact.half_width / e.spacing);
  }
  if (!(speed.low <= speed.high)) return listed(doubts);
  constexpr double least_length = 4;  // of the contact, in node spacings: ricochet.estimate asks for as many
  const std::string advice = fmt::format("; below 4 e follows the {}: ricochet.estimate says how fine it takes",
                                         elements ? "mesh" : "lattice");
  return fmt::format("  estimated: v/c_P {}, indentation {} R, contact {} node spacings long{}{}\n", speed.text(3),
                     depth.text(2), length.text(2), unknown > 0 ? " (where a law holds)" : "",
                     length.low < least_length ? advice : "") +
         listed(doubts);
}

std::string passed_over_text(const std::vector<Scene>& scenes) {
  std::map<std::string, int> passed_over;  // of each such body once, though a sweep has it in many scenes
  for (const Scene& scene : scenes)
    for (const Body* body : scene.bodies())
      if (body->passed_over > 0) passed_over[body->geometry_text()] = body->passed_over;
  int lattices = 0;
  for (const auto& [text, count] : passed_over) lattices += count;
  if (lattices == 0) return "";
  return fmt::format("  passed over: {} whose rough rim crosses itself, for {}\n",
                     lattices == 1 ? "one lattice" : fmt::format("{} lattices", lattices),
                     passed_over.size() == 1 ? "one body" : fmt::format("{} bodies", passed_over.size()));
}

std::string doubts_text(const std::vector<Row>& rows) {
  struct Told {
    const char* column;
    double above;
    const char* meaning;
  };
  static constexpr Told doubts[] = {
      {"over_yield", 0,
       "the estimated pressure passes what starts to yield; nothing yields here, so their e is too high"},
      {"folded", 0, "springs folded, which takes energy that no solid would; see ricochet.estimate"},
      {"penetration", 0.01,
       "a node stood deeper than 0.01 R inside the other body; raise contact.V0, or give "
       "contact.sides = \"two\""}};
  std::string text;
  for (const Told& doubt : doubts) {
    const std::size_t place = column(doubt.column);
    const auto count =
        std::count_if(rows.begin(), rows.end(), [&](const Row& row) { return row.outcomes[place] > doubt.above; });
    if (count > 0)
      text += fmt::format("  {}: in {} of {} impacts {}\n", doubt.column, count, rows.size(), doubt.meaning);
  }
  return text;
}

void warn_of_doubts(Session& session, const std::vector<Row>& rows) {
  std::istringstream lines(doubts_text(rows));
  for (std::string line; std::getline(lines, line);) session.warn(line.substr(line.find_first_not_of(' ')));
}

RunProgress::RunProgress(bool quiet, bool terminal, double time_limit, const Units& units)
    : quiet_(quiet), terminal_(terminal), time_limit_(time_limit), next_(terminal ? 1 : 10), units_(units) {}

RunProgress::~RunProgress() {
  if (told_ && terminal_) say("\r\033[K");
}

std::string RunProgress::line(double time, double seconds) {
  if (quiet_ || seconds < next_) return "";
  next_ = terminal_ ? seconds + 1 : 2 * next_;
  return fmt::format("scene: t = {} of {} at most, {:.0f} s", units_.shown(time, "R/c", 4),
                     units_.shown(time_limit_, "R/c", 4), seconds);
}

void RunProgress::tell(double time) {
  const std::string text = line(time, std::chrono::duration<double>(Clock::now() - start_).count());
  if (text.empty()) return;
  say(terminal_ ? "\r\033[K" + text : text + "\n");
  told_ = true;
}

std::string steps_text(const std::vector<Scene>& scenes, const std::vector<Row>& rows) {
  const std::size_t step = column("step"), theta = column("theta"), most = column("theta_most");
  const Units units = scenes.empty() ? Units{} : scenes.front().units;
  std::map<std::string, Steps> methods;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<double>& values = rows[i].outcomes;
    if (std::isnan(values[step])) continue;  // passed by
    Steps& of = methods[scenes[i].method().name];
    of.step.include(values[step]);
    of.theta.include(values[theta]);
    of.most.include(values[most]);
    of.bound.include(values[theta] / values[step]);
  }
  std::string text;
  for (const auto& [name, s] : methods)
    text +=
        fmt::format("  {}, time step {} {}, theta {} and at most {:.3g} (stable below {:.4g}); frequency bound {} {}\n",
                    name, s.step.text(), units.name("R/c"), s.theta.text(), s.most.high,
                    method_named(name).stability_limit, s.bound.text(), units.name("c/R"));
  return text + scale_text(scenes) + passed_over_text(scenes) + doubts_text(rows);
}

void warn_of_limit(Session& session, const std::vector<Scene>& scenes, const std::vector<Row>& rows,
                   const std::function<std::string(std::size_t)>& name) {
  constexpr double near = 0.9, safe = 0.5;  // of the stability limit
  const std::size_t theta_most = column("theta_most"), theta = column("theta");
  std::size_t count = 0, worst = 0;
  double most = near;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].finished() || scenes[i].step_is_chosen()) continue;
    const double share = rows[i].outcomes[theta_most] / scenes[i].method().stability_limit;
    count += share > near;
    if (!(share > most)) continue;
    most = share;
    worst = i;
  }
  if (count == 0) return;
  const double enough = rows[worst].outcomes[theta] * safe / most;
  session.warn(fmt::format(
      "{}: the frequency bound rose until the step was {:.0f} % of the longest stable one, where errors of several per "
      "cent may pass unseen{}; give theta = {:.2g} or less, or accuracy = 1e-3, which tells the error",
      name(worst), 100 * most, count > 1 ? fmt::format(" ({} impacts came that near)", count) : "", enough));
}

}  // namespace ricochet
