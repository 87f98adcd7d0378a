#include "render/fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

namespace ricochet::render {
namespace {

double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) { return std::abs(cross(b - a, c - a)); }

std::array<int, 2> nodes_of(const FrameMesh& mesh, int body) {
  const BodyMesh& of = mesh.bodies[static_cast<std::size_t>(body)];
  return {of.first, of.first + of.nodes};
}

// The mean of both principal stretches, less 1: (s1 + s2)^2 = |F|^2 + 2 J.
double mean_stretch(const Tensor<double>& F) {
  const double squares = F.xx * F.xx + F.xy * F.xy + F.yx * F.yx + F.yy * F.yy, J = F.xx * F.yy - F.xy * F.yx;
  return std::sqrt(std::max(0.0, squares + 2 * J)) / 2 - 1;
}

// The mean of all three.
double mean_stretch(const AxialTensor<double>& F) { return (2 * mean_stretch(F.plane) + F.zz - 1) / 3; }

// Of a triangle; 0 where nothing yields.
double plastic_strain(const Frame& frame, std::size_t triangle) {
  return frame.plastic.empty() ? 0 : static_cast<double>(frame.plastic[5 * triangle + 4]);
}

// An element that has flowed, as it stands, asked as the elastic laws are.
class Flowed {
 public:
  Flowed(const SolidLawNumbers& numbers, double E, const float* plastic) {
    constexpr double never = 1e300;  // it has done so by now
    law_ = {one(numbers.lame.lambda * E), one(numbers.lame.mu * E), never, 0};
    for (Lane<1>* number : {&memory_.xx, &memory_.xy, &memory_.yy, &memory_.zz, &memory_.strain})
      *number = one(static_cast<double>(*plastic++));
  }

  double energy(const AxialTensor<double>& F) const { return law_.energy(lanes(F), memory_)[0]; }
  AxialTensor<double> stress(const AxialTensor<double>& F) const {
    PlasticMemory<1> memory = memory_;
    Lane<1> lost = one(0);
    const AxialTensor<Lane<1>> P = law_.stress(lanes(F), memory, lost);
    return {{P.plane.xx[0], P.plane.xy[0], P.plane.yx[0], P.plane.yy[0]}, P.zz[0]};
  }
  double energy(const Tensor<double>& F) const { return energy(AxialTensor<double>(F, 1.0)); }
  Tensor<double> stress(const Tensor<double>& F) const { return stress(AxialTensor<double>(F, 1.0)).plane; }

 private:
  static Lane<1> one(double value) { return Lane<1>::Constant(value); }
  static AxialTensor<Lane<1>> lanes(const AxialTensor<double>& F) {
    return {{one(F.plane.xx), one(F.plane.xy), one(F.plane.yx), one(F.plane.yy)}, one(F.zz)};
  }

  HenckyFlow<1> law_;
  PlasticMemory<1> memory_;
};

}  // namespace

Motion motion_of(const FrameMesh& mesh, const Frame& frame, int body) {
  const auto [first, last] = nodes_of(mesh, body);
  Motion motion;
  bool held = false;
  double whole = 0;
  for (int i = first; i < last; ++i) {
    const double mass = mesh.mass[static_cast<std::size_t>(i)];
    motion.rest_centre += mass * seen(mesh, mesh.rest, i);
    motion.centre += mass * seen(mesh, frame.position, i);
    motion.velocity += mass * seen(mesh, frame.velocity, i);
    whole += mass;
    held = held || mesh.anchored[i];
  }
  motion.rest_centre /= whole;
  motion.centre /= whole;
  motion.velocity /= whole;
  if (held) {
    motion.centre = motion.rest_centre;
    motion.velocity.setZero();
    return motion;
  }
  double along = 0, across = 0, moment = 0, inertia = 0;
  for (int i = first; i < last; ++i) {
    const double mass = mesh.mass[static_cast<std::size_t>(i)];
    const Vec2 then = seen(mesh, mesh.rest, i) - motion.rest_centre,
               now = seen(mesh, frame.position, i) - motion.centre;
    along += mass * then.dot(now);
    across += mass * cross(then, now);
    moment += mass * cross(now, seen(mesh, frame.velocity, i) - motion.velocity);
    inertia += mass * then.squaredNorm();
  }
  motion.angle = std::atan2(across, along);
  motion.spin = moment / inertia;
  return motion;
}

