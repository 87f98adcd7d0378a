#include "impact/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "impact/axes.hpp"

namespace ricochet {
namespace {

// `later`: a field that came later, told only where it says something, so that older texts stay.
template <class Struct>
std::string text_of(const std::string& prefix, const Struct& values, const std::string& later = "") {
  const Struct usual;
  std::string text;
  for (const auto& member : Struct::fields())
    std::visit(
        [&](auto place) {
          if (member.field.name != later || values.*place != usual.*place)
            text += fmt::format("{}.{} = {}\n", prefix, member.field.name, values.*place);
        },
        member.place);
  return text;
}

// Only where there is one, so that older texts stay.
std::string motion_text(const Body& target) {
  if (target.velocity == Vec2::Zero() && target.spin == 0) return "";
  return fmt::format("target velocity {} {} spin {}\n", tangential(target.velocity), normal(target.velocity),
                     target.spin);
}

/// The texts of the bodies of late. Scenes of a sweep share bodies, which do not change once they are in a scene, and a
/// long outline takes longer to write down than all the rest.
class LateTexts {
 public:
  const std::string& of(const std::shared_ptr<const Body>& body) {
    for (const Text& known : texts_)
      if (!known.body.owner_before(body) && !body.owner_before(known.body)) return known.text;
    Text& oldest = texts_[next_++ % texts_.size()];
    oldest.text = body->geometry_text();
    oldest.body = body;
    return oldest.text;
  }

