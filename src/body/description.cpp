#include "body/description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/hash.hpp"
#include "material/solid_law.hpp"

namespace ricochet {
namespace {

// Members of what BodyNumbers inherits are members of it.
template <class Base>
std::vector<Member<BodyNumbers>> inherited() {
  std::vector<Member<BodyNumbers>> members;
  for (const Member<Base>& member : Base::fields())
    std::visit(
        [&]<class Value>(Value Base::*where) {
          members.push_back({member.field, static_cast<Value BodyNumbers::*>(where)});
        },
        member.place);
  return members;
}

// The first number always; what laws came to know later only where it says something, so that older texts stay.
std::string text_of_law(const SpringLawNumbers& law) {
  const SpringLawNumbers usual;
  std::string text;
  for (const auto& member : SpringLawNumbers::fields())
    std::visit(
        [&](auto where) {
          if (text.empty() || law.*where != usual.*where) text += fmt::format(" {} {}", member.field.name, law.*where);
        },
        member.place);
  return text;
}

// Of a body of elements, how they lie.
std::vector<Member<ElementNumbers>> mesh_fields() {
  return {
      {{"h_min", "number", "R",
        "of elements: the side of the smallest triangles, instead of nodes and placement; a mesh is as fine around "
        "fine_at, and coarser farther away",
        positive, "", true},
       &ElementNumbers::h_min},
      {{"h_max", "number", "R", "the side of the largest triangles of such a mesh; 8 h_min unless given", positive, "",
        true},
       &ElementNumbers::h_max},
      {{"grade", "number", "", "by how much the sides of such a mesh grow for every unit of length", {0, 1}, "0.15"},
       &ElementNumbers::grade},
      {{"fine_within", "number", "R", "how far from fine_at such a mesh is as fine as h_min; 10 h_min unless given",
        not_negative, "", true},
       &ElementNumbers::fine_within},
      {{"mesh",
        "string",
        "",
        "how the triangles of such a mesh lie: delaunay, in any outline; crossed, four in each cell of a "
        "rectangle with sides along x and y, which do not lock where metal flows far",
        any_number,
        "delaunay",
        false,
        {"delaunay", "crossed"}},
       &ElementNumbers::mesh},
  };
}

}  // namespace

const std::vector<Member<ElementNumbers>>& ElementNumbers::fields() {
  static const std::vector<Member<ElementNumbers>> list = [] {
    std::vector<Member<ElementNumbers>> all{
        {{"E", "number", "m0 c^2/R^2",
          "of elements: Young's modulus, a force per length in the plane; of an axisymmetric body a pressure, in m0 "
          "c^2/R^3",
          positive, "", true},
         &ElementNumbers::E},
        {{"nu", "number", "", "of elements: Poisson's ratio", {-1, 0.5, true, true}, "", true}, &ElementNumbers::nu},
        {{"state",
          "string",
          "",
          "of elements, or of a body of a material: plane_stress, a sheet that is free to bulge; plane_strain, a long "
          "cylinder; axisymmetric, of elements alone: a body of revolution, whose outline is the half at x >= 0 of its "
          "section through the axis x = 0, along which it moves",
          any_number,
          "plane_stress",
          false,
          {"plane_stress", "plane_strain", "axisymmetric"}},
         &ElementNumbers::state},
        {{"law", "string", "",
          "of elements: polynomial, for any strain and rotation; linear, of small strains, which takes a rotation "
          "for a strain; st_venant_kirchhoff, which softens in compression",
          any_number, "polynomial", false, solid_law_names()},
         &ElementNumbers::law},
    };
    const std::vector<Member<ElementNumbers>> of_mesh = mesh_fields();
    all.insert(all.end(), of_mesh.begin(), of_mesh.end());
    return all;
  }();
  return list;
}

const std::vector<Member<BodyNumbers>>& BodyNumbers::fields() {
  static const std::vector<Member<BodyNumbers>> list = [] {
    std::vector<Member<BodyNumbers>> of_body{
        {{"nodes", "integer", "", "number of mass points, those on the outline included", {4, 1e7}, "800"},
         &BodyNumbers::nodes},
        {{"placement",
          "string",
          "",
          "how the interior nodes are placed; uniform, at independent random points, leaves voids, light nodes beside "
          "narrow triangles, and folds early; hull: all nodes are such points, and the rim is their convex hull, "
          "coarse and uneven (about 3.4 nodes^(1/3) nodes of a disk), of a convex outline without holes",
          any_number,
          "poisson_disk",
          false,
          {"uniform", "poisson_disk", "triangular", "hull"}},
         &BodyNumbers::placement},
        {{"seed", "integer", "", "chooses the random lattice", {0, 9007199254740992.0}, "1"}, &BodyNumbers::seed},
        {{"stiffness", "number", "m0 c^2/R^2", "spring constant ka of T = ka x + kb x^3", positive, "10000"},
         &BodyNumbers::stiffness},
        {{"density", "number", "m0/R^2",
          "mass of the area: a node weighs a third of each triangle at it; default 800/pi, of which 800 nodes in a "
          "disk weigh m0 each on average, unless mass is given; of an axisymmetric body that of the volume, in m0/R^3",
          positive, "", true},
         &BodyNumbers::density},
        {{"mass", "number", "m0", "mass of every node alike, whatever area is its own; instead of density", positive,
          "", true},
         &BodyNumbers::mass},
        {{"roughness", "number", "R",
          "standard deviation of the rim along its outward normal; anchored rim nodes stay smooth", not_negative, "0"},
         &BodyNumbers::roughness},
        {{"rim_spacing", "number", "R",
          "distance of neighbours on the rim; that of the lattice, sqrt(area / nodes), unless given", positive, "",
          true},
         &BodyNumbers::rim_spacing},
        {{"margin", "number", "R",
          "least distance of interior nodes from the rim's edges; Poisson disks keep theirs from its nodes in any case",
          not_negative, "0"},
         &BodyNumbers::margin},
        {{"triangulation",
          "string",
          "",
          "which of Delaunay's triangles are joined by springs: clipped, those inside the rim; plain, all, so that "
          "springs across the valleys of a rough rim stay, and their area counts, of a convex outline without holes",
          any_number,
          "clipped",
          false,
          {"clipped", "plain"}},
         &BodyNumbers::triangulation},
        {{"crossing",
          "string",
          "",
          "what if the rough rim crosses itself: refuse the body; pass_over, take the next lattice of its seed, whose "
          "numbers are others; what runs then tells how many were passed over",
          any_number,
          "refuse",
          false,
          {"refuse", "pass_over"}},
         &BodyNumbers::crossing},
        {{"angle", "number", "degrees",
          "by which the finished body is turned about the origin, counter-clockwise; places in other fields are those "
          "before it",
          any_number, "0"},
         &BodyNumbers::angle},
        {{"prestress",
          "number",
          "",
          "standard deviation of the springs' rest lengths over their own; the lattice is relaxed to where they "
          "balance",
          {0, 0.3},
          "0"},
         &BodyNumbers::prestress},
        {{"interior",
          "string",
          "",
          "what holds it together: springs between its nodes; elements, triangles of an elastic material; modes: its "
          "slowest free vibrations alone, in a frame that flies and turns, for small strains; rigid: nothing moves "
          "inside, for a target",
          any_number,
          "springs",
          false,
          {"springs", "elements", "modes", "rigid"}},
         &BodyNumbers::interior},
        {{"modes",
          "integer",
          "",
          "of interior modes: how many, the slowest first; 0: all, up to 2000, which rebound as what they are of. "
          "Fewer take less time, and need a softer contact: a rim of few modes cannot yield to a hard one, and "
          "chatters",
          {0, 1e5},
          "0"},
         &BodyNumbers::modes},
        {{"modes_of",
          "string",
          "",
          "of interior modes: what the vibrations are of",
          any_number,
          "elements",
          false,
          {"springs", "elements"}},
         &BodyNumbers::modes_of},
    };
    const auto after_stiffness =
        std::find_if(of_body.begin(), of_body.end(), [](const auto& member) { return member.field.name == "density"; });
    const std::vector<Member<BodyNumbers>> of_law = inherited<SpringLawNumbers>(),
                                           of_elements = inherited<ElementNumbers>();
    of_body.insert(after_stiffness, of_law.begin(), of_law.end());
    of_body.insert(of_body.end(), of_elements.begin(), of_elements.end());
    return of_body;
  }();
  return list;
}

namespace {

std::string text_of(const Points& points) {
  std::string text;
  for (const Vec2& p : points) text += fmt::format("{} {};", p.x(), p.y());
  return text;
}

// What bodies came to have later, only where it says something, so that older texts stay.
std::string text_of_shape(const Body& body) {
  const BodyNumbers& n = body.numbers;
  std::string text, holes;
  for (const Points& hole : body.holes) holes += text_of(hole) + "/";
  if (!holes.empty()) text += " holes " + hash_text(holes);
  if (!body.points.empty()) text += " points " + hash_text(text_of(body.points));
  for (const std::string& file : body.files) text += " file " + file;
  if (n.rim_spacing == n.rim_spacing) text += fmt::format(" rim_spacing {}", n.rim_spacing);
  if (n.margin != 0) text += fmt::format(" margin {}", n.margin);
  if (n.meshed()) {
    const SizeField size = body.size_field();
    text +=
        fmt::format(" mesh {} {} {} at {} {}", size.least, size.most, size.grade, size.fine_at.x(), size.fine_at.y());
    if (!std::isnan(n.fine_within)) text += fmt::format(" within {}", n.fine_within);
    if (n.crossed()) text += " crossed";
  }
  std::string nu_text;
  for (const double nu : body.node_nu) nu_text += fmt::format("{};", nu);
  if (!nu_text.empty()) text += " nus " + hash_text(nu_text);
  if (n.plain()) text += " plain";
  if (body.passed_over > 0) text += fmt::format(" passed_over {}", body.passed_over);
  if (n.angle != 0) text += fmt::format(" angle {}", n.angle);
  return text;
}

}  // namespace

std::string body_name(std::size_t body) {
  static const char* names[] = {"projectile", "target"};
  return body < std::size(names) ? names[body] : fmt::format("body {}", body + 1);
}

double BodyNumbers::area_density() const {
  return !std::isnan(mass) ? not_given : std::isnan(density) ? usual_density : density;
}

SizeField Body::size_field() const {
  const auto lowest =
      std::min_element(outline.begin(), outline.end(), [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
  const double least = numbers.h_min, most = std::isnan(numbers.h_max) ? 8 * least : numbers.h_max;
  const double within = std::isnan(numbers.fine_within) ? 10 * least : numbers.fine_within;
  return {least, std::max(least, most), numbers.grade, fine_at.value_or(*lowest), within};
}

std::string Body::geometry_text() const {
  if (plane)
    return fmt::format("plane {} {} {} {}", plane->normal.x(), plane->normal.y(), plane->normal.z(), plane->offset);
  std::string anchor_text, stiffness_text, density_text;
  const std::string outline_text = text_of(outline), shape = text_of_shape(*this);
  for (const bool held : anchored) anchor_text += held ? '1' : '0';
  if (rigid())
    return fmt::format("rigid outline {} anchored {} nodes {} seed {} roughness {}{}", hash_text(outline_text),
                       hash_text(anchor_text), numbers.nodes, numbers.seed, numbers.roughness, shape);
  for (const double k : node_stiffness) stiffness_text += fmt::format("{};", k);
  for (const double density : node_density) density_text += fmt::format("{};", density);
  const std::string modes =
      numbers.of_modes() ? fmt::format("modes {} of ", numbers.modes == 0 ? "all" : fmt::format("{}", numbers.modes))
                         : "";
  const std::string weight = !std::isnan(numbers.mass) ? fmt::format("mass {}", numbers.mass)
                             : node_density.empty()    ? fmt::format("density {}", numbers.area_density())
                                                       : fmt::format("densities {}", hash_text(density_text));
  if (numbers.of_elements())
    return modes + fmt::format(
                       "elements nu {} state {} law {} outline {} anchored {} E {} nodes {} placement {} seed {} "
                       "roughness {} {}{}",
                       numbers.nu, numbers.state, numbers.law, hash_text(outline_text), hash_text(anchor_text),
                       hash_text(stiffness_text), numbers.nodes, numbers.placement, numbers.seed, numbers.roughness,
                       weight, shape);
  return modes +
         fmt::format(
             "outline {} anchored {} stiffness {} nodes {} placement {} seed {} roughness {}{} {} prestress {}{}",
             hash_text(outline_text), hash_text(anchor_text), hash_text(stiffness_text), numbers.nodes,
             numbers.placement, numbers.seed, numbers.roughness, text_of_law(numbers), weight, numbers.prestress,
             shape);
}

}  // namespace ricochet
