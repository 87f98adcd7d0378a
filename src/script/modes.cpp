// ricochet.modes.

#include "body/modes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/hash.hpp"
#include "record/film.hpp"
#include "script/fields.hpp"
#include "script/filmed.hpp"
#include "script/look.hpp"
#include "script/objects.hpp"
#include "shape/outline.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

constexpr double drawn_amplitude = 0.06;  // greatest displacement over the diagonal of the body
constexpr int period_frames = 40;         // of a film, in one period
constexpr int periods = 3;

struct ModesAsked {
  int count = 12;
  std::string out, film;
  int filmed = 1;

  static const std::vector<Member<ModesAsked>>& fields() {
    static const std::vector<Member<ModesAsked>> list{
        {{"count", "integer", "", "how many, the slowest first", {1, 2000}, "12"}, &ModesAsked::count},
        {{"out", "string", "", "draws them beside one another as OUT.png", any_number, "", true}, &ModesAsked::out},
        {{"film", "string", "", "name of an .mp4 file that shows three periods of one; needs ffmpeg", any_number, "",
          true},
         &ModesAsked::film},
        {{"filmed", "integer", "", "which", {1, 2000}, "1"}, &ModesAsked::filmed}};
    return list;
  }
};

/// A body with its slowest modes.
struct Spectrum {
  std::shared_ptr<const Solid> solid;
  std::vector<Mode> modes;
  double stiffness;
  std::string unit;  ///< of omega
};

Spectrum spectrum_of(lua_State* L, int count) {
  lua_getfield(L, 1, "body");
  const Body& body = *body_at(L, -1).body;
  lua_pop(L, 1);
  Spectrum spectrum{{}, {}, body.numbers.stiffness, body.material ? "rad/s" : "c/R"};
  try {
    spectrum.solid = build_solid(body);
    spectrum.modes = slowest_modes(*spectrum.solid, spectrum.stiffness, count);
  } catch (const Error& error) {
    throw_here(L, FieldError("body", error.what()));
  }
  return spectrum;
}

double greatest_displacement(const Mode& mode) {
  double most = 0;
  for (Eigen::Index c = 0; c < mode.shape.size(); c += 2) most = std::max(most, mode.shape.segment<2>(c).norm());
  return most;
}

/// The body displaced by a mode; at a displacement of 1 it moves by 0.06 of its diagonal.
Frame frame_of(const Spectrum& spectrum, const Mode& mode, double displacement) {
  const Solid& solid = *spectrum.solid;
  const Box box = bounding_box(solid.points);
  const double by = displacement * drawn_amplitude * (box.high - box.low).norm() / greatest_displacement(mode);
  Frame frame;
  for (int i = 0; i < solid.nodes(); ++i) {
    Vec2 at = solid.points[static_cast<std::size_t>(i)];
    if (i < solid.free) at += by * mode.shape.segment<2>(2 * i);
    append(frame.position, at);
    append(frame.velocity, Vec2(0, 0));
    append(frame.contact_force, Vec2(0, 0));
  }
  return frame;
}

/// Pictures of a body at displacements by its modes, one after another.
Source source_of(const Spectrum& spectrum, const std::string& hash,
                 std::vector<std::pair<std::size_t, double>> moments) {
  Source source;
  source.subject = std::make_shared<render::Subject>(body_mesh(*spectrum.solid, spectrum.stiffness));
  source.hash = hash;
  source.play = [&spectrum, moments = std::move(moments)](const std::atomic<bool>& stop,
                                                          const std::function<void(Frame)>& use,
                                                          const std::function<void(const Sample&)>&) {
    for (std::size_t k = 0; k < moments.size() && !stop; ++k) {
      const auto& [mode, displacement] = moments[k];
      Frame frame = frame_of(spectrum, spectrum.modes[mode], displacement);
      frame.time = static_cast<double>(k);
      use(std::move(frame));
    }
  };
  return source;
}

render::Show show_of_modes() {
  render::Show show;
  show.clock = show.colour_bar = false;
  show.ghost = true;
  show.springs = "none";
  return show;
}

void draw_sheet(lua_State* L, const Spectrum& spectrum, const std::string& hash, const std::string& name) {
  const Shooting shooting = sized_shooting_of(L, show_of_modes());
  const fs::path path = claimed_path(L, "out", name + run_names::picture);
  std::vector<std::pair<std::size_t, double>> moments;
  std::vector<Pick> picks;
  for (std::size_t k = 0; k < spectrum.modes.size(); ++k) {
    moments.emplace_back(k, 1);
    picks.push_back({0, k, fmt::format("{}: ω = {:.4g} {}", k + 1, spectrum.modes[k].omega, spectrum.unit)});
  }
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(picks.size()))));
  at_call(L, [&] { shoot_still(shooting, {source_of(spectrum, hash, moments)}, picks, columns, path); });
  session_of(L).inform(fmt::format("modes: {}\n", path.string()));
}

