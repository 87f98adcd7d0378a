#include "store/xdmf.hpp"

#include <fmt/format.h>

#include <string>

#include "store/files.hpp"

namespace ricochet {
namespace {

// Inline selections "path|start stride count:shape"; ParaView's default reader crashes on HyperSlab items.
std::string vectors(const std::string& file, const char* what, std::size_t frame, std::size_t frames,
                    std::size_t nodes) {
  return fmt::format(
      "<DataItem Dimensions=\"{} 3\" NumberType=\"Float\" Precision=\"4\" "
      "Format=\"HDF\">{}:/particles/trajectory/{}/value|{} 0 0:1 1 1:1 {} 3:{} {} 3</DataItem>",
      nodes, file, what, frame, nodes, frames, nodes);
}

}  // namespace

void write_xdmf(const std::filesystem::path& path, const Trajectory& trajectory, const Provenance&) {
  const std::string file = std::filesystem::path(path).replace_extension(".h5").filename().string();
  const std::size_t frames = trajectory.frames().size();
  const std::size_t nodes = trajectory.mesh().mass.size(), triangles = trajectory.mesh().triangles.size();
  std::string text =
      "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"impact\" GridType=\"Collection\" "
      "CollectionType=\"Temporal\">\n";
  for (std::size_t k = 0; k < frames; ++k)
    text += fmt::format(
        "<Grid Name=\"frame\">\n<Time Value=\"{}\"/>\n<Topology TopologyType=\"Triangle\" "
        "NumberOfElements=\"{}\"><DataItem Dimensions=\"{} 3\" "
        "NumberType=\"Int\" Format=\"HDF\">{}:/connectivity/triangles</DataItem></Topology>\n<Geometry "
        "GeometryType=\"XYZ\">{}</Geometry>\n"
        "<Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Node\">{}</Attribute>\n</Grid>\n",
        trajectory.frames()[k].time, triangles, triangles, file, vectors(file, "position", k, frames, nodes),
        vectors(file, "velocity", k, frames, nodes));
  text += "</Grid>\n</Domain>\n</Xdmf>\n";
  write_atomically(path, text);
}

}  // namespace ricochet
