#pragma once
#include <filesystem>

#include "store/table.hpp"
#include "store/trajectory.hpp"

namespace ricochet {

/// What ParaView opens: where in the .h5 file of the same name (h5md.hpp) the frames stand. Throws FileError.
void write_xdmf(const std::filesystem::path& path, const Trajectory& trajectory, const Provenance& provenance);

}  // namespace ricochet