void film_mode(lua_State* L, const Spectrum& spectrum, const std::string& hash, const ModesAsked& asked) {
  const auto mode = static_cast<std::size_t>(asked.filmed - 1);
  if (mode >= spectrum.modes.size())
    throw_here(L, FieldError("filmed", fmt::format("is {}, and {} modes are asked for", asked.filmed, asked.count)));
  if (!run_names::is_film(asked.film))
    throw_here(L, FieldError("film", fmt::format("'{}' must end in {}, {} or {}", asked.film, run_names::film,
                                                 run_names::film_gif, run_names::film_png)));
  Shooting shooting = sized_shooting_of(L, show_of_modes());
  shooting.show.title = fmt::format("mode {}: ω = {:.4g} {}", asked.filmed, spectrum.modes[mode].omega, spectrum.unit);
  std::vector<std::pair<std::size_t, double>> moments;
  for (int k = 0; k < periods * period_frames; ++k)
    moments.emplace_back(mode, std::cos(2 * std::numbers::pi * k / period_frames));
  Sequence sequence;
  sequence.film = claimed_path(L, "film", asked.film);
  at_call(L, [&] { shoot_sequence(shooting, {source_of(spectrum, hash, moments)}, sequence); });
  session_of(L).inform(fmt::format("film: {}\n", sequence.film.string()));
}

// { { x =, y =, ux =, uy = }, ... } of the free nodes; the greatest displacement is 1.
void push_shape(lua_State* L, const Solid& solid, const Mode& mode) {
  const double most = greatest_displacement(mode);
  lua_createtable(L, solid.free, 0);
  for (int i = 0; i < solid.free; ++i) {
    const Vec2 &at = solid.points[static_cast<std::size_t>(i)], by = mode.shape.segment<2>(2 * i) / most;
    lua_createtable(L, 0, 4);
    set_number(L, "x", at.x());
    set_number(L, "y", at.y());
    set_number(L, "ux", by.x());
    set_number(L, "uy", by.y());
    lua_seti(L, -2, i + 1);
  }
}

int modes(lua_State* L) {
  check_table(L, 1, function_named("modes"));
  const auto asked = members_of_call<ModesAsked>(L);
  const Spectrum spectrum = spectrum_of(L, asked.count);
  if (const Session& session = session_of(L); !session.options.check) {
    lua_getfield(L, 1, "body");
    const std::string hash = hash_text(body_at(L, -1).body->geometry_text());
    lua_pop(L, 1);
    if (!asked.out.empty()) draw_sheet(L, spectrum, hash, asked.out);
    if (!asked.film.empty()) film_mode(L, spectrum, hash, asked);
  }
  lua_createtable(L, asked.count, 0);
  for (std::size_t k = 0; k < spectrum.modes.size(); ++k) {
    const Mode& mode = spectrum.modes[k];
    const Vec2 share = participation(*spectrum.solid, mode);
    lua_createtable(L, 0, 5);
    set_number(L, "mode", static_cast<double>(k + 1));
    set_number(L, "omega", mode.omega);
    set_number(L, "participation_x", share.x());
    set_number(L, "participation_y", share.y());
    push_shape(L, *spectrum.solid, mode);
    lua_setfield(L, -2, "shape");
    push_strict(L, "a mode");
    lua_seti(L, -2, static_cast<lua_Integer>(k) + 1);
  }
  return 1;
}

}  // namespace

Group mode_functions() {
  const std::vector<Field> look = look_fields();
  return {
      .functions = {
          {.name = "modes",
           .doc = "The free vibrations of a body, the slowest first, without the rigid motions of a free "
                  "one; for small displacements, of springs or elements. A list of tables: `mode`, its "
                  "number; `omega`, in c/R, or in rad/s of a body of a material; `participation_x` and "
                  "`participation_y`, the share of the free nodes' mass that moves with it along x and y "
                  "(nothing in a free body); `shape`, a list of { x =, y =, ux =, uy = } of the free "
                  "nodes, with a greatest displacement of 1. In pictures the darker places hold more of the energy.",
           .fields = std::vector<Field>{{"body", "body", "", "of springs or elements"}} + fields_of<ModesAsked>() +
                     std::vector<Field>{look.front()},
           .returns = "table",
           .example = "ricochet.modes { body = disk, count = 12, out = \"modes\" }[1].omega",
           .call = guarded<modes>}}};
}

}  // namespace ricochet
