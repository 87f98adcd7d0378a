// The body of a script's table.

#include "script/read_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "body/elasticity.hpp"
#include "core/hash.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

Points points_at(lua_State* L, int index) {
  Points points;
  each_element(L, index, [&](lua_Integer) {
    lua_rawgeti(L, -1, 1);
    lua_rawgeti(L, -2, 2);
    points.emplace_back(lua_tonumber(L, -2), lua_tonumber(L, -1));
    lua_pop(L, 2);
  });
  return points;
}

// As a script gives an outline: closed by its first point again, or not. Every other point is there once.
Points cleaned(Points outline, const char* field, const std::string& what) {
  if (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
  std::vector<std::size_t> order(outline.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return std::array{outline[i].x(), outline[i].y()}; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (const Vec2& p = outline[order[k]]; key(order[k - 1]) == key(order[k]))
      throw FieldError(field, fmt::format("{}points {} and {} are both ({:g}, {:g}); leave one out", what,
                                          order[k - 1] + 1, order[k] + 1, p.x(), p.y()));
  return outline;
}

// The list on top of the stack; what was read from a file names it.
Points read_points(lua_State* L, Body& body) {
  Points points = points_at(L, -1);
  if (lua_getfield(L, -1, "hash") == LUA_TSTRING) body.files.emplace_back(lua_tostring(L, -1));
  lua_pop(L, 1);
  return points;
}

void read_outlines(lua_State* L, Body& body) {
  lua_getfield(L, 1, "outline");
  body.outline = cleaned(read_points(L, body), "outline", "");
  lua_pop(L, 1);
  if (signed_area(body.outline) < 0) std::reverse(body.outline.begin(), body.outline.end());
  each_in_field(L, 1, "holes", [&](lua_Integer k) {
    Points& hole = body.holes.emplace_back();
    hole = cleaned(read_points(L, body), "holes", fmt::format("hole {}: ", k));
    if (signed_area(hole) > 0) std::reverse(hole.begin(), hole.end());
  });
}

// Nodes given one by one, beside which nothing is placed.
void read_nodes(lua_State* L, Body& body) {
  if (lua_getfield(L, 1, "points") == LUA_TTABLE) {
    body.points = read_points(L, body);
    for (const char* other : {"nodes", "placement"})
      if (has_field(L, 1, other)) throw FieldError(other, "give points or " + std::string(other) + ", not both");
    if (body.numbers.margin != 0)
      throw FieldError("margin", "is for nodes that are placed; leave it out beside points");
  }
  lua_pop(L, 1);
}

// Where a mesh is fine.
void read_mesh(lua_State* L, Body& body) {
  if (lua_getfield(L, 1, "fine_at") == LUA_TTABLE) {
    const std::vector<double> at = numbers_at(L, -1);
    if (at.size() != 2) throw FieldError("fine_at", fmt::format("must be {{x, y}}, has {} numbers", at.size()));
    body.fine_at = Vec2(at[0], at[1]);
  }
  lua_pop(L, 1);
  if (body.numbers.meshed()) {
    for (const char* other : {"nodes", "placement", "rim_spacing", "margin"})
      if (has_field(L, 1, other)) throw FieldError(other, "give h_min or " + std::string(other) + ", not both");
    return;
  }
  for (const char* field : {"h_max", "grade", "fine_at", "fine_within", "mesh"})
    if (has_field(L, 1, field)) throw FieldError(field, "is of a mesh; give h_min too");
}

void read_motion(lua_State* L, Body& body) {
  if (lua_getfield(L, 1, "velocity") == LUA_TTABLE) {
    const std::vector<double> v = numbers_at(L, -1);
    if (v.size() != 2) throw FieldError("velocity", fmt::format("must be {{vx, vy}}, has {} numbers", v.size()));
    body.velocity = {v[0], v[1]};
  }
  if (lua_getfield(L, 1, "spin") == LUA_TNUMBER) body.spin = lua_tonumber(L, -1);
  lua_pop(L, 2);
}

// A body that is held somewhere has no motion of its own.
void check_motion(const Body& body) {
  const bool held = body.rigid() || std::count(body.anchored.begin(), body.anchored.end(), true) > 0;
  for (const auto& [field, moves] :
       {std::pair("velocity", body.velocity != Vec2::Zero()), std::pair("spin", body.spin != 0)})
    if (held && moves)
      throw FieldError(field, body.rigid() ? "a rigid body stays where it is; leave it out, or take interior springs"
                                           : "an anchored body stays where it is; leave it out, or anchor nothing");
}

/// A function (x, y) of the script's, in a field of the table at index 1; or none.
class PlaceFunction {
 public:
  PlaceFunction(lua_State* L, const char* field) : L_(L) {
    lua_getfield(L, 1, field);
    index_ = lua_gettop(L);
  }

  bool given() const { return lua_isfunction(L_, index_); }

  bool truth_at(const Vec2& p, const char* field) const {
    call_at(p);
    if (!lua_isboolean(L_, -1) && !lua_isnil(L_, -1))
      throw FieldError(field, fmt::format("the function must return true or false, gave {} at ({:.4g}, {:.4g})",
                                          shown(L_, -1), p.x(), p.y()));
    const bool value = lua_toboolean(L_, -1);
    lua_pop(L_, 1);
    return value;
  }

  double positive_number_at(const Vec2& p, const char* field) const {
    return number_at(p, field, "a positive number", [](double value) { return value > 0 && std::isfinite(value); });
  }

  double poisson_ratio_at(const Vec2& p, const char* field) const {
    return number_at(p, field, "a number between -1 and 0.5, without these",
                     [](double value) { return value > -1 && value < 0.5; });
  }

 private:
  template <class Right>
  double number_at(const Vec2& p, const char* field, const char* wanted, Right&& right) const {
    call_at(p);
    const double value = lua_type(L_, -1) == LUA_TNUMBER ? lua_tonumber(L_, -1) : not_given;
    if (!right(value))
      throw FieldError(field, fmt::format("the function must return {}, gave {} at ({:.4g}, {:.4g})", wanted,
                                          shown(L_, -1), p.x(), p.y()));
    lua_pop(L_, 1);
    return value;
  }

  // Leaves the value on top of the stack.
  void call_at(const Vec2& p) const {
    lua_pushvalue(L_, index_);
    lua_pushnumber(L_, p.x());
    lua_pushnumber(L_, p.y());
    lua_call(L_, 2, 1);
  }

  lua_State* L_;
  int index_;
};

// Of equal numbers that number itself, to the last bit.
double mean_of(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number - numbers.front();
  return numbers.front() + sum / static_cast<double>(numbers.size());
}

std::string plan_key(const Body& body, const std::vector<bool>& anchored_rim) {
  const BodyNumbers& n = body.numbers;
  std::string text = fmt::format("{} {} {} {} {} {} {};", n.interior, n.nodes, n.placement, n.seed, n.roughness,
                                 n.rim_spacing, n.margin);
  text += fmt::format("{};", body.passed_over);
  if (n.meshed())
    text += fmt::format("{} {} {} {} {} {} {};", n.mesh, n.h_min, n.h_max, n.grade, n.fine_within,
                        body.size_field().fine_at.x(), body.size_field().fine_at.y());
  const auto add = [&](const Points& points) {
    for (const Vec2& p : points) text += fmt::format("{} {};", p.x(), p.y());
    text += '/';
  };
  add(body.outline);
  add(body.points);
  for (const Points& hole : body.holes) add(hole);
  for (const bool held : anchored_rim) text += held ? '1' : '0';
  return hash_text(text);
}

// Samples of a sweep share bodies: a plan is made once.
std::shared_ptr<const NodePlan> planned(Session& session, const Body& body, const std::vector<bool>& anchored_rim) {
  auto& kept = session.plans[plan_key(body, anchored_rim)];
  if (!kept) kept = std::make_shared<NodePlan>(plan_nodes(body, anchored_rim));
  const auto plan = kept;
  session.planned_nodes += static_cast<double>(plan->points.size());
  constexpr double most_planned = 2e7;  // half a GB: then the plans are made again
  if (session.planned_nodes > most_planned) {
    session.plans.clear();
    session.planned_nodes = 0;
  }
  return plan;
}

/// The plan of a body, and which of its rim nodes are held (empty where no function says so).
struct Planned {
  std::shared_ptr<const NodePlan> plan;
  std::vector<bool> anchored_rim;
};

constexpr int most_passed_over = 1000;

// Of the first of its seed's lattices whose rough rim does not cross itself, where the body passes over the others.
Planned first_planned(Session& session, Body& made, const PlaceFunction& anchored) {
  for (;; ++made.passed_over) {
    std::vector<bool> anchored_rim;
    const Rim rim = plan_rim(made);
    if (anchored.given())
      for (const Vec2& p : rim.points) anchored_rim.push_back(anchored.truth_at(p, "anchored"));
    try {
      return {planned(session, made, anchored_rim), anchored_rim};
    } catch (const CrossingRim&) {
      if (made.numbers.crossing == "refuse") throw;
      if (made.passed_over == most_passed_over)
        throw FieldError("roughness", fmt::format("{} R makes the rough rims of seed {} cross themselves, all of {}; "
                                                  "lower it, or take fewer nodes on the rim",
                                                  made.numbers.roughness, made.numbers.seed, most_passed_over + 1));
    }
  }
}

// Refuses what says nothing of a rigid body. Its stiffness and density may have been given as functions.
void check_rigid(const Body& body, bool stiffness_by_place, bool density_by_place) {
  const BodyNumbers usual, &given = body.numbers;
  const auto refuse = [](const char* field) {
    throw FieldError(field, "says nothing of a rigid body, inside which nothing moves; leave it out");
  };
  if (stiffness_by_place || given.stiffness != usual.stiffness) refuse("stiffness");
  if (density_by_place || !std::isnan(given.density)) refuse("density");
  if (!std::isnan(given.mass)) refuse("mass");
  if (given.placement != usual.placement) refuse("placement");
  if (given.margin != usual.margin) refuse("margin");
  if (!body.points.empty()) refuse("points");
  if (given.prestress != usual.prestress) refuse("prestress");
  for (const auto& member : SpringLawNumbers::fields())
    std::visit(
        [&](auto number) {
          if (given.*number != usual.*number) refuse(member.field.name.c_str());
        },
        member.place);
}

// Refuses what says nothing of elements, or of anything else.
void check_interior(lua_State* L, const Body& body) {
  const auto refuse = [L](const char* field, const char* message) {
    if (has_field(L, 1, field)) throw FieldError(field, message);
  };
  if (!body.numbers.of_modes())
    for (const char* field : {"modes", "modes_of"})
      refuse(field, "is of a body of modes; give interior = \"modes\" too");
  else if (body.numbers.axisymmetric())
    throw FieldError("interior", "modes are of bodies in the plane, and this one is axisymmetric; take elements");
  if (body.numbers.of_modes()) {
    refuse("law", "says nothing of modes, which are small vibrations about rest; leave it out");
    if (body.numbers.quartic != 0)
      refuse("quartic", "says nothing of modes, which are small vibrations about rest; leave it out");
  }
  if (!body.numbers.of_elements()) {
    for (const char* field : {"E", "nu", "law", "h_min", "h_max", "grade", "fine_at", "fine_within", "mesh"})
      refuse(field, body.numbers.of_modes() ? "is of elements; give modes_of = \"elements\" (or leave modes_of out)"
                                            : "is of elements; give interior = \"elements\" too");
    return;
  }
  refuse("stiffness", "is of springs; elements have E and nu, or a material");
  refuse("mass", "is of springs; nodes of elements weigh their shares of the area: give density");
  refuse("prestress", "is of springs; elements have none");
  for (const auto& member : SpringLawNumbers::fields())
    refuse(member.field.name.c_str(), "is of springs; elements have a law");
  for (const char* field : {"E", "nu"})
    if (!has_field(L, 1, field) && !has_field(L, 1, "material"))
      throw FieldError(field, "is missing: a body of elements needs E and nu, or a material");
}

// Springs are alike, so what they have of nu is their placement's.
void warn_of_nu(Session& session, const Material& material, const PlaneMaterial& wanted, const BodyNumbers& numbers) {
  const double nu = usual_moduli(numbers).poisson_ratio;
  if (std::abs(wanted.nu - nu) <= 0.05) return;
  session.warn(
      fmt::format("a lattice of equal springs ({}) has nu = {:.2f} in its plane; the material of E = {:g} Pa, nu "
                  "= {:g} has {:.2f} in {}, so what depends on nu is that of another material",
                  numbers.placement, nu, material.E, material.nu, wanted.nu, numbers.state));
}

// Stiffness and mass from the material of the table at index 1, if there is one; in SI.
void read_material(lua_State* L, Body& made) {
  const auto given = [L](const char* field) { return has_field(L, 1, field); };
  if (!given("material")) {
    if (given("thickness") || (given("state") && !made.numbers.of_elements()))
      throw FieldError(given("state") ? "state" : "thickness",
                       "says how a plane is cut from a material; give material too");
    return;
  }
  // Of elements they may differ from place to place beside the material, which says what they are measured by.
  const auto by_place = [&](const std::string& field) {
    return made.numbers.of_elements() && (field == "E" || field == "nu" || field == "density") &&
           PlaceFunction(L, field.c_str()).given();
  };
  for (const char* field : {"stiffness", "density", "mass", "E", "nu"})
    if (given(field) && !by_place(field))
      throw FieldError(field,
                       "follows from the material; give one of them, or of elements a function of the place, in SI");
  if (given("thickness") && made.numbers.axisymmetric())
    throw FieldError("thickness",
                     "says nothing of an axisymmetric body, which is as thick as it is round; leave it out");
  if (made.rigid())
    throw FieldError("material", "says nothing of a rigid body, inside which nothing moves; leave it out");
  Section section;
  read_members(L, 1, section);
  lua_getfield(L, 1, "material");
  const Material& material = material_at(L, -1).material;
  BodyNumbers& numbers = made.numbers;
  made.material = in_plane(material, numbers.state, section.thickness);
  numbers.density = made.material->density;
  if (numbers.of_elements()) {
    numbers.nu = material.nu;
    numbers.stiffness = material.E * section.thickness;
    lua_pop(L, 1);
    return;
  }
  numbers.stiffness = made.material->E / usual_moduli(numbers).per_stiffness;
  if (!given("quartic")) numbers.quartic = 0;  // Hooke's law is what E tells of
  warn_of_nu(session_of(L), material, *made.material, numbers);
  lua_pop(L, 1);
}

}  // namespace

Body read_body(lua_State* L) {
  Body made;
  read_members(L, 1, made.numbers);
  read_outlines(L, made);
  read_nodes(L, made);
  read_mesh(L, made);
  read_motion(L, made);
  read_material(L, made);
  check_interior(L, made);
  if (!std::isnan(made.numbers.E)) made.numbers.stiffness = made.numbers.E;
  const char* const modulus = made.numbers.of_elements() ? "E" : "stiffness";
  const PlaceFunction anchored(L, "anchored"), stiffness(L, modulus), density(L, "density"), nu(L, "nu");
  if (made.rigid()) check_rigid(made, stiffness.given(), density.given());
  if (!std::isnan(made.numbers.mass) && (density.given() || !std::isnan(made.numbers.density)))
    throw FieldError("mass", "is that of every node, density that of the area: give one of them");
  const auto [plan, anchored_rim] = first_planned(session_of(L), made, anchored);
  if (!made.points.empty() || made.numbers.meshed()) made.numbers.nodes = static_cast<int>(plan->points.size());
  if (anchored.given()) {
    made.anchored = anchored_rim;
    for (std::size_t i = made.anchored.size(); i < plan->points.size(); ++i)
      made.anchored.push_back(anchored.truth_at(plan->points[i], "anchored"));
    if (std::count(made.anchored.begin(), made.anchored.end(), true) == 0)
      throw FieldError("anchored", "is true of no node, so that nothing is held; correct it, or leave it out");
    if (std::count(made.anchored.begin(), made.anchored.end(), false) == 0 && !made.rigid())
      throw FieldError("anchored", "holds every node; nothing could move: give interior = \"rigid\" instead");
  }
  // In SI moduli and densities are per volume.
  const double thickness = made.material ? made.material->thickness : 1;
  if (stiffness.given()) {
    for (const Vec2& p : plan->points)
      made.node_stiffness.push_back(stiffness.positive_number_at(p, modulus) * thickness);
    if (!made.material) made.numbers.stiffness = 1;  // the factor of what the nodes have by their places
  }
  if (density.given())
    for (const Vec2& p : plan->points)
      made.node_density.push_back(density.positive_number_at(p, "density") * thickness);
  if (nu.given()) {
    for (const Vec2& p : plan->points) made.node_nu.push_back(nu.poisson_ratio_at(p, "nu"));
    made.numbers.nu = mean_of(made.node_nu);  // what estimates take
  }
  check_motion(made);
  return made;
}

}  // namespace ricochet
