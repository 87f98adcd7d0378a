#include "store/h5md.hpp"

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

// An element at the times of another.
void link_times(hid_t from, hid_t to) {
  for (const char* name : {"step", "time"}) H5Lcreate_hard(from, name, to, name, H5P_DEFAULT, H5P_DEFAULT);
}

// The same member of every frame, one after another: [frame][node][3].
std::vector<float> gathered(int dim, const std::vector<Frame>& frames, std::vector<float> Frame::*member) {
  std::vector<float> values;
  for (const Frame& frame : frames)
    for (auto v = (frame.*member).begin(); v != (frame.*member).end(); v += dim) {
      values.insert(values.end(), v, v + dim);
      values.resize(values.size() + static_cast<std::size_t>(3 - dim));
    }
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

// Ragged lists, one after another. A body: its first node, how many, how many numbers the law of its springs has,
// these. A law of solids: its body, how many numbers, these. A chain: its body, 1 if it is closed, how many nodes,
// these. Three speeds of waves of each body.
void write_bodies(const hdf5::Handle& own, const FrameMesh& mesh) {
  std::vector<double> bodies, chains, solid_laws, axisymmetric, wave_speeds;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    const BodyMesh& body = mesh.bodies[b];
    bodies.insert(bodies.end(), {static_cast<double>(body.first), static_cast<double>(body.nodes),
                                 static_cast<double>(body.law.size())});
    bodies.insert(bodies.end(), body.law.begin(), body.law.end());
    if (!body.solid_law.empty()) {
      solid_laws.insert(solid_laws.end(), {static_cast<double>(b), static_cast<double>(body.solid_law.size())});
      solid_laws.insert(solid_laws.end(), body.solid_law.begin(), body.solid_law.end());
    }
    wave_speeds.insert(wave_speeds.end(), body.wave_speeds.begin(), body.wave_speeds.end());
    if (body.axisymmetric) axisymmetric.push_back(static_cast<double>(b));
    for (const MeshChain& chain : body.surface) {
      chains.insert(chains.end(),
                    {static_cast<double>(b), chain.closed ? 1.0 : 0.0, static_cast<double>(chain.node.size())});
      chains.insert(chains.end(), chain.node.begin(), chain.node.end());
    }
  }
  hdf5::numbers(own, "bodies", bodies);
  hdf5::numbers(own, "chains", chains);
  if (!solid_laws.empty()) hdf5::numbers(own, "solid_laws", solid_laws);
  if (!axisymmetric.empty()) hdf5::numbers(own, "axisymmetric", axisymmetric);
  hdf5::numbers(own, "wave_speeds", wave_speeds);
}

// What the places do not tell of springs or elements with a past: as many numbers in every frame, or none.
void write_past(const hdf5::Handle& own, const std::vector<Frame>& frames, const char* name,
                std::vector<float> Frame::*member) {
  if (frames.empty() || (frames.front().*member).empty()) return;
  std::vector<float> all;
  for (const Frame& frame : frames) all.insert(all.end(), (frame.*member).begin(), (frame.*member).end());
  const std::size_t count = (frames.front().*member).size();
  hdf5::dataset(own, name, H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, Shape{frames.size(), count}, Shape{1, count}, all.data());
}

// What pictures need beyond H5MD.
void write_drawing(const hdf5::Handle& file, const FrameMesh& mesh, const std::vector<Frame>& frames) {
  const hdf5::Handle own = hdf5::group(file, "ricochet");
  hdf5::numbers(own, "launch", std::vector<double>{mesh.psi1});
  hdf5::numbers(own, "first_touch", std::vector<double>{mesh.first_touch});
  if (!mesh.effects.empty()) hdf5::texts(own, "effects", mesh.effects);
  write_bodies(own, mesh);
  std::vector<double> anchored;
  for (const bool held : mesh.anchored) anchored.push_back(held);
  hdf5::numbers(own, "dimension", std::vector<double>{static_cast<double>(mesh.dim)});
  hdf5::numbers(own, "rest", mesh.rest);
  hdf5::numbers(own, "anchored", anchored);
  hdf5::numbers(own, "rest_length", mesh.length);
  hdf5::numbers(own, "stiffness", mesh.stiffness);
  if (!mesh.modulus.empty()) hdf5::numbers(own, "modulus", mesh.modulus);
  if (!mesh.lame.empty()) hdf5::numbers(own, "lame", mesh.lame);
  const Shape per_node{frames.size(), mesh.mass.size(), 3};
  hdf5::dataset(own, "contact_force", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, per_node, Shape{1, mesh.mass.size(), 3},
                gathered(mesh.dim, frames, &Frame::contact_force).data());
  write_past(own, frames, "elongation", &Frame::elongation);
  write_past(own, frames, "plastic", &Frame::plastic);
}

