// ricochet.body, and the shapes that lua/ricochet/shapes.lua makes with it.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "body/springs/elasticity.hpp"
#include "core/hash.hpp"
#include "script/fields.hpp"
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

  bool truth_at(const Vec2& p) const {
    call_at(p);
    const bool value = lua_toboolean(L_, -1);
    lua_pop(L_, 1);
    return value;
  }

  double positive_number_at(const Vec2& p, const char* field) const {
    call_at(p);
    const double value = lua_type(L_, -1) == LUA_TNUMBER ? lua_tonumber(L_, -1) : not_given;
    if (!(value > 0 && std::isfinite(value)))
      throw FieldError(field, fmt::format("the function must return a positive number, gave {} at ({:.4g}, {:.4g})",
                                          shown(L_, -1), p.x(), p.y()));
    lua_pop(L_, 1);
    return value;
  }

 private:
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

std::string plan_key(const Body& body, const std::vector<bool>& anchored_rim) {
  const BodyNumbers& n = body.numbers;
  std::string text = fmt::format("{} {} {} {} {} {} {};", n.interior, n.nodes, n.placement, n.seed, n.roughness,
                                 n.rim_spacing, n.margin);
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

/// How a plane is cut from a material.
struct Section {
  std::string state = "plane_stress";
  double thickness = 1;

  static const std::vector<Member<Section>>& fields() {
    static const std::vector<Member<Section>> list{
        {{"state",
          "string",
          "",
          "of a body of a material: plane_stress, a sheet that is free to bulge; plane_strain, a long cylinder",
          any_number,
          "plane_stress",
          false,
          {"plane_stress", "plane_strain"}},
         &Section::state},
        {{"thickness", "number", "m", "of a body of a material, across the plane: a disk is a cylinder of that length",
          positive, "1"},
         &Section::thickness},
    };
    return list;
  }
};

// Springs are alike, so what they have of nu is their placement's.
void warn_of_nu(Session& session, const Material& material, const PlaneMaterial& wanted, const std::string& state,
                const BodyNumbers& numbers) {
  const double nu = usual_moduli(numbers.placement).poisson_ratio;
  if (std::abs(wanted.nu - nu) <= 0.05) return;
  session.warn(
      fmt::format("a lattice of equal springs ({}) has nu = {:.2f} in its plane; the material of E = {:g} Pa, nu "
                  "= {:g} has {:.2f} in {}, so what depends on nu is that of another material",
                  numbers.placement, nu, material.E, material.nu, wanted.nu, state));
}

// Stiffness and mass from the material of the table at index 1, if there is one; in SI.
void read_material(lua_State* L, Body& made) {
  const auto given = [L](const char* field) { return has_field(L, 1, field); };
  if (!given("material")) {
    for (const char* field : {"state", "thickness"})
      if (given(field)) throw FieldError(field, "says how a plane is cut from a material; give material too");
    return;
  }
  for (const char* field : {"stiffness", "density", "mass"})
    if (given(field)) throw FieldError(field, "follows from the material; give one of them");
  if (made.rigid())
    throw FieldError("material", "says nothing of a rigid body, inside which nothing moves; leave it out");
  Section section;
  read_members(L, 1, section);
  lua_getfield(L, 1, "material");
  const Material& material = material_at(L, -1).material;
  BodyNumbers& numbers = made.numbers;
  made.material = in_plane(material, section.state, section.thickness);
  numbers.stiffness = made.material->E / usual_moduli(numbers.placement).per_stiffness;
  numbers.density = made.material->density;
  if (!given("quartic")) numbers.quartic = 0;  // Hooke's law is what E tells of
  warn_of_nu(session_of(L), material, *made.material, section.state, numbers);
  lua_pop(L, 1);
}

// The body of the table at index 1.
Body read_body(lua_State* L) {
  Body made;
  read_members(L, 1, made.numbers);
  read_outlines(L, made);
  read_nodes(L, made);
  read_motion(L, made);
  read_material(L, made);
  const PlaceFunction anchored(L, "anchored"), stiffness(L, "stiffness"), density(L, "density");
  if (made.rigid()) check_rigid(made, stiffness.given(), density.given());
  if (!std::isnan(made.numbers.mass) && (density.given() || !std::isnan(made.numbers.density)))
    throw FieldError("mass", "is that of every node, density that of the area: give one of them");
  std::vector<bool> anchored_rim;
  const Rim rim = plan_rim(made);
  if (anchored.given())
    for (const Vec2& p : rim.points) anchored_rim.push_back(anchored.truth_at(p));
  const auto plan = planned(session_of(L), made, anchored_rim);
  if (!made.points.empty()) made.numbers.nodes = static_cast<int>(plan->points.size());
  if (anchored.given()) {
    made.anchored = anchored_rim;
    for (std::size_t i = made.anchored.size(); i < plan->points.size(); ++i)
      made.anchored.push_back(anchored.truth_at(plan->points[i]));
    if (std::count(made.anchored.begin(), made.anchored.end(), false) == 0 && !made.rigid())
      throw FieldError("anchored", "holds every node; nothing could move: give interior = \"rigid\" instead");
  }
  if (stiffness.given()) {
    for (const Vec2& p : plan->points) made.node_stiffness.push_back(stiffness.positive_number_at(p, "stiffness"));
    made.numbers.stiffness = 1;  // the factor of what the nodes have by their places
  }
  if (density.given())
    for (const Vec2& p : plan->points) made.node_density.push_back(density.positive_number_at(p, "density"));
  check_motion(made);
  return made;
}

template <bool ours>
int body(lua_State* L) {
  check_table(L, 1, function_named("body"), ours);
  std::shared_ptr<const Body> made;
  try {
    made = std::make_shared<const Body>(read_body(L));
  } catch (const FieldError& error) {
    throw_here(L, error);
  }
  const std::size_t bytes = (made->outline.size() + made->points.size()) * sizeof(Vec2) + made->anchored.size() / 8 +
                            (made->node_stiffness.size() + made->node_density.size()) * sizeof(double);
  push_object(L, "ricochet.body", BodyObject{made});
  lua_gc(L, LUA_GCSTEP, static_cast<int>(bytes / 1024 + 1));  // Lua does not see what its object holds
  return 1;
}

int plane(lua_State* L) {
  check_table(L, 1, function_named("plane"));
  Body made;
  made.plane = Plane{};
  push_object(L, "ricochet.body", BodyObject{std::make_shared<const Body>(made)});
  return 1;
}

// Numbers of a body, of which stiffness and density may depend on the place.
std::vector<Field> number_fields(const BodyNumbers& defaults = {}) {
  std::vector<Field> fields = fields_of(defaults);
  const auto stiffness =
      std::find_if(fields.begin(), fields.end(), [](const Field& f) { return f.name == "stiffness"; });
  stiffness->type = "number|function";
  stiffness->doc += "; a function (x, y) gives that of a node, a spring takes the mean of its ends";
  const auto density = std::find_if(fields.begin(), fields.end(), [](const Field& f) { return f.name == "density"; });
  density->type = "number|function";
  density->doc += "; a function (x, y) gives that at a node";
  const std::vector<Field> material{
      {"material", "material", "",
       "what it is made of, instead of stiffness, density and mass, for scenes in SI: the "
       "spring constant is E2/1.155 (triangular), E2/1.16 (poisson_disk) or E2/1.08 "
       "(uniform) times the thickness, E2 the modulus in the plane; springs are linear "
       "unless quartic is given; nu is the lattice's",
       any_number, "", true}};
  fields = fields + material + fields_of<Section>();
  return fields;
}

const std::vector<Field>& outline_field() {
  static const std::vector<Field> outline{
      {"outline", "points", "R",
       "corners { {x, y}, ... } in order along the boundary; the first may close it as the last; concave is fine, "
       "crossing itself is not"}};
  return outline;
}

// What a body takes beside its shape and its numbers.
std::vector<Field> common_fields() {
  return {
      {"holes", "outlines", "R", "outlines inside it, free of nodes, whose rims are as its own", any_number, "", true},
      {"points", "points", "R",
       "its nodes { {x, y}, ... } instead of nodes and placement: those on an outline, corners included, are all of "
       "its rim there; an outline without any is divided as usual",
       any_number, "", true},
      {"velocity", "numbers", "c", "{vx, vy} before the impact, in space as launch.speed is; of a free target",
       any_number, "", true},
      {"spin", "number", "c/R", "angular velocity before the impact, counter-clockwise; of a free target", any_number,
       "0"}};
}

Function shape(const char* name, const char* doc, const std::vector<Field>& own, const char* example) {
  const std::vector<Field> anchored{
      {"anchored", "function", "", "function (x, y) that is true where a node is held fixed", any_number, "", true}};
  return {.name = name,
          .doc = doc,
          .fields = own + number_fields() + anchored + common_fields(),
          .returns = "body",
          .example = example};
}

// Those that lua/ricochet/shapes.lua makes of a size.
std::vector<Function> sized_shapes() {
  const std::vector<Field> radius{{"radius", "number", "R", "radius", positive, "1"}};
  const std::vector<Field> axes{{"a", "number", "R", "half axis along x", positive, "1"},
                                {"b", "number", "R", "half axis along y", positive, "0.5"}};
  const std::vector<Field> sides{{"width", "number", "R", "extent along x, centred", positive, "2"},
                                 {"height", "number", "R", "extent along y, centred", positive, "1"}};
  const std::vector<Field> corners{{"sides", "integer", "", "how many sides, of equal length", {3, 1000}, "6"},
                                   {"radius", "number", "R", "of its corners from the centre", positive, "1"}};
  return {
      shape("disk", "A disk around the origin.", radius, "ricochet.disk { nodes = 800, roughness = 0.03, seed = 7 }"),
      shape("ellipse", "An ellipse around the origin.", axes,
            "ricochet.ellipse { a = 1.2, b = 0.8, nodes = 800, placement = \"poisson_disk\" }"),
      shape("rectangle", "A rectangle around the origin.", sides,
            "ricochet.rectangle { width = 2, height = 0.5, velocity = {0, 0.02}, spin = 0.01 }"),
      shape("regular_polygon",
            "A regular polygon around the origin that stands on a side. From 12 sides on its rim takes the corners "
            "for a curve, and may cut them.",
            corners, "ricochet.regular_polygon { sides = 3, radius = 1, nodes = 400 }")};
}

Function rotated_function() {
  return {.name = "rotated",
          .doc = "A body turned about the origin: the same nodes and springs, elsewhere. A plane is refused.",
          .fields = {{"body", "body", "", "what is turned; stays as it is"},
                     {"angle", "number", "degrees", "counter-clockwise"}},
          .returns = "body",
          .example = "ricochet.rotated { body = ricochet.rectangle {}, angle = 30 }"};
}

Function wall_function() {
  const std::vector<Field> extent{{"width", "number", "R", "extent along x, centred", positive, "8"},
                                  {"depth", "number", "R", "extent below y = 0", positive, "2"}};
  BodyNumbers of_wall;
  of_wall.nodes = 4000;
  return {.name = "wall",
          .doc = "A rectangular block whose top is y = 0, held at both sides and at the bottom.",
          .fields = extent + number_fields(of_wall) + common_fields(),
          .returns = "body",
          .example = "ricochet.wall { nodes = 4000, stiffness = 100, roughness = 0.03, seed = 7 }"};
}

Function plane_function() {
  return {.name = "plane",
          .doc =
              "The rigid half-plane y <= 0, as a target: a projectile's rim node at the height y has the "
              "energy V0 exp(-xi y). Nothing in it moves, so a scene costs the projectile alone.",
          .fields = {},
          .returns = "body",
          .example = "ricochet.plane {}",
          .call = guarded<plane>};
}

}  // namespace

Group body_functions() {
  Function of_outline = shape("body", "A random mass-spring lattice in a closed outline, or a rigid body.",
                              outline_field(), "ricochet.body { outline = { {0, 0}, {2, 0}, {1, 2} }, nodes = 300 }");
  of_outline.call = guarded<body<false>>;
  const Function polygon = shape(
      "polygon", "A body in a closed outline, such as one from a file; the same as ricochet.body.", outline_field(),
      "ricochet.polygon { outline = { {0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0} }, holes = { { {0.5, 0.5}, "
      "{1.5, 0.5}, {1, 1.5} } } }");
  return {.functions = std::vector{of_outline} + sized_shapes() +
                       std::vector{polygon, rotated_function(), wall_function(), plane_function()},
          .natives = {{"own_body", guarded<body<true>>}},
          .add = [](lua_State* L) { make_type(L, "ricochet.body", collect_object<BodyObject>); }};
}

}  // namespace ricochet
