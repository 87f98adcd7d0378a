// count_steps with|without: 40 steps of an impact without effects, by an engine with or without the catalogue of them,
// for valgrind to count. Valgrind does not know the rounding modes that CGAL asks the processor for, so the lattices
// are made here.

#include <cstdio>
#include <string_view>

#include "no_effects.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

/// A block of columns x rows nodes with both diagonals' half, as many springs a node as a triangulation; held below if
/// `anchored`.
Lattice block(int columns, int rows, double spacing, double left, double bottom, bool anchored) {
  Lattice lattice;
  const auto number = [&](int column, int row) {
    return (rows - 1 - row) * columns + column;
  };  // from the top, so that anchors come last
  for (int row = rows - 1; row >= 0; --row)
    for (int column = 0; column < columns; ++column)
      lattice.points.push_back(Vec2(left + spacing * column, bottom + spacing * row));
  lattice.free = static_cast<int>(lattice.points.size()) - (anchored ? columns : 0);
  lattice.first.assign(lattice.points.size() + 1, 0);
  for (int i = 0; i < lattice.nodes(); ++i) {
    const int column = i % columns, row = rows - 1 - i / columns;
    if (i < lattice.free) {
      if (column + 1 < columns) lattice.spring.push_back({i, number(column + 1, row), false, spacing, 1});
      if (row > 0) lattice.spring.push_back({i, number(column, row - 1), false, spacing, 1});
      if (row > 0 && column + 1 < columns)
        lattice.spring.push_back({i, number(column + 1, row - 1), false, spacing * std::sqrt(2.0), 1});
    }
    lattice.first[static_cast<std::size_t>(i) + 1] = static_cast<int>(lattice.spring.size());
  }
  for (int c = 0; c < columns; ++c) lattice.rim.push_back(number(c, 0));
  for (int r = 1; r < rows; ++r) lattice.rim.push_back(number(columns - 1, r));
  for (int c = columns - 2; c >= 0; --c) lattice.rim.push_back(number(c, rows - 1));
  for (int r = rows - 2; r > 0; --r) lattice.rim.push_back(number(0, r));
  for (const int i : lattice.rim) lattice.smooth_rim.push_back(lattice.points[static_cast<std::size_t>(i)]);
  lattice.quartic = 1e-3;
  return lattice;
}

template <class Effects>
void run(const Lattice& projectile, const Lattice& target, const Scene& scene) {
  Engine<lanes, Effects> engine(projectile, target, scene.method(), {});
  for (int lane = 0; lane < lanes; ++lane) engine.begin(lane, scene, 0);
  for (int i = 0; i < 40; ++i) engine.advance_one_step();
  std::printf("%.17g\n", engine.snapshot(0).energy.contact);  // so that nothing is left out
}

}  // namespace

int main(int count, char** values) {
  const Lattice projectile = block(28, 28, 0.06, -0.8, 1, false), target = block(100, 40, 0.06, -3, -2.34, true);
  Scene scene;
  Body stiff{{}, {}, {}, {}}, soft = stiff;
  soft.numbers.stiffness = 100;
  scene.projectile = std::make_shared<Body>(stiff);
  scene.target = std::make_shared<Body>(soft);
  scene.launch.psi1 = 1;
  if (count > 1 && std::string_view(values[1]) == "with")
    run<ActingEffects<lanes>>(projectile, target, scene);
  else
    run<NoEffects<lanes>>(projectile, target, scene);
}
