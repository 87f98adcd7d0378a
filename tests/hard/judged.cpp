#include <fmt/format.h>

#include <cmath>

#include "body/interior.hpp"
#include "core/error.hpp"
#include "hard/random_scene.hpp"
#include "impact/batch.hpp"
#include "impact/launch/contact_rule.hpp"
#include "impact/launch/launch.hpp"

namespace ricochet::test {
namespace {

using SolidPointer = std::shared_ptr<const Solid>;

const std::atomic<bool> go_on{false};

// What an ending that is not `finished` tells to do.
double told(const std::string& text, const std::string& before) {
  const auto at = text.find(before);
  return at == std::string::npos ? 0 : std::atof(text.c_str() + at + before.size());
}

double acting_xi(const Scene& scene, const Solids& solids) {
  Placement arrives = placed_at_rest(*solids[0]);
  arrives.velocity = in_space(scene.launch.velocity());
  arrives.spin = about_z(scene.launch.spin);
  return acting_contact(scene, solids, arrives).xi;
}

// Cold, smooth bodies give back no more than they bring; what the sides of their rims leave of e_n may be a bit above.
bool cold_and_smooth(const Scene& scene) {
  return scene.effects.empty() && scene.projectile->numbers.roughness == 0 && scene.target->numbers.roughness == 0;
}

}  // namespace

Verdict judged(const RandomScene& random, double steps) {
  Scene scene = random.scene;
  const Method& method = scene.method();
  SolidPointer projectile, target;
  try {
    projectile = build_solid(*scene.projectile);
    target = build_solid(*scene.target);
  } catch (const FieldError& error) {
    // Stars and squares may be too rough for their spacing; nothing else is wrong with any of these bodies.
    const bool rough = std::string(error.what()).find("rough rim crosses itself") != std::string::npos;
    return {"refused", rough ? std::nullopt : std::optional(fmt::format("refused: {}: {}", error.field, error.what()))};
  }
  const double own = frequency_bound(*projectile, scene.projectile->numbers.stiffness).omega,
               other = slower_by(method, 1) * frequency_bound(*target, scene.target->numbers.stiffness).omega;
  const double limit = method.stability_limit / std::max(own, other);
  Start start;
  try {
    start = launch(scene, {projectile.get(), target.get()});
  } catch (const FieldError& error) {
    const std::string text = error.what();
    const double asked = !std::isnan(scene.integration.step) ? scene.integration.step
                                                             : scene.integration.theta / method.stability_limit * limit;
    bool right = false;
    if (text.find("is unstable") != std::string::npos) right = asked > limit && told(text, "; ") > 0;
    if (text.find("lost in rounding") != std::string::npos)
      right = error.field == "speed" || asked * scene.launch.velocity().norm() < 1e-12 ||
              asked < 1e-14 / scene.launch.speed;
    if (text.find("might pass the contact unseen") != std::string::npos) {
      // Coarser than the repulsion's length, and what it says is accepted.
      Scene finer = scene;
      (std::isnan(scene.integration.step) ? finer.integration.theta : finer.integration.step) = told(text, "; give ");
      const double kicks = method.multirate() ? static_cast<double>(method.stages.size()) : 1;
      right = asked * (scene.launch.velocity().norm() + 3 * std::abs(scene.launch.spin)) / kicks >
              std::min(3 / acting_xi(scene, {projectile.get(), target.get()}), 0.01);
      try {
        launch(finer, {projectile.get(), target.get()});
      } catch (const FieldError&) {
        right = false;
      }
    }
    if (error.field == "step" && !(asked > 0)) right = true;
    if (text.find("the linear law takes a rotation for a strain") != std::string::npos)
      right = scene.launch.spin != 0 && scene.projectile->numbers.law == "linear";
    return {"refused", right ? std::nullopt : std::optional(fmt::format("refused: {}: {}", error.field, text))};
  }
  const bool ours = std::isnan(scene.integration.time_limit) && steps * start.step < start.time_limit;
  if (ours) scene.integration.time_limit = steps * start.step;
  Outcome o;
  try {
    o = run_scene({projectile.get(), target.get()}, scene, go_on);
  } catch (const FieldError& error) {
    return {"refused", fmt::format("refused in the run: {}: {}", error.field, error.what())};
  }
  Verdict verdict{name_of(o.status), std::nullopt, o.reason};
  const auto wrong = [&](const std::string& what) {
    verdict.wrong = fmt::format("{}: {} ({})", verdict.ending, what, o.reason);
  };
  std::string refusal;  // of an advice that was taken
  // The advice, taken, leads elsewhere.
  const auto again = [&](const auto& change) {
    Scene better = scene;
    change(better);
    if (std::isnan(better.integration.time_limit)) better.integration.time_limit = start.time_limit;
    try {
      return run_scene({projectile.get(), target.get()}, better, go_on);
    } catch (const FieldError& error) {
      refusal = error.what();
      return o;
    }
  };
  const auto with_step = [&](double step) {
    return again([&](Scene& s) {
      s.integration.step = step;
      s.integration.theta = not_given;
      s.integration.time_limit = std::fmin(s.integration.time_limit, 2 * steps * step);  // it may be not given
    });
  };
  switch (o.status) {
    case Status::finished: {
      for (const auto& [field, value] : Outcome::fields()) {
        const double v = value(o);
        if (std::isinf(v)) wrong(field.name + " is infinite");
      }
      if (!std::isfinite(o.mu_n) || !std::isfinite(o.vt) || !std::isfinite(o.omega)) wrong("no result");
      if (cold_and_smooth(scene)) verdict.e_n = o.e_n;
      if (verdict.e_n > 1.05) wrong(fmt::format("smooth bodies have e_n = {:.3g}", o.e_n));
      if (std::isfinite(o.e) != (std::abs(o.normal_x) <= 0.1)) wrong("e is of y, and the normal is not");
      if (!(o.energy_drift <= 1e-2)) wrong(fmt::format("energy strayed by {:.2g}", o.energy_drift));
      if (!(o.energy_closure <= 1e-2)) wrong(fmt::format("energy closes to {:.2g}", o.energy_closure));
      const bool pulled = find_effect<Gravity>(scene.effects), held_back = find_effect<Drag>(scene.effects);
      if (!target->anchored() && !pulled && !held_back && !(o.momentum_residual < 1e-9))
        wrong(fmt::format("momentum changed by {:.2g}", o.momentum_residual));
      // At vertices of the wall two segments push, which is as a bump of ln 2 / xi: an oblique flight may turn some of
      // its energy upwards there.
      if (random.flat_rigid && scene.launch.psi1 == 0 && o.e > 1 + 1e-6 + o.energy_drift)
        wrong(fmt::format("e = {:.6g} on a flat rigid wall", o.e));
      if (!pulled &&
          o.after.of(0).translation + o.after.of(0).rotation + o.after.of(1).translation + o.after.of(1).rotation >
              o.before.total() * (1 + 1e-6 + 2 * o.energy_drift))
        wrong("the flight gained energy");
      break;
    }
    case Status::energy_drift: {
      if (!(o.energy_drift > scene.integration.energy_tolerance)) wrong("the energy had not strayed");
      double step = o.step, drift = o.energy_drift;
      Outcome finer = o;
      if (o.reason.find("shorter steps are lost in rounding") != std::string::npos) {
        if (o.step / 8 > start.least_step) wrong("there are shorter steps");
        break;
      }
      for (int halving = 0; halving < 4 && finer.status == Status::energy_drift; ++halving) {
        step /= 2;
        finer = with_step(step);
        if (refusal.empty()) continue;
        if (halving > 0) refusal.clear();  // shorter than what was advised
        finer.status = Status::finished;
      }
      if (finer.status == Status::energy_drift && !(finer.energy_drift < drift))
        wrong(fmt::format("a sixteenth of the step strays by {:.2g} again", finer.energy_drift));
      break;
    }
    case Status::unstable: {
      const auto turned_over = [](const Outcome& outcome) {
        return outcome.reason.find("had turned over") != std::string::npos;
      };
      if (turned_over(o)) {
        if (!find_effect<Yielding>(scene.effects) || !(told(o.reason, "elements that yield, ") > 0))
          wrong("nothing that yields was turned over");
        break;
      }
      Outcome finer = o;
      for (int time = 0; time < 2 && finer.status == Status::unstable && !turned_over(finer); ++time) {
        const double step = told(finer.reason, "give a step of ");
        if (!(step > 0 && step < finer.step)) {
          wrong("no step is named");
          break;
        }
        finer = with_step(step);
      }
      if (finer.status == Status::unstable && !turned_over(finer))
        wrong("the step that it names is unstable too, and the one named then");
      break;
    }
    case Status::tunnelled:
      if (o.certified == 1 && o.reason.find("one-sided") == std::string::npos) wrong("below V0");
      if (o.reason.find("flew through") != std::string::npos) break;
      if (o.reason.find("node ") == std::string::npos || o.reason.find("at t = ") == std::string::npos)
        wrong("node or time is not named");
      break;
    case Status::not_finite:
      if (o.reason.find("at t = ") == std::string::npos) wrong("no time is named");
      if (with_step(o.step / 16).status == Status::not_finite) wrong("a sixteenth of the step is not finite either");
      break;
    case Status::no_contact: {
      if (start.touches && o.steps == 0) wrong("launch says that it touches");
      // At half the speed and spin the flight is the same: it must pass by again, or barely touch.
      if (!start.touches || !scene.effects.empty()) break;
      const Outcome slower = again([](Scene& s) {
        const Vec2 v = s.launch.velocity();
        s.launch = Launch{.normal_speed = -v.y() / 2,
                          .tangential_speed = v.x() / 2,
                          .spin = s.launch.spin / 2,
                          .at = s.launch.at,
                          .height = s.launch.height};
        s.integration = Integration{};
      });
      if (slower.status != Status::no_contact &&
          !(slower.status == Status::finished && std::abs(slower.e_n + 1) < 0.05))
        wrong(fmt::format("at half the speed it ends {}", name_of(slower.status)));
      break;
    }
    case Status::out_of_time:
      if (!(o.time >= (ours ? scene.integration.time_limit : start.time_limit) * (1 - 1e-12)))
        wrong("there was time left");
      break;
    case Status::not_run:
      wrong("it did not run");
      break;
  }
  if (o.status != Status::finished && o.reason.empty()) wrong("no reason");
  if (!refusal.empty()) wrong(fmt::format("its advice is refused: {}", refusal));
  return verdict;
}

}  // namespace ricochet::test
