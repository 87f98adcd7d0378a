#include <fmt/format.h>

#include <cmath>

#include "store/h5md.hpp"
#include "store/hdf5.hpp"

namespace ricochet {
namespace {

// Whole numbers below a bound.
std::vector<int> indices(hid_t group, const char* name, std::size_t below) {
  std::vector<int> list;
  for (const double value : hdf5::read_numbers(group, name)) {
    if (!(value >= 0 && value < static_cast<double>(below) && value == std::floor(value)))
      throw FileError(fmt::format("{} holds {}, which numbers nothing", name, value));
    list.push_back(static_cast<int>(value));
  }
  return list;
}

template <std::size_t N>
std::vector<std::array<int, N>> tuples(const std::vector<int>& flat) {
  if (flat.size() % N != 0) throw FileError(fmt::format("{} numbers are no groups of {}", flat.size(), N));
  std::vector<std::array<int, N>> list(flat.size() / N);
  for (std::size_t i = 0; i < list.size() * N; ++i) list[i / N][i % N] = flat[i];
  return list;
}

void must_be(bool fits, const char* what) {
  if (!fits) throw FileError(fmt::format("the sizes of {} do not fit together", what));
}

/// Reads a ragged list number by number.
class Ragged {
 public:
  Ragged(std::vector<double> numbers, const char* what) : numbers_(std::move(numbers)), what_(what) {}
  bool ended() const { return next_ == numbers_.size(); }
  double number() {
    must_be(next_ < numbers_.size(), what_);
    return numbers_[next_++];
  }
  /// A whole number of 0 ... most.
  std::size_t whole(std::size_t most) {
    const double value = number();
    must_be(value >= 0 && value <= static_cast<double>(most) && value == std::floor(value), what_);
    return static_cast<std::size_t>(value);
  }

