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
  const hdf5::Handle space(values.size() == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, shape, nullptr), H5Sclose, "make a shape");
  const hdf5::Handle attr(H5Acreate2(object, name, H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "make an attribute");
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
  const hdf5::Handle space(scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, shape, nullptr), H5Sclose, "make a shape");
  const hdf5::Handle attr(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "make an attribute");
  H5Awrite(attr, type, values.data());
}

void hard_link(hid_t from, const char* name, hid_t to, const char* new_name) { H5Lcreate_hard(from, name, to, new_name, H5P_DEFAULT, H5P_DEFAULT); }

}  // namespace

void Trajectory::add(double time, double step, const Points& positions, const Points& velocities, const std::vector<double>& observables) {
  time_.push_back(time), step_.push_back(std::llround(step));
  for (const Vec2& p : positions) position_.insert(position_.end(), {static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0f});
  for (const Vec2& v : velocities) velocity_.insert(velocity_.end(), {static_cast<float>(v.x()), static_cast<float>(v.y()), 0.0f});
  observable_.resize(observables.size());
  for (std::size_t i = 0; i < observables.size(); ++i) observable_[i].push_back(observables[i]);
}

void Trajectory::write(const std::filesystem::path& path, const std::vector<Field>& observables, const Provenance& provenance) const {
  const hsize_t frames = time_.size(), nodes = static_cast<hsize_t>(layout_.nodes);
  const hdf5::Handle file = hdf5::memory_file();
  {
    const hdf5::Handle h5md = hdf5::group(file, "h5md");
    int_attribute(h5md, "version", {1, 1});
    const hdf5::Handle author = hdf5::group(h5md, "author"), creator = hdf5::group(h5md, "creator");
    variable_text_attribute(author, "name", {"ricochet"}, true);
    variable_text_attribute(creator, "name", {"ricochet"}, true);
    variable_text_attribute(creator, "version", {provenance.count("version") ? provenance.at("version").c_str() : "unknown"}, true);

    const hdf5::Handle particles = hdf5::group(file, "particles"), all = hdf5::group(particles, "trajectory");
    const hdf5::Handle box = hdf5::group(all, "box");
    int_attribute(box, "dimension", {3});
    variable_text_attribute(box, "boundary", {"none", "none", "none"}, false);
    const hdf5::Handle position = hdf5::group(all, "position"), velocity = hdf5::group(all, "velocity");
    const Shape shape{frames, nodes, 3}, chunk{1, nodes, 3}, series{frames};
    hdf5::dataset(position, "value", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, shape, chunk, position_.data());
    hdf5::dataset(velocity, "value", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, shape, chunk, velocity_.data());
    hdf5::dataset(position, "step", H5T_STD_I64LE, H5T_NATIVE_INT64, series, {}, step_.data());
    hdf5::dataset(position, "time", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, series, {}, time_.data());
    std::vector<double> mass(nodes, layout_.mass_target);
    std::vector<int> species(nodes, 1);
    for (int i = 0; i < layout_.projectile_nodes; ++i) mass[static_cast<std::size_t>(i)] = layout_.mass_projectile, species[static_cast<std::size_t>(i)] = 0;
    hdf5::dataset(all, "mass", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, Shape{nodes}, {}, mass.data());
    hdf5::dataset(all, "species", H5T_STD_I32LE, H5T_NATIVE_INT, Shape{nodes}, {}, species.data());

    const hdf5::Handle observed = hdf5::group(file, "observables");
    for (std::size_t i = 0; i < observables.size(); ++i) {
      const hdf5::Handle element = hdf5::group(observed, observables[i].name.c_str());
      const hdf5::Handle set = hdf5::numbers(element, "value", observable_[i]);
      hdf5::attribute(set, "doc", observables[i].doc);
      hard_link(position, "step", element, "step"), hard_link(position, "time", element, "time");
    }
    hard_link(position, "step", velocity, "step"), hard_link(position, "time", velocity, "time");
    const hdf5::Handle connectivity = hdf5::group(file, "connectivity");
    hdf5::dataset(connectivity, "springs", H5T_STD_I32LE, H5T_NATIVE_INT, Shape{layout_.springs.size(), 2}, {}, layout_.springs.data());
    hdf5::dataset(connectivity, "triangles", H5T_STD_I32LE, H5T_NATIVE_INT, Shape{layout_.triangles.size(), 3}, {}, layout_.triangles.data());
    const hdf5::Handle origin = hdf5::group(file, "provenance");
    for (const auto& [name, text] : provenance) hdf5::texts(origin, name.c_str(), std::vector<std::string>{text});
  }
  write_atomically(path, hdf5::image(file));

  // Inline selections "path|start stride count:shape"; ParaView's default reader crashes on HyperSlab items.
  const std::string name = path.filename().string();
  std::string xdmf = "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"impact\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (hsize_t k = 0; k < frames; ++k) {
    const auto vectors = [&](const char* what) {
      return fmt::format("<DataItem Dimensions=\"{} 3\" NumberType=\"Float\" Precision=\"4\" Format=\"HDF\">{}:/particles/trajectory/{}/value|{} 0 0:1 1 1:1 {} 3:{} {} 3</DataItem>",
                         nodes, name, what, k, nodes, frames, nodes);
    };
    xdmf += fmt::format("<Grid Name=\"frame\">\n<Time Value=\"{}\"/>\n<Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\"><DataItem Dimensions=\"{} 3\" "
                        "NumberType=\"Int\" Format=\"HDF\">{}:/connectivity/triangles</DataItem></Topology>\n<Geometry GeometryType=\"XYZ\">{}</Geometry>\n"
                        "<Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Node\">{}</Attribute>\n</Grid>\n",
                        time_[k], layout_.triangles.size(), layout_.triangles.size(), name, vectors("position"), vectors("velocity"));
  }
  xdmf += "</Grid>\n</Domain>\n</Xdmf>\n";
  std::filesystem::path beside = path;
  write_atomically(beside.replace_extension(".xdmf"), xdmf);
}

bool is_trajectory(const std::filesystem::path& path) { return H5Lexists(hdf5::open_file(path), "h5md", H5P_DEFAULT) > 0; }

}  // namespace ricochet
