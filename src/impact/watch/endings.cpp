#include "impact/watch/endings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ricochet {
namespace {

std::string described(const BodyNode& node) {
  return fmt::format("node {} of the {}", node.node, body_name(static_cast<std::size_t>(node.body)));
}

std::string text(const ending::Finished& e, const Run& run) {
  if (!e.touching) return "";
  return fmt::format(
      "at ending.time = {:g} R/c the bodies still touch: what their parting defines, e and mu among it, is undefined",
      run.end_time);
}

std::string text(const ending::PassedBy&, const Run&) { return "the projectile passes by the target"; }

std::string text(const ending::NotTouched&, const Run& run) {
  return fmt::format("the bodies had not touched at ending.time = {:g} R/c; give a later one", run.end_time);
}

std::string text(const ending::BrokenNode& e, const Run& run) {
  if (run.steps == 0)
    return fmt::format(
        "{} was no longer finite at t = 0, in the first step: forces beyond every number; lower contact.V0, the "
        "bodies' stiffness or quartic, or the speed",
        described(e.node));
  if (e.flows)
    return fmt::format(
        "{} was no longer finite at t = {:.6g} R/c: the forces had outgrown the time step {:.3g} R/c, as flow flattens "
        "elements, and they vibrate the faster for it; give a step of {:.3g} R/c",
        described(e.node), run.time(), run.start.step, run.start.step / 8);
  return fmt::format(
      "{} was no longer finite at t = {:.6g} R/c: the forces had outgrown the time step {:.3g} R/c; give a step half "
      "as long or a lower speed",
      described(e.node), run.time(), run.start.step);
}

std::string text(const ending::EnergyBeyondNumbers&, const Run& run) {
  return fmt::format("the energy was beyond every number at t = {:.6g} R/c; give a lower speed", run.time());
}

std::string text(const ending::EnergyDrift& e, const Run& run) {
  const double advised = std::clamp(e.shorter, 0.125, 0.5) * run.start.step;
  if (advised < run.start.least_step)
    return fmt::format(
        "the total energy had strayed by {:.3g} at t = {:.6g} R/c with the time step {:.3g} R/c, and shorter steps are "
        "lost in rounding: give a higher speed, or a larger energy_tolerance",
        run.drift, run.time(), run.start.step);
  return fmt::format(
      "the total energy had strayed by {:.3g} at t = {:.6g} R/c with the time step {:.3g} R/c; give a step of {:.2g} "
      "R/c or less",
      run.drift, run.time(), run.start.step, advised);
}

std::string text(const ending::Unstable& e, const Run& run) {
  const Method& method = run.scene->method();
  return fmt::format(
      "at t = {:.6g} R/c the frequency bound had risen to {:.4g} c/R at {}, where {} is unstable with the time step "
      "{:.3g} R/c; give a step of {:.3g} R/c",
      run.time(), e.omega, described(e.node), method.name, run.start.step, method.usual / e.expected);
}

std::string text(const ending::TurnedOver& e, const Run& run) {
  return fmt::format(
      "at t = {:.6g} R/c elements that yield, {:.2g} of the {}'s area, had turned over, and their law ends before "
      "that: flow flattens them without end; lower the speed, or raise yield or hardening",
      run.time(), e.share, body_name(static_cast<std::size_t>(e.body)));
}

std::string text(const ending::Tunnelled& e, const Run& run) {
  const char* remedy = e.unpushed
                           ? ": the one-sided contact pushes projectile nodes only; set contact = { sides = \"two\" }"
                           : "; raise contact.V0, lower the speed, or take a smaller step";
  return fmt::format("at t = {:.6g} R/c {} was {}inside the {}{}", run.time(), described(e.node),
                     e.unpushed ? fmt::format("{:.2g} R ", e.depth) : "", body_name(static_cast<std::size_t>(e.other)),
                     remedy);
}

std::string text(const ending::FlewThrough& e, const Run& run) {
  return fmt::format(
      "the projectile flew through the target and no repulsion was seen: it came within {:.2g} R of it; {}", e.least,
      e.touch > 0 ? fmt::format("give a step below {:.2g} R/c", run.start.step / 4)
                  : "raise contact.V0 or lower the speed");
}

std::string text(const ending::NotParted& e, const Run& run) {
  return fmt::format("the bodies had not parted after {:.6g} R/c; {}", run.time(),
                     e.rests
                         ? "they move as one and may never part: leave out, or lower, what holds or slows them"
                         : "raise time_limit, or end at the first parting with ending = { at = \"first_parting\" }");
}

Status status(const ending::Finished&) { return Status::finished; }
Status status(const ending::PassedBy&) { return Status::no_contact; }
Status status(const ending::NotTouched&) { return Status::no_contact; }
Status status(const ending::BrokenNode& e) { return e.flows ? Status::unstable : Status::not_finite; }
Status status(const ending::EnergyBeyondNumbers&) { return Status::not_finite; }
Status status(const ending::EnergyDrift&) { return Status::energy_drift; }
Status status(const ending::Unstable&) { return Status::unstable; }
Status status(const ending::TurnedOver&) { return Status::unstable; }
Status status(const ending::Tunnelled&) { return Status::tunnelled; }
Status status(const ending::FlewThrough&) { return Status::tunnelled; }
Status status(const ending::NotParted&) { return Status::out_of_time; }

}  // namespace

Status status_of(const Ending& ending) {
  return std::visit([](const auto& e) { return status(e); }, ending);
}

std::string sentence_of(const Ending& ending, const Run& run) {
  return std::visit([&](const auto& e) { return text(e, run); }, ending);
}

}  // namespace ricochet