 private:
  struct Text {
    std::weak_ptr<const Body> body;  // of its own, so that no other body is taken for it when it is gone
    std::string text;
  };
  std::array<Text, 8> texts_;
  std::size_t next_ = 0;
};

std::string geometry_of(const std::shared_ptr<const Body>& body) {
  thread_local LateTexts late;
  return body->plane ? body->geometry_text() : late.of(body);
}

// The first body that moves as its modes.
std::optional<std::size_t> body_of_modes(const Scene& scene) {
  for (std::size_t b = 0; b < scene.bodies().size(); ++b)
    if (!scene.bodies()[b]->plane && scene.bodies()[b]->numbers.of_modes()) return b;
  return std::nullopt;
}

// What only scenes in SI have: older texts stay.
std::string text_of_units(const Scene& scene) {
  std::string text;
  for (std::size_t b = 0; b < scene.bodies().size(); ++b)
    if (const auto& m = scene.bodies()[b]->material)
      text += fmt::format("{} of E {} nu {} density {} yield {}\n", body_name(b), m->E, m->nu, m->density, m->yield);
  const Units& u = scene.units;
  return u.si ? text + fmt::format("units SI: R {} m, m0 {} kg, R/c {} s\n", u.length, u.mass, u.time) : text;
}

}  // namespace

const std::vector<Member<Launch>>& Launch::fields() {
  static const std::vector<Member<Launch>> list{
      {{"speed", "number", "c",
        "launch speed |v| in space, whatever the target's own velocity; 0.1 unless normal_speed is given; 0 only with "
        "a height to fall from under gravity",
        not_negative, "", true},
       &Launch::speed},
      {{"psi1", "number", "",
        "tangent of the incident angle, v_t / v_n; 0 unless given otherwise; below 0 the projectile moves along -x",
        any_number, "", true},
       &Launch::psi1},
      {{"angle", "number", "degrees", "incident angle from the normal, instead of psi1", {-90, 90}, "", true},
       &Launch::angle},
      {{"normal_speed", "number", "c", "speed along the normal, instead of speed; 0 as for speed", not_negative, "",
        true},
       &Launch::normal_speed},
      {{"tangential_speed", "number", "c", "speed along the surface, with normal_speed", not_negative, "", true},
       &Launch::tangential_speed},
      {{"spin", "number", "c/R", "angular velocity before impact, counter-clockwise", any_number, "0"}, &Launch::spin},
      {{"at", "number", "R",
        "x of the projectile's centre of mass where its smooth outline would touch the smooth target; slanting past "
        "the far edge it meets the target before",
        any_number, "0"},
       &Launch::at},
      {{"height", "number", "R",
        "starting gap of the smooth outlines along the normal; chosen so that the rough rims are apart. Gravity on the "
        "projectile acts from a given height on, else from the first approach of the rims on; other effects always do "
        "so from there on",
        any_number, "", true},
       &Launch::height},
  };
  return list;
}

Vec2 Launch::velocity() const {
  const auto given = [](double value) { return !std::isnan(value); };
  if (given(normal_speed)) {
    if (given(speed)) throw FieldError("speed", "give speed or normal_speed, not both");
    if (given(angle)) throw FieldError("angle", "give normal_speed with tangential_speed or psi1, not with angle");
    if (given(psi1) && given(tangential_speed)) throw FieldError("psi1", "give psi1 or tangential_speed, not both");
    const double along = given(tangential_speed) ? tangential_speed : given(psi1) ? psi1 * normal_speed : 0.0;
    return {along, -normal_speed};
  }
  if (given(tangential_speed)) throw FieldError("tangential_speed", "needs normal_speed beside it");
  if (given(psi1) && given(angle)) throw FieldError("angle", "give psi1 or angle, not both");
  const double magnitude = given(speed) ? speed : 0.1;
  if (given(angle)) {
    // At 90 degrees the cosine would leave a normal speed of 6e-17.
    const double gamma = angle * std::numbers::pi / 180;
    return {magnitude * std::sin(gamma), std::abs(angle) == 90 ? 0.0 : -magnitude * std::cos(gamma)};
  }
  const double tangent = given(psi1) ? psi1 : 0.0, secant = std::sqrt(1 + tangent * tangent);
  return {magnitude * tangent / secant, -magnitude / secant};
}

const std::vector<Member<Integration>>& Integration::fields() {
  static const std::vector<std::string> choices = [] {
    std::vector<std::string> names{"auto"};
    for (const Method& m : methods()) names.push_back(m.name);
    return names;
  }();
  static const std::vector<Member<Integration>> list{
      {{"method", "string", "", "integrator; auto is pefrl, or the cheapest one for `accuracy`", any_number, "auto",
        false, choices},
       &Integration::method},
      {{"step", "number", "R/c", "time step; chosen from the stiffest node and the contact's onset unless given",
        positive, "", true},
       &Integration::step},
      {{"theta", "number", "",
        "time step times the bound of the highest frequency of this scene's lattices, instead of a step: equal for "
        "lattices of one kind",
        positive, "", true},
       &Integration::theta},
      {{"accuracy",
        "number",
        "",
        "wanted error of `accuracy_of` from the time step, instead of a step: method and step are chosen by trial "
        "runs, and an impact of a sweep that fails by them runs again with half the step",
        {1e-12, 0.1},
        "",
        true},
       &Integration::accuracy},
      {{"accuracy_of",
        "string",
        "",
        "the outcome that accuracy is about",
        any_number,
        "e",
        false,
        {"e", "beta", "mu", "psi2", "vn", "vt", "omega", "e_n", "beta_n", "mu_n", "contact_time"}},
       &Integration::accuracy_of},
      {{"time_limit", "number", "R/c",
        "an impact longer than this ends out_of_time; 100 + 2 / normal speed of the impact unless given", positive, "",
        true},
       &Integration::time_limit},
      {{"energy_tolerance",
        "number",
        "",
        "an impact whose total energy strays further, relative to its start, ends energy_drift",
        {1e-13, std::numeric_limits<double>::infinity()},
        "0.01"},
       &Integration::energy_tolerance},
  };
  return list;
}

void Integration::check() const {
  const auto given = [](double value) { return !std::isnan(value); };
  if (given(accuracy) && given(step)) throw FieldError("accuracy", "give step or accuracy, not both");
  if (given(accuracy) && given(theta)) throw FieldError("accuracy", "give theta or accuracy, not both");
  if (given(theta) && given(step)) throw FieldError("theta", "give step or theta, not both");
}

const std::vector<Member<EndRule>>& EndRule::fields() {
  static const std::vector<Member<EndRule>> list{
      {{"at",
        "string",
        "",
        "parted: the bodies have parted for good; first_parting: a touch has ended and the bodies move apart, whatever "
        "follows; time: at a given time, whatever the bodies do",
        any_number,
        "parted",
        false,
        {"parted", "first_parting", "time"}},
       &EndRule::at},
      {{"force",
        "number",
        "",
        "a touch lasts while the normal force exceeds this share of its greatest in that touch",
        {1e-12, 0.5},
        "0.001"},
       &EndRule::force},
      {{"gap", "number", "R",
        "how far apart the surfaces must be besides; with parted it is the contact's reach unless given", positive, "",
        true},
       &EndRule::gap},
      {{"time", "number", "R/c", "with time: since the surfaces came within reach of each other", positive, "", true},
       &EndRule::time},
  };
  return list;
}

void EndRule::check(const Integration& integration) const {
  const bool given = !std::isnan(time);
  if (at == "time" && !given) throw FieldError("ending", "at = time needs a time beside it");
  if (at != "time" && given) throw FieldError("ending", fmt::format("time goes with at = time, not with {}", at));
  if (at == "time" && !std::isnan(gap)) throw FieldError("ending", "gap goes with parted or first_parting");
  if (given && time > integration.time_limit)
    throw FieldError("time_limit", fmt::format("{:g} R/c is before ending.time, {:g} R/c; raise it or leave it out",
                                               integration.time_limit, time));
}

const Method& Scene::method() const {
  if (integration.method != "auto") return method_named(integration.method);
  const bool split = std::any_of(effects.begin(), effects.end(), is_split);
  return method_named(split || body_of_modes(*this) ? "verlet" : "pefrl");
}

std::string Scene::conflict_with(const Method& method) const {
  if (const auto b = body_of_modes(*this); b && method.name != "verlet")
    return fmt::format(
        "{} is not for the {}, a body of modes, which is kicked once a step and turns exactly in "
        "between; give verlet or leave method out",
        method.name, body_name(*b));
  for (const Effect& effect : effects) {
    const std::string name = name_of(effect);
    if (is_split(effect) && method.outcome_order > 2)
      return fmt::format("{} of order {} would fall to order {} beside {}; give verlet or leave method out",
                         method.name, method.outcome_order, order_beside(effect), name);
    if (method.multirate())
      return fmt::format("{} cannot hold {} beside the target's long steps; give verlet or leave method out",
                         method.name, name);
  }
  return "";
}

std::string Scene::text() const {
  return fmt::format("projectile {} ka {}\ntarget {} ka {}\n", geometry_of(projectile), projectile->numbers.stiffness,
                     geometry_of(target), target->numbers.stiffness) +
         motion_text(*target) + text_of("launch", launch) + text_of("contact", contact, "rule") +
         text_of("integration", integration) + (step_is_chosen() ? "integration.chosen\n" : "") +
         text_of("ending", ending) + (effects.empty() ? "" : "effects\n" + ricochet::text_of(effects)) +
         text_of_units(*this) + (mirrored ? "mirrored\n" : "");
}

Scene Scene::struck_from_other_side() const {
  Scene other = *this;
  other.mirrored = !mirrored;
  for (double* along : {&other.launch.psi1, &other.launch.angle, &other.launch.tangential_speed}) *along = -*along;
  return other;
}

std::string Scene::hash() const { return hash_text(text()); }

std::string Scene::group() const {
  return geometry_of(projectile) + "\n" + geometry_of(target) + "\n" + integration.method + "\n" +
         batch_text_of(effects);
}

}  // namespace ricochet
