#include "render/show.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace ricochet::render {
namespace {

std::vector<std::string> names_of(std::span<const Quantity> quantities, std::vector<std::string> first) {
  for (const Quantity& q : quantities) first.push_back(q.name);
  return first;
}

std::string docs_of(std::span<const Quantity> quantities) {
  std::string text;
  for (const Quantity& q : quantities)
    text += fmt::format("; {}: {}{}", q.name, q.doc, q.unit.empty() ? "" : " [" + q.unit + "]");
  return text;
}

const Quantity* named(std::span<const Quantity> quantities, const std::string& name) {
  for (const Quantity& q : quantities)
    if (q.name == name) return &q;
  return nullptr;
}

}  // namespace

std::span<const Quantity> material_quantities() {
  static const std::vector<Quantity> list{
      {"energy_density", "strain energy density", "m0 c^2/R^2", "energy of springs or elements per area at rest",
       false},
      {"speed", "speed", "c", "of the nodes", false},
      {"velocity_x", "velocity along x", "c", "of the nodes", true},
      {"velocity_y", "velocity along y", "c", "of the nodes", true},
      {"pressure", "pressure", "m0 c^2/R^2", "minus the mean of the principal stresses", true},
      {"von_mises", "von Mises stress", "m0 c^2/R^2", "of the stress in the plane, or in a body of revolution", false},
      {"plastic_strain", "plastic strain", "", "of elements that yield; 0 of all else", false},
      {"stretch", "stretch", "",
       "mean relative elongation of the springs around, or that of elements along their principal axes", true},
  };
  return list;
}

std::span<const Quantity> spring_quantities() {
  static const std::vector<Quantity> list{
      {"energy", "energy of a spring", "m0 c^2", "of each spring", false},
      {"tension", "tension of a spring", "m0 c^2/R", "of each spring, positive if it pulls", true},
  };
  return list;
}

std::span<const Quantity> plot_quantities() {
  static const std::vector<Quantity> list{
      {"vn", "v_n", "c", "normal velocity of the projectile", true},
      {"vt", "v_t", "c", "tangential velocity of the projectile", true},
      {"omega", "ω", "c/R", "spin of the projectile", true},
      {"height", "y", "R", "height of the projectile's centre", true},
      {"force_n", "F_n", "m0 c^2/R", "normal force of contact on the projectile", true},
      {"force_t", "F_t", "m0 c^2/R", "tangential force of contact on the projectile", true},
      {"vibration", "E_{vib}", "m0 c^2", "energy of the vibration of both bodies", false},
  };
  return list;
}

const Quantity* coloured_quantity(const Show& show) {
  if (const Quantity* q = named(material_quantities(), show.material)) return q;
  return named(spring_quantities(), show.springs);
}

const Quantity* plotted_quantity(const Show& show) { return named(plot_quantities(), show.plot); }

Smoothing Show::how_smooth() const {
  return smoothing == "supersample"   ? Smoothing::supersample
         : smoothing == "multisample" ? Smoothing::multisample
                                      : Smoothing::lines;
}