std::array<double, 7> ledger_parts(const FrameMesh& mesh, const Frame& frame) {
  const std::array<double, 8>& e = frame.energy;
  const Vec2 v = motion_of(mesh, frame, 0).velocity;
  const double normal = v.squaredNorm() > 0 ? e[0] * v.y() * v.y() / v.squaredNorm() : 0;
  return {normal,
          e[0] - normal,
          e[1],
          e[2],
          e[3] + e[4] + e[5],
          e[6],
          e[7] - (e[0] + e[1] + e[2] + e[3] + e[4] + e[5] + e[6])};
}

namespace {

template <class Use>
void each_surface_node(const BodyMesh& body, Use&& use) {
  for (const MeshChain& chain : body.surface)
    for (const int node : chain.node) use(node);
}

// The surface node of a body that is nearest to a place; of an open chain, the nearest place on it.
Vec2 nearest_place(const FrameMesh& mesh, const BodyMesh& body, const Frame& frame, const Vec2& place) {
  double nearest = std::numeric_limits<double>::infinity();
  Vec2 found = place;
  const auto consider = [&](const Vec2& other) {
    const double d = (other - place).norm();
    if (!(d < nearest)) return;
    nearest = d;
    found = other;
  };
  each_surface_node(body, [&](int node) { consider(seen(mesh, frame.position, node)); });
  for (const MeshChain& chain : body.surface)
    for (std::size_t k = 0; k + 1 < chain.node.size() && !chain.closed; ++k) {
      const Vec2 a = seen(mesh, frame.position, chain.node[k]),
                 edge = seen(mesh, frame.position, chain.node[k + 1]) - a;
      consider(a + std::clamp((place - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0) * edge);
    }
  return found;
}

}  // namespace

Vec2 contact_place(const FrameMesh& mesh, const Frame& frame) {
  constexpr double range = 0.1;  // [R] nodes so much farther than the nearest weigh 1/e
  std::vector<std::pair<double, Vec2>> gaps;
  double least = std::numeric_limits<double>::infinity();
  each_surface_node(mesh.bodies[0], [&](int node) {
    const Vec2 place = seen(mesh, frame.position, node), other = nearest_place(mesh, mesh.bodies[1], frame, place);
    const double gap = (other - place).norm();
    gaps.emplace_back(gap, (place + other) / 2);
    least = std::min(least, gap);
  });
  Vec2 sum = Vec2::Zero();
  double weights = 0;
  for (const auto& [gap, middle] : gaps) {
    const double weight = std::exp((least - gap) / range);
    sum += weight * middle;
    weights += weight;
  }
  return sum / weights;
}

double plotted_value(const std::string& name, const FrameMesh& mesh, const Frame& frame) {
  if (name == "force_n" || name == "force_t") {
    Vec2 sum = Vec2::Zero();
    for (int i = 0; i < mesh.bodies.front().nodes; ++i) sum += seen(mesh, frame.contact_force, i);
    return name == "force_n" ? sum.y() : sum.x();
  }
  if (name == "vibration") return frame.energy[2] + frame.energy[5];
  const Motion motion = motion_of(mesh, frame, 0);
  if (name == "vn") return motion.velocity.y();
  if (name == "vt") return motion.velocity.x();
  if (name == "omega") return motion.spin;
  if (name == "height") return motion.centre.y();
  throw std::logic_error("no plot shows " + name);
}

Fields::Fields(const FrameMesh& mesh)
    : mesh_(mesh), shared_by_(mesh.springs.size(), 0.0), rest_area_(mesh.mass.size(), 0.0) {
  for (const BodyMesh& body : mesh.bodies) {
    laws_.push_back(law_of(body.law));
    solid_laws_.push_back(body.solid_law.empty() ? SolidLawNumbers{} : solid_law_of(body.solid_law));
  }
  const auto key = [](int a, int b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
  };
  std::unordered_map<std::uint64_t, int> spring;
  for (std::size_t s = 0; s < mesh.springs.size(); ++s) {
    spring[key(mesh.springs[s][0], mesh.springs[s][1])] = static_cast<int>(s);
    mean_length_ += mesh.length[s] / static_cast<double>(mesh.springs.size());
  }
  for (const auto& t : mesh.triangles) {
    std::array<int, 3> sides{};
    for (int corner = 0; corner < 3; ++corner) {
      const auto found = spring.find(key(t[(corner + 1) % 3], t[(corner + 2) % 3]));
      sides[corner] = found == spring.end() ? -1 : found->second;
      if (sides[corner] >= 0) ++shared_by_[sides[corner]];
      rest_area_[t[corner]] +=
          twice_area(seen(mesh, mesh.rest, t[0]), seen(mesh, mesh.rest, t[1]), seen(mesh, mesh.rest, t[2])) / 2;
    }
    sides_.push_back(sides);
    for (std::size_t corner = 0; corner < 3 && mesh.springs.empty(); ++corner)
      mean_length_ += (seen(mesh, mesh.rest, t[corner]) - seen(mesh, mesh.rest, t[(corner + 1) % 3])).norm() /
                      (3 * static_cast<double>(mesh.triangles.size()));
  }
}

// That of its body, with constants of its own where they depend on the place.
SolidLawNumbers Fields::solid_law_of_triangle(std::size_t triangle) const {
  SolidLawNumbers law = solid_laws_[static_cast<std::size_t>(mesh_.body_of(mesh_.triangles[triangle][0]))];
  if (!mesh_.lame.empty() && mesh_.lame[2 * triangle + 1] != 0)
    law.lame = {mesh_.lame[2 * triangle], mesh_.lame[2 * triangle + 1]};
  return law;
}

// Calls `use(t, law, F, area)` for every triangle that is an element: its deformation gradient, in space where it is of
// a body of revolution, and its area at rest.
template <class Use>
void Fields::each_element(const Frame& frame, Use&& use) const {
  for (std::size_t t = 0; t < mesh_.modulus.size(); ++t) {
    if (mesh_.modulus[t] == 0) continue;
    const int i = mesh_.triangles[t][0], j = mesh_.triangles[t][1], k = mesh_.triangles[t][2];
    const auto edges = [&](const auto& places) {
      const Vec2 from = seen(mesh_, places, i);
      Eigen::Matrix2d d;
      d.col(0) = seen(mesh_, places, j) - from;
      d.col(1) = seen(mesh_, places, k) - from;
      return d;
    };
    const auto radii = [&](const auto& places) {
      return seen(mesh_, places, i).x() + seen(mesh_, places, j).x() + seen(mesh_, places, k).x();
    };
    const Eigen::Matrix2d rest = edges(mesh_.rest), F = edges(frame.position) * rest.inverse();
    const Tensor<double> plane(F(0, 0), F(0, 1), F(1, 0), F(1, 1));
    const double area = std::abs(rest.determinant()) / 2;
    const auto with_law = [&](const auto& law, bool revolved) {
      if (revolved)
        use(t, law, AxialTensor<double>(plane, radii(frame.position) / radii(mesh_.rest)), area);
      else
        use(t, law, plane, area);
    };
    const bool revolved = mesh_.bodies[static_cast<std::size_t>(mesh_.body_of(i))].axisymmetric;
    const SolidLawNumbers own = solid_law_of_triangle(t);
    if (plastic_strain(frame, t) > 0)
      with_law(Flowed(own, mesh_.modulus[t], &frame.plastic[5 * t]), revolved);
    else
      with_solid_law(own, mesh_.modulus[t], [&](const auto& law) { with_law(law, revolved); });
  }
}

double Fields::elongation(const Frame& frame, std::size_t spring, double distance) const {
  return frame.elongation.empty() ? distance - mesh_.length[spring] : frame.elongation[spring];
}

std::vector<double> Fields::of_springs(const std::string& name, const Frame& frame) const {
  const bool tension = name == "tension", energy = name == "energy";
  std::vector<double> values(mesh_.springs.size());
  for (std::size_t s = 0; s < values.size(); ++s) {
    const auto& ends = mesh_.springs[s];
    const double x =
        elongation(frame, s, (seen(mesh_, frame.position, ends[1]) - seen(mesh_, frame.position, ends[0])).norm());
    const double ka = mesh_.stiffness[s];
    values[s] = with_spring_law(laws_[static_cast<std::size_t>(mesh_.body_of(ends[0]))], [&](const auto& law) {
      return tension ? ka * law.tension(x) : energy ? ka * law.energy(x) : x / mesh_.length[s];
    });
  }
  return values;
}

std::vector<double> Fields::stress(const Frame& frame, bool pressure) const {
  const std::vector<double> tension = of_springs("tension", frame);
  std::vector<MeanStress> sums(mesh_.mass.size());
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const auto& corners = mesh_.triangles[t];
    MeanStress tensor;
    for (const int s : sides_[t]) {
      if (s < 0 || std::isnan(tension[s])) continue;
      const Vec2 r =
          seen(mesh_, frame.position, mesh_.springs[s][1]) - seen(mesh_, frame.position, mesh_.springs[s][0]);
      const double length = r.norm(), weight = length > 0 ? tension[s] / (length * shared_by_[s]) : 0;
      tensor.xx += weight * r.x() * r.x();
      tensor.xy += weight * r.x() * r.y();
      tensor.yy += weight * r.y() * r.y();
    }
    tensor.area = twice_area(seen(mesh_, frame.position, corners[0]), seen(mesh_, frame.position, corners[1]),
                             seen(mesh_, frame.position, corners[2])) /
                  2;
    for (const int i : corners) {
      sums[i].xx += tensor.xx;
      sums[i].xy += tensor.xy;
      sums[i].yy += tensor.yy;
      sums[i].area += tensor.area;
    }
  }
  each_element(frame, [&]<class Gradient>(std::size_t t, const auto& law, const Gradient& F, double area) {
    const Gradient P = law.stress(F);
    for (const int i : mesh_.triangles[t]) sums[i].add(P, F, area);
  });
  std::vector<double> values;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const bool space = mesh_.bodies[static_cast<std::size_t>(mesh_.body_of(static_cast<int>(i)))].axisymmetric;
    values.push_back(pressure ? sums[i].pressure(space) : sums[i].von_mises());
  }
  return values;
}

