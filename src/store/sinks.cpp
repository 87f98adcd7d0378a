#include "store/sinks.hpp"

#include "store/csv.hpp"
#include "store/h5md.hpp"
#include "store/xdmf.hpp"

namespace ricochet {
namespace {

constexpr RowsSink of_rows[] = {
    {".h5", write_table},
    {".csv", write_csv},
};

constexpr TrajectorySink of_trajectories[] = {
    {".h5", write_h5md},
    {".xdmf", write_xdmf},
};

// Not replace_extension: a name may have a dot of its own.
std::filesystem::path with_extension(std::filesystem::path path, const char* extension) { return path += extension; }

}  // namespace

std::span<const RowsSink> rows_sinks() { return of_rows; }
std::span<const TrajectorySink> trajectory_sinks() { return of_trajectories; }

void write_everywhere(const std::filesystem::path& path, const Table& table, const Provenance& provenance) {
  for (const RowsSink& sink : rows_sinks()) sink.write(with_extension(path, sink.extension), table, provenance);
}

void write_everywhere(const std::filesystem::path& path, const Trajectory& trajectory, const Provenance& provenance) {
  for (const TrajectorySink& sink : trajectory_sinks())
    sink.write(with_extension(path, sink.extension), trajectory, provenance);
}

}  // namespace ricochet
