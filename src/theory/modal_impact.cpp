#include "theory/modal_impact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/exponential.hpp"

namespace ricochet::theory {
namespace {

using std::numbers::pi;

constexpr double touching = 1e-6, parted = 1e-12;  // V in E_0

// Above this speed the rim, cut off at its highest wave, chatters on the wall: half the distance of points, a quarter
// of the step.
constexpr double chatters_above = 0.1;

// sums[i] = start of i + weights[0] table[0][i] + weights[1] table[1][i] + ..., in this order whatever the processor.
void add_rows(const Numbers& weights, const Numbers& table, Numbers& sums) {
  const std::size_t rows = weights.size(), length = sums.size();
  double* sum = sums.data();
  std::size_t row = 0;
  for (; row + 4 <= rows; row += 4) {  // four at a time: a quarter of the loads and stores
    const double *a = &table[row * length], *b = a + length, *c = b + length, *d = c + length;
    const double wa = weights[row], wb = weights[row + 1], wc = weights[row + 2], wd = weights[row + 3];
    for (std::size_t i = 0; i < length; ++i) sum[i] = sum[i] + wa * a[i] + wb * b[i] + wc * c[i] + wd * d[i];
  }
  for (; row < rows; ++row)
    for (std::size_t i = 0; i < length; ++i) sum[i] += weights[row] * table[row * length + i];
}

}  // namespace

// cos(theta) cos(n theta) and sin(theta) sin(n theta) consist of waves n - 1 and n + 1. So y(theta) is a sum of
// cosines, to which Q adds Q (V - U)/2 in wave |n - 1| and -Q (V + U)/2 in wave n + 1; its force is made of the same
// two. [here]
ModalImpact::ModalImpact(const std::vector<DiskMode>& modes, double speed, double alpha, double longer)
    : speed_(speed), alpha_(alpha), height_(1 + std::log(touching / parted) / alpha), rise_(-speed) {
  int n_most = 1;
  double omega_most = 0;
  for (const DiskMode& mode : modes) {
    n_most = std::max(n_most, mode.n);
    omega_most = std::max(omega_most, mode.omega);
  }
  // alpha n_most sqrt(speed)/2 is near the square of the frequency that the wall gives the highest wave [measured].
  const double stiffest = omega_most * omega_most + alpha * n_most * std::max(0.5 * std::sqrt(speed), 0.01);
  step_ = longer * (speed > chatters_above ? 0.05 : 0.2) / std::sqrt(stiffest);
  for (const DiskMode& mode : modes)
    modes_.push_back({mode.omega, 0, 0, std::cos(mode.omega * step_), std::sin(mode.omega * step_),
                      0.5 * (mode.V - mode.U), -0.5 * (mode.V + mode.U), static_cast<std::size_t>(std::abs(mode.n - 1)),
                      static_cast<std::size_t>(mode.n) + 1});
  waves_ = static_cast<std::size_t>(n_most) + 2;
  tabulate(n_most);
  push();
}

// Midpoints from 0 to where nothing reaches the wall; the other half is its mirror image.
void ModalImpact::tabulate(double n_most) {
  const double end = std::min(2.0, 6 * std::sqrt(speed_) + std::sqrt(80 / alpha_));
  const double density = std::max(4 * std::max(n_most, 40.0) / pi, std::sqrt(alpha_));
  points_ = static_cast<std::size_t>(std::ceil(end * density * (speed_ > chatters_above ? 2 : 1)));
  const double apart = end / static_cast<double>(points_);
  by_wave_.resize(waves_ * points_);
  by_point_.resize(waves_ * points_);
  for (std::size_t k = 0; k < points_; ++k)
    for (std::size_t m = 0; m < waves_; ++m)
      by_wave_[m * points_ + k] = by_point_[k * waves_ + m] =
          std::cos(static_cast<double>(m) * (static_cast<double>(k) + 0.5) * apart);
  // int exp(-alpha (1 - cos(theta))) = sqrt(2 pi/alpha); E_0/M = speed^2/2.
  strength_ = 0.5 * speed_ * speed_ * alpha_ * touching * std::sqrt(alpha_ / (2 * pi)) * 2 * apart;
  height_waves_.resize(waves_);
  push_waves_.resize(waves_);
  heights_.resize(points_);
  pushes_.resize(points_);
}

void ModalImpact::push() {
  std::fill(height_waves_.begin(), height_waves_.end(), 0.0);
  height_waves_[0] = height_;
  height_waves_[1] = -1;
  for (const Oscillator& mode : modes_) {
    const double Q = mode.x / mode.omega;
    height_waves_[mode.below] += mode.lower * Q;
    height_waves_[mode.above] += mode.upper * Q;
  }
  std::fill(heights_.begin(), heights_.end(), 0.0);
  add_rows(height_waves_, by_wave_, heights_);
  for (std::size_t k = 0; k < points_; ++k)
    pushes_[k] = strength_ * exponential(std::clamp(-alpha_ * heights_[k], -700.0, 700.0));
  std::fill(push_waves_.begin(), push_waves_.end(), 0.0);
  add_rows(pushes_, by_point_, push_waves_);
}

void ModalImpact::kick(double time) {
  rise_ += time * push_waves_[0];
  for (Oscillator& mode : modes_)
    mode.v += time * (mode.lower * push_waves_[mode.below] + mode.upper * push_waves_[mode.above]);
}

void ModalImpact::drift() {
  height_ += step_ * rise_;
  for (Oscillator& mode : modes_) {
    const double x = mode.x, v = mode.v;
    mode.x = x * mode.cosine + v * mode.sine;
    mode.v = v * mode.cosine - x * mode.sine;
  }
}

void ModalImpact::step() {
  kick(0.5 * step_);
  drift();
  push();
  kick(0.5 * step_);
  ++steps_;
}

// Contact begins and ends where V, an exponential between two steps, passes 1e-6.
void ModalImpact::watch(double before) {
  const double after = wall_energy();
  if ((before > touching) == (after > touching)) return;
  const double time =
      step_ * (static_cast<double>(steps_) - 1 + std::log(touching / before) / std::log(after / before));
  if (!touched_) first_touch_ = time;
  touched_ = true;
  last_touch_ = time;
}

void ModalImpact::run() {
  const double clear = 1 + 0.3 * speed_;
  const auto sound = [&] { return std::abs(rise_) < 2 * speed_; };
  while (sound() && !(wall_energy() < parted && rise_ > 0 && height_ > clear)) {
    const double before = wall_energy();
    step();
    watch(before);
  }
}

void ModalImpact::reverse() {
  rise_ = -rise_;
  for (Oscillator& mode : modes_) mode.v = -mode.v;
}

double ModalImpact::wall_energy() const { return 2 * push_waves_[0] / (alpha_ * speed_ * speed_); }

Numbers ModalImpact::mode_energies() const {
  Numbers energies;
  for (const Oscillator& mode : modes_) energies.push_back((mode.x * mode.x + mode.v * mode.v) / (speed_ * speed_));
  return energies;
}

double ModalImpact::ledger() const {
  double sum = restitution() * restitution() + wall_energy() - 1;
  for (const double energy : mode_energies()) sum += energy;
  return sum;
}

}  // namespace ricochet::theory