void write_head(const hdf5::Handle& file, const Provenance& provenance) {
  const hdf5::Handle h5md = hdf5::group(file, "h5md");
  int_attribute(h5md, "version", {1, 1});
  const hdf5::Handle author = hdf5::group(h5md, "author"), creator = hdf5::group(h5md, "creator");
  const auto version = provenance.find("version");
  variable_text_attribute(author, "name", {"ricochet"}, true);
  variable_text_attribute(creator, "name", {"ricochet"}, true);
  variable_text_attribute(creator, "version", {version == provenance.end() ? "unknown" : version->second.c_str()},
                          true);
}

// Where all nodes are, at all times. `step` and `time` of the places are those of all else.
hdf5::Handle write_nodes(const hdf5::Handle& all, const FrameMesh& mesh, const std::vector<Frame>& frames) {
  const hdf5::Handle box = hdf5::group(all, "box");
  int_attribute(box, "dimension", {3});
  variable_text_attribute(box, "boundary", {"none", "none", "none"}, false);
  hdf5::Handle position = hdf5::group(all, "position");
  const hdf5::Handle velocity = hdf5::group(all, "velocity");
  const hsize_t nodes = mesh.mass.size();
  const Shape shape{frames.size(), nodes, 3}, chunk{1, nodes, 3}, series{frames.size()};
  hdf5::dataset(position, "value", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, shape, chunk,
                gathered(mesh.dim, frames, &Frame::position).data());
  hdf5::dataset(velocity, "value", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, shape, chunk,
                gathered(mesh.dim, frames, &Frame::velocity).data());
  std::vector<std::int64_t> step;
  std::vector<double> time;
  std::vector<int> species;
  for (const Frame& frame : frames) {
    step.push_back(frame.step);
    time.push_back(frame.time);
  }
  for (int i = 0; i < mesh.nodes(); ++i) species.push_back(mesh.body_of(i));
  hdf5::dataset(position, "step", H5T_STD_I64LE, H5T_NATIVE_INT64, series, {}, step.data());
  hdf5::dataset(position, "time", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, series, {}, time.data());
  hdf5::dataset(all, "mass", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, Shape{nodes}, {}, mesh.mass.data());
  hdf5::dataset(all, "species", H5T_STD_I32LE, H5T_NATIVE_INT, Shape{nodes}, {}, species.data());
  link_times(position, velocity);
  return position;
}

void write_energies(const hdf5::Handle& file, const hdf5::Handle& position, const std::vector<Frame>& frames) {
  const hdf5::Handle observed = hdf5::group(file, "observables");
  for (std::size_t e = 0; e < frame_energies.size(); ++e) {
    const hdf5::Handle element = hdf5::group(observed, frame_energies[e]);
    std::vector<double> values;
    for (const Frame& frame : frames) values.push_back(frame.energy[e]);
    const hdf5::Handle set = hdf5::numbers(element, "value", values);
    hdf5::attribute(set, "doc", energy_doc(frame_energies[e]) + " [m0 c^2]");
    link_times(position, element);
  }
}

void write_connectivity(const hdf5::Handle& file, const FrameMesh& mesh) {
  const hdf5::Handle connectivity = hdf5::group(file, "connectivity");
  hdf5::dataset(connectivity, "springs", H5T_STD_I32LE, H5T_NATIVE_INT, Shape{mesh.springs.size(), 2}, {},
                mesh.springs.data());
  hdf5::dataset(connectivity, "triangles", H5T_STD_I32LE, H5T_NATIVE_INT, Shape{mesh.triangles.size(), 3}, {},
                mesh.triangles.data());
}

}  // namespace

void write_h5md(const std::filesystem::path& path, const Trajectory& trajectory, const Provenance& provenance) {
  const FrameMesh& mesh = trajectory.mesh();
  const std::vector<Frame>& frames = trajectory.frames();
  const hdf5::Handle file = hdf5::memory_file();
  {
    write_head(file, provenance);
    const hdf5::Handle particles = hdf5::group(file, "particles"), all = hdf5::group(particles, "trajectory");
    const hdf5::Handle position = write_nodes(all, mesh, frames);
    write_energies(file, position, frames);
    write_connectivity(file, mesh);
    write_drawing(file, mesh, frames);
    hdf5::write_provenance(file, provenance);
  }
  write_atomically(path, hdf5::image(file));
}

}  // namespace ricochet