namespace {

using Members = std::vector<Member<Show>>;

Field flag(const char* name, const char* doc) { return {name, "boolean", "", doc, any_number, by_struct}; }

Field choice(const char* name, std::string doc, std::vector<std::string> choices) {
  return {name, "string", "", std::move(doc), any_number, by_struct, false, std::move(choices)};
}

// What is drawn of the bodies.
Members fields_of_the_scene() {
  return {
      {{"title", "string", "", "above the picture", any_number, "", true}, &Show::title},
      {choice("material", "what colours the bodies: none (nothing is filled), plain" + docs_of(material_quantities()),
              names_of(material_quantities(), {"none", "plain"})),
       &Show::material},
      {choice("springs",
              "how springs are drawn: none, plain (thin and dark), or coloured where the material is none or plain" +
                  docs_of(spring_quantities()),
              names_of(spring_quantities(), {"none", "plain"})),
       &Show::springs},
      {flag("rims", "outlines of the bodies"), &Show::rims},
      {flag("anchors", "hatching where a rim is held"), &Show::anchors},
      {flag("forces", "forces of contact on the projectile's nodes, as arrows, with their scale"), &Show::forces},
      {flag("velocity", "velocity of the projectile's centre of mass, as an arrow, with its scale"), &Show::velocity},
      {flag("spin", "the projectile's turn since the start: a radius that turns with it"), &Show::spin},
      {flag("trail", "the path of the projectile's centre"), &Show::trail},
      {flag("fronts",
            "in the target, how far P waves (solid), S waves (dashed) and, along its surface, Rayleigh waves (marks) "
            "have come since the first touch, by the moduli that its interior and placement usually have, which of "
            "lattices are good to 2 %"),
       &Show::fronts},
      {flag("ghost", "outlines of the bodies as if they were rigid"), &Show::ghost},
      {{"magnify", "number", "", "factor of the deformation, the difference from a rigid motion", {0, 1e6}, "1"},
       &Show::magnify},
  };
}

// What stands beside them.
Members fields_of_the_texts() {
  return {
      {flag("colour_bar", "what the colours mean, with unit; a tip at an end says that values lie beyond it"),
       &Show::colour_bar},
      {flag("clock", "time and Psi1"), &Show::clock},
      {flag("ledger",
            "where the energy is, as a stacked bar: translation along the normal and along the tangent, spin, "
            "vibration (of the projectile), target, contact, and the scene's effects by name: what they have taken, "
            "and what their potentials (gravity) hold, counted from the least of the sequence, so that energy that "
            "stays fills all of the bar"),
       &Show::ledger},
      {choice("plot",
              "a plot that grows with time, of every moment while a run is drawn, of its frames if a recording is" +
                  docs_of(plot_quantities()),
              names_of(plot_quantities(), {"none"})),
       &Show::plot},
  };
}

// How it is seen and coloured.
Members fields_of_the_view() {
  return {
      {choice("colours", "of the colour bar; auto: ylgnbu, or puor for a quantity of both signs",
              {"auto", "ylgnbu", "puor", "cividis"}),
       &Show::colours},
      {choice("scale", "of the colour bar; auto: sqrt for energies, else linear", {"auto", "linear", "sqrt"}),
       &Show::scale},
      {{"low", "number", "",
        "lower end of the colour bar, in the unit told there; from the whole sequence unless given", any_number, "",
        true},
       &Show::low},
      {{"high", "number", "",
        "upper end of the colour bar, in the unit told there; from the whole sequence unless given: all but the "
        "strongest thousandth",
        any_number, "", true},
       &Show::high},
      {choice("camera",
              "fit: all of the sequence; follow: the projectile in the middle; contact: the place of impact, close. "
              "Rims stand apart by the range of the repulsion, also where they press hardest",
              {"fit", "follow", "contact"}),
       &Show::camera},
      {{"width",
        "number",
        "R",
        "width of what the cameras follow and contact see; unless given 5, or more where the projectile needs it, and "
        "2.5",
        {1e-3, 1e4},
        "",
        true},
       &Show::width},
      {choice("smoothing",
              "lines: strokes are smooth by themselves; multisample: four samples at every edge; supersample: four "
              "times the pixels, slow",
              {"lines", "multisample", "supersample"}),
       &Show::smoothing},
  };
}

}  // namespace

const std::vector<Member<Show>>& Show::fields() {
  static const Members list = [] {
    Members all = fields_of_the_scene();
    for (const Members& more : {fields_of_the_texts(), fields_of_the_view()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return list;
}

void Show::check() const {
  const bool spring_field = named(spring_quantities(), springs) != nullptr,
             material_field = named(material_quantities(), material) != nullptr;
  if (spring_field && material_field)
    throw FieldError("springs", fmt::format("'{}' colours the springs and '{}' the material, and there is one colour "
                                            "bar; make one of them plain or none",
                                            springs, material));
  const Quantity* q = coloured_quantity(*this);
  if (!q && (!std::isnan(low) || !std::isnan(high)))
    throw FieldError(std::isnan(low) ? "high" : "low", "nothing is coloured by a quantity");
  if (low >= high) throw FieldError("high", fmt::format("must be above low = {:g}", low));
  if (high - low < 1e-6 * std::max(std::abs(high), std::abs(low)))
    throw FieldError("high", fmt::format("is too close to low = {:g}", low));
  if (q && q->is_signed && std::isnan(low) && high <= 0)
    throw FieldError("high", fmt::format("must be above 0 where low is not given: '{}' has both signs", q->name));
  if (q && q->is_signed && std::isnan(high) && low >= 0)
    throw FieldError("low", fmt::format("must be below 0 where high is not given: '{}' has both signs", q->name));
  if (q && !q->is_signed && high <= 0)
    throw FieldError("high", fmt::format("must be above 0: '{}' is never below", q->name));
  if (q && !q->is_signed && low < 0) throw FieldError("low", fmt::format("'{}' is never below 0", q->name));
  if (q && q->is_signed && scale == "sqrt")
    throw FieldError("scale", fmt::format("'{}' has both signs; use linear", q->name));
  if (camera == "fit" && !std::isnan(width))
    throw FieldError("width", "goes with camera = \"follow\" or \"contact\"; fit shows all");
}

}  // namespace ricochet::render