 private:
  std::vector<double> numbers_;
  const char* what_;
  std::size_t next_ = 0;
};

std::vector<BodyMesh> read_bodies(const hdf5::Handle& own, std::size_t nodes) {
  std::vector<BodyMesh> bodies;
  std::size_t known = 0;
  for (Ragged list(hdf5::read_numbers(own, "bodies"), "the bodies"); !list.ended();) {
    BodyMesh body;
    must_be(list.whole(nodes) == known, "the bodies");
    body.first = static_cast<int>(known);
    body.nodes = static_cast<int>(list.whole(nodes - known));
    for (std::size_t n = list.whole(16); n > 0; --n) body.law.push_back(list.number());
    must_be(body.nodes > 0, "the bodies");
    known += static_cast<std::size_t>(body.nodes);
    bodies.push_back(body);
  }
  must_be(known == nodes && bodies.size() >= 2, "the bodies");
  if (H5Lexists(own, "solid_laws", H5P_DEFAULT) > 0)
    for (Ragged list(hdf5::read_numbers(own, "solid_laws"), "the laws"); !list.ended();) {
      std::vector<double>& law = bodies[list.whole(bodies.size() - 1)].solid_law;
      must_be(list.whole(16) == 3, "the laws");
      law.push_back(static_cast<double>(list.whole(2)));
      for (int n = 0; n < 2; ++n) law.push_back(list.number());
    }
  if (H5Lexists(own, "axisymmetric", H5P_DEFAULT) > 0)
    for (Ragged list(hdf5::read_numbers(own, "axisymmetric"), "the axisymmetric bodies"); !list.ended();)
      bodies[list.whole(bodies.size() - 1)].axisymmetric = true;
  if (H5Lexists(own, "wave_speeds", H5P_DEFAULT) > 0) {
    const std::vector<double> speeds = hdf5::read_numbers(own, "wave_speeds");
    must_be(speeds.size() == 3 * bodies.size(), "the speeds of waves");
    for (std::size_t k = 0; k < speeds.size(); ++k) bodies[k / 3].wave_speeds[k % 3] = speeds[k];
  }
  for (Ragged list(hdf5::read_numbers(own, "chains"), "the chains"); !list.ended();) {
    BodyMesh& body = bodies[list.whole(bodies.size() - 1)];
    MeshChain chain{{}, list.whole(1) == 1};
    const std::size_t count = list.whole(nodes), least = chain.closed ? 3 : 2;
    must_be(count >= least, "the chains");
    for (std::size_t n = count; n > 0; --n) chain.node.push_back(static_cast<int>(list.whole(nodes - 1)));
    body.surface.push_back(chain);
  }
  for (const BodyMesh& body : bodies) must_be(!body.surface.empty(), "the chains");
  return bodies;
}

FrameMesh read_mesh(const hdf5::Handle& file) {
  const hdf5::Handle own = hdf5::open_group(file, "ricochet"), connectivity = hdf5::open_group(file, "connectivity");
  if (H5Lexists(own, "dimension", H5P_DEFAULT) <= 0)
    throw FileError("it was recorded by an older version, or another program; record it again");
  FrameMesh mesh;
  const std::vector<double> launch = hdf5::read_numbers(own, "launch");
  must_be(launch.size() == 1, "the launch");
  mesh.psi1 = launch[0];
  if (H5Lexists(own, "first_touch", H5P_DEFAULT) > 0) {
    const std::vector<double> touch = hdf5::read_numbers(own, "first_touch");
    must_be(touch.size() == 1, "the first touch");
    mesh.first_touch = touch[0];
  }
  if (H5Lexists(own, "effects", H5P_DEFAULT) > 0) mesh.effects = hdf5::read_texts(own, "effects");
  const std::vector<int> dim = indices(own, "dimension", 4);
  must_be(dim.size() == 1 && dim[0] >= 2, "the dimension");
  mesh.dim = dim[0];
  mesh.mass = hdf5::read_numbers(hdf5::open_group(hdf5::open_group(file, "particles"), "trajectory"), "mass");
  mesh.rest = hdf5::read_numbers(own, "rest");
  const std::size_t nodes = mesh.mass.size();
  must_be(nodes > 0 && mesh.rest.size() == nodes * static_cast<std::size_t>(mesh.dim), "the places at rest");
  mesh.bodies = read_bodies(own, nodes);
  for (const int held : indices(own, "anchored", 2)) mesh.anchored.push_back(held != 0);
  mesh.springs = tuples<2>(indices(connectivity, "springs", nodes));
  mesh.triangles = tuples<3>(indices(connectivity, "triangles", nodes));
  mesh.length = hdf5::read_numbers(own, "rest_length");
  mesh.stiffness = hdf5::read_numbers(own, "stiffness");
  must_be(mesh.anchored.size() == nodes && mesh.length.size() == mesh.springs.size() &&
              mesh.stiffness.size() == mesh.springs.size(),
          "nodes and springs");
  if (H5Lexists(own, "modulus", H5P_DEFAULT) > 0) {
    mesh.modulus = hdf5::read_numbers(own, "modulus");
    must_be(mesh.modulus.size() == mesh.triangles.size(), "triangles and their moduli");
    for (std::size_t t = 0; t < mesh.modulus.size(); ++t)
      must_be(mesh.modulus[t] == 0 ||
                  !mesh.bodies[static_cast<std::size_t>(mesh.body_of(mesh.triangles[t][0]))].solid_law.empty(),
              "triangles and their laws");
  }
  if (H5Lexists(own, "lame", H5P_DEFAULT) > 0) {
    mesh.lame = hdf5::read_numbers(own, "lame");
    must_be(mesh.lame.size() == 2 * mesh.modulus.size(), "triangles and Lame's constants");
  }
  return mesh;
}

// `count` numbers of every frame, if there are any.
void read_past(const hdf5::Handle& own, std::vector<Frame>& frames, const char* name, std::vector<float> Frame::*member,
               std::size_t count, const char* what) {
  if (H5Lexists(own, name, H5P_DEFAULT) <= 0) return;
  const std::vector<float> values = hdf5::read_floats(own, name);
  must_be(values.size() == frames.size() * count, what);
  for (std::size_t k = 0; k < frames.size(); ++k)
    (frames[k].*member)
        .assign(values.begin() + static_cast<std::ptrdiff_t>(k * count),
                values.begin() + static_cast<std::ptrdiff_t>((k + 1) * count));
}

std::vector<Frame> read_frames(const hdf5::Handle& file, const FrameMesh& mesh) {
  const hdf5::Handle particles = hdf5::open_group(file, "particles"), all = hdf5::open_group(particles, "trajectory"),
                     own = hdf5::open_group(file, "ricochet");
  const hdf5::Handle position = hdf5::open_group(all, "position"), velocity = hdf5::open_group(all, "velocity"),
                     observed = hdf5::open_group(file, "observables");
  const std::vector<double> time = hdf5::read_numbers(position, "time"), step = hdf5::read_numbers(position, "step");
  std::vector<Frame> frames(time.size());
  const std::size_t nodes = mesh.mass.size();
  const std::ptrdiff_t dim = mesh.dim;
  must_be(step.size() == time.size(), "times and steps");
  for (std::size_t k = 0; k < frames.size(); ++k) {
    frames[k].time = time[k];
    frames[k].step = static_cast<std::int64_t>(step[k]);
  }
  const auto spread = [&](const std::vector<float>& values, std::vector<float> Frame::*member) {
    must_be(values.size() == frames.size() * nodes * 3, "frames and nodes");
    auto value = values.begin();
    for (Frame& frame : frames)
      for (std::size_t i = 0; i < nodes; ++i, value += 3)
        (frame.*member).insert((frame.*member).end(), value, value + dim);
  };
  spread(hdf5::read_floats(position, "value"), &Frame::position);
  spread(hdf5::read_floats(velocity, "value"), &Frame::velocity);
  spread(hdf5::read_floats(own, "contact_force"), &Frame::contact_force);
  for (std::size_t e = 0; e < frame_energies.size(); ++e) {
    const hdf5::Handle element = hdf5::open_group(observed, frame_energies[e]);
    const std::vector<double> values = hdf5::read_numbers(element, "value");
    must_be(values.size() == frames.size(), "frames and energies");
    for (std::size_t k = 0; k < frames.size(); ++k) frames[k].energy[e] = values[k];
  }
  read_past(own, frames, "elongation", &Frame::elongation, mesh.springs.size(), "frames and springs");
  read_past(own, frames, "plastic", &Frame::plastic, 5 * mesh.triangles.size(), "frames and triangles");
  return frames;
}

}  // namespace

Trajectory read_trajectory(const std::filesystem::path& path) {
  const hdf5::Handle file = hdf5::open_file(path);
  if (H5Lexists(file, "h5md", H5P_DEFAULT) <= 0)
    throw FileError(fmt::format("{} holds no trajectory (ricochet.record writes one)", path.string()));
  try {
    Trajectory trajectory(read_mesh(file));
    for (Frame& frame : read_frames(file, trajectory.mesh())) trajectory.add(std::move(frame));
    return trajectory;
  } catch (const FileError& error) {
    throw FileError(fmt::format("{} is no trajectory that this version can draw: {}; record it again", path.string(),
                                error.what()));
  }
}

bool is_trajectory(const std::filesystem::path& path) {
  return H5Lexists(hdf5::open_with_additions(path).file, "h5md", H5P_DEFAULT) > 0;
}

}  // namespace ricochet
