#include "impact/watch/touches.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace ricochet {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_recent = 6;

double logarithm(double load) { return std::log(std::max(load, 1e-300)); }

// When the load passed a level between s[after - 1] and s[after]: the time as a polynomial of the logarithm of the
// load, which is almost linear where a contact begins and ends, by Neville's scheme; along the straight line if the
// samples neither only rise nor only fall.
double passed(std::span<const LoadSample> s, std::size_t after, double level) {
  const LoadSample &a = s[after - 1], &b = s[after];
  const double wanted = logarithm(level), low = logarithm(a.load), high = logarithm(b.load), step = b.time - a.time;
  const double straight = a.time + step * (wanted - low) / (high - low);
  std::vector<double> y, t;
  for (const LoadSample& sample : s) {
    y.push_back(logarithm(sample.load));
    t.push_back(sample.time - a.time);
    if (y.size() > 1 && !((y.back() > y[y.size() - 2]) == (high > low) && y.back() != y[y.size() - 2])) return straight;
  }
  for (std::size_t order = 1; order < y.size(); ++order)
    for (std::size_t i = 0; i + order < y.size(); ++i)
      t[i] = ((wanted - y[i + order]) * t[i] + (y[i] - wanted) * t[i + 1]) / (y[i] - y[i + order]);
  return t[0] >= 0 && t[0] <= step ? a.time + t[0] : straight;
}

// The largest value near the middle of the quartic through five values at -2 ... 2.
double peak_of(const LoadSample* s) {
  const double f0 = s[2].load, near_sum = s[1].load + s[3].load, near_difference = s[3].load - s[1].load,
               far_sum = s[0].load + s[4].load, far_difference = s[4].load - s[0].load;
  const double d1 = near_difference * 2 / 3 - far_difference / 12;
  const double d2 = near_sum * 4 / 3 - far_sum / 12 - f0 * 5 / 2;
  const double d3 = far_difference / 2 - near_difference, d4 = far_sum - 4 * near_sum + 6 * f0;
  double u = 0;
  for (int iteration = 0; iteration < 4; ++iteration)
    u -= (d1 + u * (d2 + u * (d3 / 2 + u * d4 / 6))) / (d2 + u * (d3 + u * d4 / 2));
  if (!(std::abs(u) <= 1)) return f0;
  return f0 + u * (d1 + u * (d2 / 2 + u * (d3 / 6 + u * d4 / 24)));
}

// When a touch began: where the load first exceeded a level.
double began(const std::vector<LoadSample>& rise, double step, double level) {
  const auto above = std::find_if(rise.begin(), rise.end(), [&](const LoadSample& s) { return s.load > level; });
  if (above == rise.begin()) return rise.front().time;
  const auto index = static_cast<std::size_t>(above - rise.begin());
  const auto follows = [&](std::size_t i) { return rise[i].time - rise[i - 1].time < 1.5 * step; };
  std::size_t first = index - 1, last = index;
  while (first > 0 && first + 3 > index && follows(first)) --first;
  while (last + 1 < rise.size() && last < index + 2 && follows(last + 1)) ++last;
  return passed(std::span(rise).subspan(first, last - first + 1), index - first, level);
}

}  // namespace

bool TouchClock::follow(const LoadSample& now) {
  if (!recent_.empty() && now.time - recent_.back().time > 1.5 * step_) recent_.clear();
  if (recent_.size() == most_recent) recent_.erase(recent_.begin());
  recent_.push_back(now);
  pass_floor();
  if (!touching_) {
    if (!(now.load > std::max(floor_, share_ * greatest_))) return false;
    touching_ = true;
    touches_.push_back({now.load, undefined, recent_});
  }
  TouchSpan& touch = touches_.back();
  if (now.load > touch.rise.back().load) {
    const bool gap = recent_.size() > 1 && recent_[recent_.size() - 2].time > touch.rise.back().time;
    if (gap) touch.rise.push_back(recent_[recent_.size() - 2]);
    touch.rise.push_back(now);
  }
  touch.greatest = std::max(touch.greatest, now.load);
  take_peak(touch);
  greatest_ = std::max(greatest_, touch.greatest);
  const double level = share_ * touch.greatest;
  if (now.load >= level) return false;
  touching_ = false;
  touch.end = recent_.size() > 1 ? passed(recent_, recent_.size() - 1, level) : now.time;
  touch.rise = {{began(touch.rise, step_, level), touch.greatest}};
  return true;
}

void TouchClock::pass_floor() {
  const LoadSample& now = recent_.back();
  const bool before = recent_.size() > 1 && recent_[recent_.size() - 2].load > floor_;
  const auto crossing = [&] { return recent_.size() > 1 ? passed(recent_, recent_.size() - 1, floor_) : now.time; };
  if (now.load > floor_ && !before && std::isnan(above_)) above_ = crossing();
  if (now.load > floor_) below_ = undefined;
  if (now.load <= floor_ && !std::isnan(above_) && std::isnan(below_)) below_ = before ? crossing() : now.time;
}

// The greatest load lies between steps: known when two samples after it are.
void TouchClock::take_peak(TouchSpan& touch) const {
  if (recent_.size() < 5) return;
  const LoadSample* s = &recent_[recent_.size() - 5];
  if (s[2].load > s[1].load && s[2].load >= s[3].load) touch.greatest = std::max(touch.greatest, peak_of(s));
}

int TouchClock::count() const {
  return static_cast<int>(std::count_if(touches_.begin(), touches_.end(), [&](const auto& t) { return counts(t); }));
}

double TouchClock::begin() const {
  for (const TouchSpan& touch : touches_)
    if (counts(touch))
      return std::isnan(touch.end) ? began(touch.rise, step_, share_ * touch.greatest) : touch.rise.front().time;
  return undefined;
}

double TouchClock::end() const {
  double last = undefined;
  for (const TouchSpan& touch : touches_)
    if (counts(touch)) last = touch.end;
  return last;
}

}  // namespace ricochet
