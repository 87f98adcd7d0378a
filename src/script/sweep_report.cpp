#include "script/sweep_report.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "impact/estimate.hpp"
#include "impact/outcome.hpp"
#include "script/terminal.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

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
  static const std::set<std::string> told{"few_modes", "fast_modes", "corner", "supersonic", "small_half_space"};
  for (const Doubt& doubt : e.doubts)
    if (told.contains(doubt.kind)) doubts.emplace(doubt.kind, doubt.reason);
}

std::string listed(const std::map<std::string, std::string>& doubts) {
  std::string text;
  for (const auto& [kind, reason] : doubts) text += fmt::format("  {}: {}\n", kind, reason);
  return text;
}

constexpr double near_limit = 0.9, safe = 0.5;  // of the stability limit

struct ToldDoubt {
  const char* column;
  double above;
  const char* meaning;
};

// In the order of SweepTold::Ended.
constexpr ToldDoubt told_doubts[] = {
    {"over_yield", 0,
     "the estimated pressure passes what starts to yield, of a body that no effect lets yield: their e is too high; "
     "ricochet.estimate says which"},
    {"folded", 0, "springs folded, which takes energy that no solid would; see ricochet.estimate"},
    {"penetration", 0.01,
     "a node stood deeper inside the other body than a hundredth of the projectile's radius; raise contact.V0, or give "
     "contact.sides = \"two\""}};

SweepTold::Ended ended(const Scene& scene, const Row& row) {
  static const std::size_t step = column("step"), theta = column("theta"), most = column("theta_most"),
                           yield = column("over_yield"), folded = column("folded"), deep = column("penetration");
  const std::vector<double>& v = row.outcomes;
  return {&scene.method(), scene.step_is_chosen(),          row.finished(), v[step], v[theta], v[most], v[yield],
          v[folded],       v[deep] / scene.units.worth("R")};
}

}  // namespace

void SweepTold::Extent::include(double x) {
  low = std::min(low, x);
  high = std::max(high, x);
}

std::string SweepTold::Extent::text(int digits) const {
  return low == high ? fmt::format("{:.{}g}", low, digits)
                     : fmt::format("{:.{}g} to {:.{}g}", low, digits, high, digits);
}

void SweepTold::add_scene(std::size_t place, const Scene& scene) {
  if (!knows_units_) units_ = scene.units;
  knows_units_ = true;
  // Of each such body once, though a sweep has it in many scenes.
  for (const Body* body : scene.bodies())
    if (body->passed_over > 0) passed_over_[body->geometry_text()] = body->passed_over;
  if (place % every_ != 0) return;
  const Estimate e = estimate(scene);
  collect_doubts(e, doubts_);
  if (!e.no_law.empty()) {
    ++unknown_;
    return;
  }
  for (const Body* body : scene.bodies()) elements_ = elements_ || body->numbers.of_elements();
  const Box box = bounding_box(scene.projectile->outline);
  speed_.include(e.normal_speed / e.slowest_wave);
  depth_.include(2 * e.impact.approach / (box.high - box.low).maxCoeff());
  length_.include(2 * e.impact.half_width / e.spacing);
}

void SweepTold::add_row(std::size_t place, const Scene& scene, const Row& row) { add_row(place, ended(scene, row)); }

void SweepTold::add_row(std::size_t place, const Ended& row) {
  ++rows_;
  const double doubts[] = {row.over_yield, row.folded, row.penetration};
  for (std::size_t k = 0; k < std::size(doubts); ++k) doubtful_[k] += doubts[k] > told_doubts[k].above;
  if (!std::isnan(row.step)) {  // else it passed by
    Steps& of = methods_[row.method->name];
    of.step.include(row.step);
    of.theta.include(row.theta);
    of.most.include(row.theta_most);
    of.bound.include(row.theta / row.step);
  }
  if (!row.finished || row.step_is_chosen) return;
  const double share = row.theta_most / row.method->stability_limit;
  near_limit_ += share > near_limit;
  if (!(share > std::max(most_, near_limit))) return;
  most_ = share;
  worst_ = place;
  enough_ = row.theta * safe / share;
}

void SweepTold::warn_of_doubts(Session& session) const {
  std::istringstream lines(doubts_text());
  for (std::string line; std::getline(lines, line);) session.warn(line.substr(line.find_first_not_of(' ')));
}

std::string SweepTold::scale_text() const {
  if (!(speed_.low <= speed_.high)) return listed(doubts_);
  constexpr double least_length = 4;  // of the contact, in node spacings: ricochet.estimate asks for as many
  const std::string advice = fmt::format("; below 4 e follows the {}: ricochet.estimate says how fine it takes",
                                         elements_ ? "mesh" : "lattice");
  return fmt::format("  estimated: v/c_P {}, indentation {} R, contact {} node spacings long{}{}\n", speed_.text(3),
                     depth_.text(2), length_.text(2), unknown_ > 0 ? " (where a law holds)" : "",
                     length_.low < least_length ? advice : "") +
         listed(doubts_);
}

std::string SweepTold::passed_over_text() const {
  int lattices = 0;
  for (const auto& [text, count] : passed_over_) lattices += count;
  if (lattices == 0) return "";
  return fmt::format("  passed over: {} whose rough rim crosses itself, for {}\n",
                     lattices == 1 ? "one lattice" : fmt::format("{} lattices", lattices),
                     passed_over_.size() == 1 ? "one body" : fmt::format("{} bodies", passed_over_.size()));
}

std::string SweepTold::doubts_text() const {
  std::string text;
  for (std::size_t k = 0; k < doubtful_.size(); ++k)
    if (doubtful_[k] > 0)
      text += fmt::format("  {}: in {} of {} impacts {}\n", told_doubts[k].column, doubtful_[k], rows_,
                          told_doubts[k].meaning);
  return text;
}

std::string SweepTold::steps_text() const {
  std::string text;
  for (const auto& [name, s] : methods_)
    text +=
        fmt::format("  {}, time step {} {}, theta {} and at most {:.3g} (stable below {:.4g}); frequency bound {} {}\n",
                    name, s.step.text(), units_.name("R/c"), s.theta.text(), s.most.high,
                    method_named(name).stability_limit, s.bound.text(), units_.name("c/R"));
  return text + of_scenes();
}

void SweepTold::warn_of_limit(Session& session, const std::function<std::string(std::size_t)>& name) const {
  if (near_limit_ == 0) return;
  session.warn(fmt::format(
      "{}: the frequency bound rose until the step was {:.0f} % of the longest stable one, where errors of several per "
      "cent may pass unseen{}; give theta = {:.2g} or less, or accuracy = 1e-3, which tells the error",
      name(worst_), 100 * most_, near_limit_ > 1 ? fmt::format(" ({} impacts came that near)", near_limit_) : "",
      enough_));
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

}  // namespace ricochet
