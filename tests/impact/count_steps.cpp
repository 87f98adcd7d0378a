// count_steps engine|kernels: 40 steps of an impact without effects, by the engine or by its kernels called by hand,
// for valgrind to count. Valgrind does not know the rounding modes that CGAL asks the processor for, so the solids are
// made here.

#include <cmath>
#include <cstdio>
#include <string_view>

#include "bare_steps.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

/// A block of columns x rows nodes with both diagonals' half, as many springs a node as a triangulation; held below if
/// `anchored`.
Solid block(int columns, int rows, double spacing, double left, double bottom, bool anchored) {
  Solid solid;
  // From the top, so that anchors come last.
  const auto number = [&](int column, int row) { return (rows - 1 - row) * columns + column; };
  for (int row = rows - 1; row >= 0; --row)
    for (int column = 0; column < columns; ++column)
      solid.points.push_back(Vec2(left + spacing * column, bottom + spacing * row));
  solid.free = solid.nodes() - (anchored ? columns : 0);
  Springs springs;
  springs.first.assign(solid.points.size() + 1, 0);
  for (int i = 0; i < solid.nodes(); ++i) {
    const int column = i % columns, row = rows - 1 - i / columns;
    if (i < solid.free) {
      if (column + 1 < columns) springs.list.push_back({i, number(column + 1, row), false, spacing, 1});
      if (row > 0) springs.list.push_back({i, number(column, row - 1), false, spacing, 1});
      if (row > 0 && column + 1 < columns)
        springs.list.push_back({i, number(column + 1, row - 1), false, spacing * std::sqrt(2.0), 1});
    }
    springs.first[static_cast<std::size_t>(i) + 1] = static_cast<int>(springs.list.size());
  }
  solid.interior = springs;
  Mesh<2> surface;
  for (int c = 0; c < columns; ++c) surface.node.push_back(number(c, 0));
  for (int r = 1; r < rows; ++r) surface.node.push_back(number(columns - 1, r));
  for (int c = columns - 2; c >= 0; --c) surface.node.push_back(number(c, rows - 1));
  for (int r = rows - 2; r > 0; --r) surface.node.push_back(number(0, r));
  surface.cell = ring(static_cast<int>(surface.node.size()));
  solid.surface = surface;
  solid.smooth = surface_points(solid);
  return solid;
}

}  // namespace

int main(int count, char** values) {
  const Solid projectile = block(28, 28, 0.06, -0.8, 1, false), target = block(100, 40, 0.06, -3, -2.34, true);
  const Solids solids{&projectile, &target};
  Scene scene;
  scene.contact = {150, 300, 0.1, "one"};
  Body stiff, soft;
  soft.numbers.stiffness = 100;
  scene.projectile = std::make_shared<Body>(stiff);
  scene.target = std::make_shared<Body>(soft);
  scene.launch.psi1 = 1;
  if (count > 1 && std::string_view(values[1]) == "engine") {
    Engine<lanes> engine(solids, scene.method(), {});
    for (int lane = 0; lane < lanes; ++lane) engine.begin(lane, scene, 0);
    for (int i = 0; i < 40; ++i) engine.advance_one_step();
    std::printf("%.17g\n", engine.snapshot(0).energy.contact);  // so that nothing is left out
  } else {
    BareSteps bare(solids, scene);
    for (int i = 0; i < 40; ++i) bare.one_bare_step();
    std::printf("%.17g\n", bare.contact_energy());
  }
}