std::vector<double> Fields::plastic_strains(const Frame& frame) const {
  std::vector<double> values(mesh_.mass.size(), 0.0), triangles(mesh_.mass.size(), 0.0);
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    for (const int i : mesh_.triangles[t]) {
      values[i] += plastic_strain(frame, t);
      triangles[i] += 1;
    }
  for (std::size_t i = 0; i < values.size(); ++i)
    if (triangles[i] > 0) values[i] /= triangles[i];
  return values;
}

std::vector<double> Fields::of_material(const std::string& name, const Frame& frame) const {
  if (name == "pressure" || name == "von_mises") return stress(frame, name == "pressure");
  std::vector<double> values(mesh_.mass.size(), 0.0);
  if (name == "plastic_strain") return plastic_strains(frame);
  if (name == "energy_density" || name == "stretch") {
    const bool energy = name == "energy_density";
    const std::vector<double> springs = of_springs(energy ? "energy" : "stretch", frame);
    std::vector<double> weight(mesh_.mass.size(), 0.0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const int s : sides_[t]) {
        if (s < 0 || std::isnan(springs[s])) continue;
        for (const int i : mesh_.triangles[t]) {
          values[i] += springs[s] / (energy ? shared_by_[s] : 1);
          weight[i] += 1;
        }
      }
    each_element(frame, [&](std::size_t t, const auto& law, const auto& F, double area) {
      for (const int i : mesh_.triangles[t]) {
        values[i] += energy ? area * law.energy(F) : mean_stretch(F);
        weight[i] += 1;
      }
    });
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double over = energy ? rest_area_[i] : weight[i];
      if (over > 0) values[i] /= over;
    }
    return values;
  }
  const bool x = name == "velocity_x", y = name == "velocity_y";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Eigen::Vector2f v = seen(mesh_, frame.velocity, static_cast<int>(i)).cast<float>();
    values[i] = x ? v.x() : y ? v.y() : std::hypot(v.x(), v.y());
  }
  return values;
}

}  // namespace ricochet::render
