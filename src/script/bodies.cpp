// ricochet.body, and the shapes that lua/ricochet/shapes.lua makes with it.

#include <algorithm>

#include "script/displays.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/read_body.hpp"
#include "script/reader.hpp"

namespace ricochet {
namespace {

template <bool ours>
int body(lua_State* L) {
  check_table(L, 1, function_named("body"), ours);
  std::shared_ptr<const Body> made;
  try {
    made = std::make_shared<const Body>(read_body(L));
  } catch (const FieldError& error) {
    throw_here(L, error);
  }
  const std::size_t bytes =
      (made->outline.size() + made->points.size()) * sizeof(Vec2) + made->anchored.size() / 8 +
      (made->node_stiffness.size() + made->node_density.size() + made->node_nu.size()) * sizeof(double);
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

// Numbers of a body, of which stiffness, density and nu may depend on the place.
std::vector<Field> number_fields(const BodyNumbers& defaults = {}) {
  std::vector<Field> fields = fields_of(defaults);
  const auto by_place = [&](const char* name, const char* doc) {
    const auto field = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
    field->type = "number|function";
    field->doc += doc;
  };
  by_place("stiffness", "; a function (x, y) gives that of a node, a spring takes the mean of its ends");
  by_place("density", "; a function (x, y) gives that at a node");
  by_place("E", "; a function (x, y) gives that of a node, an element takes the mean of its corners");
  by_place("nu", "; a function (x, y) gives that of a node, an element takes the mean of its corners");
  const std::vector<Field> material{
      {"material", "material", "",
       "what it is made of, instead of E and nu, or stiffness, and density and mass, for scenes in SI: elements have "
       "its E and nu; the spring constant of springs is E2/1.155 (triangular), E2/1.16 (poisson_disk) or E2/1.08 "
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
      {"fine_at", "numbers", "R",
       "{x, y} where the mesh by h_min is finest, before the body is turned; at the lowest point of the outline unless "
       "given",
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
  const std::vector<Field> round{{"radius", "number", "R", "radius", positive, "1"},
                                 {"height", "number", "R", "extent along its axis, centred", positive, "1"}};
  const std::vector<Field> corners{{"sides", "integer", "", "how many sides, of equal length", {3, 1000}, "6"},
                                   {"radius", "number", "R", "of its corners from the centre", positive, "1"}};
  return {
      shape("disk", "A disk around the origin.", radius, "ricochet.disk { nodes = 800, roughness = 0.03, seed = 7 }"),
      shape("ellipse", "An ellipse around the origin.", axes,
            "ricochet.ellipse { a = 1.2, b = 0.8, nodes = 800, placement = \"poisson_disk\" }"),
      shape("sphere",
            "A sphere around the origin: an axisymmetric body of elements, of the half at x >= 0 of its section. It "
            "moves along the axis x = 0. Unless nodes or h_min is given, its mesh has h_min = radius/50, at its lowest "
            "point.",
            radius, "ricochet.sphere { E = 1e4, nu = 0.3, h_min = 0.02 }"),
      shape("cylinder",
            "A cylinder around the origin that stands on its end: an axisymmetric body of elements, of the half at "
            "x >= 0 of its section. It moves along the axis x = 0.",
            round, "ricochet.cylinder { radius = 1, height = 4, E = 1e4, nu = 0.3, nodes = 400 }"),
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

Function half_space_function() {
  const std::vector<Field> extent{
      {"extent", "number", "R", "radius of the block, and its depth below y = 0", positive, "10"}};
  return {.name = "half_space",
          .doc =
              "A block of elements that stands for the half-space y <= 0 under an axisymmetric body: a cylinder below "
              "y = 0, whose mesh by h_min is finest in the middle of its top. One node of it is held, the deepest on "
              "the axis; beside ricochet.absorbing_edges waves leave through its side and its base. Let h_max resolve "
              "the waves, whose length is about the contact's time at their speed.",
          .fields = extent + number_fields() + common_fields(),
          .returns = "body",
          .example = "ricochet.half_space { extent = 8, E = 1e4, nu = 0.3, h_min = 0.03, h_max = 1 }"};
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
  Function of_outline =
      shape("body", "A body in a closed outline: a random lattice of springs, a mesh of elements, or rigid.",
            outline_field(), "ricochet.body { outline = { {0, 0}, {2, 0}, {1, 2} }, nodes = 300 }");
  of_outline.call = guarded<body<false>>;
  const Function polygon = shape(
      "polygon", "A body in a closed outline, such as one from a file; the same as ricochet.body.", outline_field(),
      "ricochet.polygon { outline = { {0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0} }, holes = { { {0.5, 0.5}, "
      "{1.5, 0.5}, {1, 1.5} } } }");
  return {
      .functions = std::vector{of_outline} + sized_shapes() +
                   std::vector{polygon, rotated_function(), wall_function(), half_space_function(), plane_function()},
      .natives = {{"own_body", guarded<body<true>>}},
      .add = [](lua_State* L) { make_type(L, "ricochet.body", collect_object<BodyObject>, guarded<body_shown>); }};
}

}  // namespace ricochet
