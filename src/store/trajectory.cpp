#include "store/trajectory.hpp"

#include <fmt/format.h>

#include <cmath>

#include "store/files.hpp"
#include "store/hdf5.hpp"

namespace ricochet {
namespace {

using Shape = std::vector<hsize_t>;

void int_attribute(hid_t object, const char* name, const std::vector<int>& values) {
  const hsize_t shape[] = {values.size()};
  const hdf5::Handle space(values.size() == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, shape, nullptr), H5Sclose,
                           "make a shape");
  const hdf5::Handle attr(H5Acreate2(object, name, H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                          "make an attribute");
  H5Awrite(attr, H5T_NATIVE_INT, values.data());
}

// H5MD asks for variable-length strings here, and MDAnalysis reads no others.
hdf5::Handle variable_text() {
  hdf5::Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "copy a type");
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

void variable_text_attribute(hid_t object, const char* name, const std::vector<const char*>& values, bool scalar) {
  const hdf5::Handle type = variable_text();
  const hsize_t shape[] = {values.size()};
  const hdf5::Handle space(scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, shape, nullptr), H5Sclose,
                           "make a shape");
  const hdf5::Handle attr(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                          "make an attribute");
  H5Awrite(attr, type, values.data());
}

void hard_link(hid_t from, const char* name, hid_t to, const char* new_name) {
  H5Lcreate_hard(from, name, to, new_name, H5P_DEFAULT, H5P_DEFAULT);
}

// The same member of every frame, one after another: [frame][node][3].
std::vector<float> gathered(const std::vector<Frame>& frames, std::vector<Eigen::Vector2f> Frame::*member) {
  std::vector<float> values;
  for (const Frame& frame : frames)
    for (const Eigen::Vector2f& v : frame.*member) values.insert(values.end(), {v.x(), v.y(), 0.0f});
  return values;
}

std::string energy_doc(const std::string& name) {
  if (name == "contact") return "contact energy";
  if (name == "total") return "total energy";
  const bool projectile = name.starts_with("projectile");
  const std::string kind = name.substr(name.find('_') + 1), body = projectile ? "projectile" : "target",
                    still = projectile ? "" : " (0 if anchored)";
  return kind == "translation" ? "energy of the " + body + "'s centre of mass" + still
         : kind == "rotation"  ? "energy of the " + body + "'s spin" + still
                               : "energy of the " + body + "'s vibration";
}

// What pictures need beyond H5MD.
void write_drawing(const hdf5::Handle& file, const FrameMesh& mesh, const std::vector<Frame>& frames) {
  const hdf5::Handle own = hdf5::group(file, "ricochet");
  hdf5::numbers(own, "launch", std::vector<double>{mesh.psi1});
  hdf5::numbers(own, "bodies",
                std::vector<double>{static_cast<double>(mesh.projectile_nodes), mesh.mass[0], mesh.mass[1],
                                    mesh.quartic[0], mesh.quartic[1]});
  std::vector<double> rest, anchored;
  for (const Vec2& p : mesh.rest) rest.insert(rest.end(), {p.x(), p.y()});
  for (const bool held : mesh.anchored) anchored.push_back(held);
  hdf5::numbers(own, "rest", rest);
  hdf5::numbers(own, "anchored", anchored);
  hdf5::numbers(own, "rest_length", mesh.length);
  hdf5::numbers(own, "stiffness", mesh.stiffness);
  for (int b : {0, 1})
    hdf5::numbers(own, b == 0 ? "projectile_rim" : "target_rim",
                  std::vector<double>(mesh.rims[b].begin(), mesh.rims[b].end()));
  const Shape per_node{frames.size(), mesh.rest.size(), 3};
  hdf5::dataset(own, "contact_force", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, per_node, Shape{1, mesh.rest.size(), 3},
                gathered(frames, &Frame::contact_force).data());
  if (frames.empty() || frames.front().elongation.empty()) return;
  std::vector<float> elongation;
  for (const Frame& frame : frames)
    elongation.insert(elongation.end(), frame.elongation.begin(), frame.elongation.end());
  hdf5::dataset(own, "elongation", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, Shape{frames.size(), mesh.springs.size()},
                Shape{1, mesh.springs.size()}, elongation.data());
}

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

FrameMesh read_mesh(const hdf5::Handle& file) {
  const hdf5::Handle own = hdf5::open_group(file, "ricochet"), connectivity = hdf5::open_group(file, "connectivity");
  FrameMesh mesh;
  const std::vector<double> rest = hdf5::read_numbers(own, "rest"), bodies = hdf5::read_numbers(own, "bodies"),
                            launch = hdf5::read_numbers(own, "launch");
  must_be(bodies.size() == 5 && launch.size() == 1 && rest.size() % 2 == 0 && !rest.empty(), "the bodies");
  for (std::size_t i = 0; i + 1 < rest.size(); i += 2) mesh.rest.emplace_back(rest[i], rest[i + 1]);
  const std::size_t nodes = mesh.rest.size();
  must_be(bodies[0] >= 1 && bodies[0] < static_cast<double>(nodes), "the bodies");
  mesh.psi1 = launch[0];
  mesh.projectile_nodes = static_cast<int>(bodies[0]);
  mesh.mass = {bodies[1], bodies[2]};
  mesh.quartic = {bodies[3], bodies[4]};
  for (const int held : indices(own, "anchored", 2)) mesh.anchored.push_back(held != 0);
  mesh.springs = tuples<2>(indices(connectivity, "springs", nodes));
  mesh.triangles = tuples<3>(indices(connectivity, "triangles", nodes));
  mesh.length = hdf5::read_numbers(own, "rest_length");
  mesh.stiffness = hdf5::read_numbers(own, "stiffness");
  mesh.rims = {indices(own, "projectile_rim", nodes), indices(own, "target_rim", nodes)};
  must_be(mesh.anchored.size() == nodes && mesh.length.size() == mesh.springs.size() &&
              mesh.stiffness.size() == mesh.springs.size() && mesh.rims[0].size() >= 3 && mesh.rims[1].size() >= 3,
          "nodes, springs and rims");
  return mesh;
}

std::vector<Frame> read_frames(const hdf5::Handle& file, const FrameMesh& mesh) {
  const hdf5::Handle particles = hdf5::open_group(file, "particles"), all = hdf5::open_group(particles, "trajectory"),
                     own = hdf5::open_group(file, "ricochet");
  const hdf5::Handle position = hdf5::open_group(all, "position"), velocity = hdf5::open_group(all, "velocity"),
                     observed = hdf5::open_group(file, "observables");
  const std::vector<double> time = hdf5::read_numbers(position, "time"), step = hdf5::read_numbers(position, "step");
  std::vector<Frame> frames(time.size());
  const std::size_t nodes = mesh.rest.size();
  must_be(step.size() == time.size(), "times and steps");
  for (std::size_t k = 0; k < frames.size(); ++k) {
    frames[k].time = time[k];
    frames[k].step = static_cast<std::int64_t>(step[k]);
  }
  const auto spread = [&](const std::vector<float>& values, std::vector<Eigen::Vector2f> Frame::*member) {
    must_be(values.size() == frames.size() * nodes * 3, "frames and nodes");
    for (std::size_t k = 0; k < frames.size(); ++k)
      for (std::size_t i = 0; i < nodes; ++i)
        (frames[k].*member).emplace_back(values[(k * nodes + i) * 3], values[(k * nodes + i) * 3 + 1]);
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
  if (H5Lexists(own, "elongation", H5P_DEFAULT) > 0) {
    const std::vector<float> values = hdf5::read_floats(own, "elongation");
    must_be(values.size() == frames.size() * mesh.springs.size(), "frames and springs");
    for (std::size_t k = 0; k < frames.size(); ++k)
      frames[k].elongation.assign(values.begin() + static_cast<std::ptrdiff_t>(k * mesh.springs.size()),
                                  values.begin() + static_cast<std::ptrdiff_t>((k + 1) * mesh.springs.size()));
  }
  return frames;
}

}  // namespace

void Trajectory::write(const std::filesystem::path& path, const Provenance& provenance) const {
  const hsize_t frames = frames_.size(), nodes = mesh_.rest.size();
  const hdf5::Handle file = hdf5::memory_file();
  {
    const hdf5::Handle h5md = hdf5::group(file, "h5md");
    int_attribute(h5md, "version", {1, 1});
    const hdf5::Handle author = hdf5::group(h5md, "author"), creator = hdf5::group(h5md, "creator");
    variable_text_attribute(author, "name", {"ricochet"}, true);
    variable_text_attribute(creator, "name", {"ricochet"}, true);
    variable_text_attribute(creator, "version",
                            {provenance.count("version") ? provenance.at("version").c_str() : "unknown"}, true);

    const hdf5::Handle particles = hdf5::group(file, "particles"), all = hdf5::group(particles, "trajectory");
    const hdf5::Handle box = hdf5::group(all, "box");
    int_attribute(box, "dimension", {3});
    variable_text_attribute(box, "boundary", {"none", "none", "none"}, false);
    const hdf5::Handle position = hdf5::group(all, "position"), velocity = hdf5::group(all, "velocity");
    const Shape shape{frames, nodes, 3}, chunk{1, nodes, 3}, series{frames};
    hdf5::dataset(position, "value", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, shape, chunk,
                  gathered(frames_, &Frame::position).data());
    hdf5::dataset(velocity, "value", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, shape, chunk,
                  gathered(frames_, &Frame::velocity).data());
    std::vector<std::int64_t> step;
    std::vector<double> time, mass;
    std::vector<int> species;
    for (const Frame& frame : frames_) {
      step.push_back(frame.step);
      time.push_back(frame.time);
    }
    for (int i = 0; i < mesh_.nodes(); ++i) {
      species.push_back(mesh_.body_of(i));
      mass.push_back(mesh_.mass[static_cast<std::size_t>(mesh_.body_of(i))]);
    }
    hdf5::dataset(position, "step", H5T_STD_I64LE, H5T_NATIVE_INT64, series, {}, step.data());
    hdf5::dataset(position, "time", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, series, {}, time.data());
    hdf5::dataset(all, "mass", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, Shape{nodes}, {}, mass.data());
    hdf5::dataset(all, "species", H5T_STD_I32LE, H5T_NATIVE_INT, Shape{nodes}, {}, species.data());

    const hdf5::Handle observed = hdf5::group(file, "observables");
    for (std::size_t e = 0; e < frame_energies.size(); ++e) {
      const hdf5::Handle element = hdf5::group(observed, frame_energies[e]);
      std::vector<double> values;
      for (const Frame& frame : frames_) values.push_back(frame.energy[e]);
      const hdf5::Handle set = hdf5::numbers(element, "value", values);
      hdf5::attribute(set, "doc", energy_doc(frame_energies[e]) + " [m0 c^2]");
      hard_link(position, "step", element, "step");
      hard_link(position, "time", element, "time");
    }
    hard_link(position, "step", velocity, "step");
    hard_link(position, "time", velocity, "time");
    const hdf5::Handle connectivity = hdf5::group(file, "connectivity");
    hdf5::dataset(connectivity, "springs", H5T_STD_I32LE, H5T_NATIVE_INT, Shape{mesh_.springs.size(), 2}, {},
                  mesh_.springs.data());
    hdf5::dataset(connectivity, "triangles", H5T_STD_I32LE, H5T_NATIVE_INT, Shape{mesh_.triangles.size(), 3}, {},
                  mesh_.triangles.data());
    write_drawing(file, mesh_, frames_);
    const hdf5::Handle origin = hdf5::group(file, "provenance");
    for (const auto& [name, text] : provenance) hdf5::texts(origin, name.c_str(), std::vector<std::string>{text});
  }
  write_atomically(path, hdf5::image(file));

  // Inline selections "path|start stride count:shape"; ParaView's default reader crashes on HyperSlab items.
  const std::string name = path.filename().string();
  std::string xdmf =
      "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"impact\" GridType=\"Collection\" "
      "CollectionType=\"Temporal\">\n";
  for (hsize_t k = 0; k < frames; ++k) {
    const auto vectors = [&](const char* what) {
      return fmt::format(
          "<DataItem Dimensions=\"{} 3\" NumberType=\"Float\" Precision=\"4\" "
          "Format=\"HDF\">{}:/particles/trajectory/{}/value|{} 0 0:1 1 1:1 {} 3:{} {} 3</DataItem>",
          nodes, name, what, k, nodes, frames, nodes);
    };
    xdmf += fmt::format(
        "<Grid Name=\"frame\">\n<Time Value=\"{}\"/>\n<Topology TopologyType=\"Triangle\" "
        "NumberOfElements=\"{}\"><DataItem Dimensions=\"{} 3\" "
        "NumberType=\"Int\" Format=\"HDF\">{}:/connectivity/triangles</DataItem></Topology>\n<Geometry "
        "GeometryType=\"XYZ\">{}</Geometry>\n"
        "<Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Node\">{}</Attribute>\n</Grid>\n",
        frames_[k].time, mesh_.triangles.size(), mesh_.triangles.size(), name, vectors("position"),
        vectors("velocity"));
  }
  xdmf += "</Grid>\n</Domain>\n</Xdmf>\n";
  std::filesystem::path beside = path;
  write_atomically(beside.replace_extension(".xdmf"), xdmf);
}

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
  return H5Lexists(hdf5::open_file(path), "h5md", H5P_DEFAULT) > 0;
}

}  // namespace ricochet
