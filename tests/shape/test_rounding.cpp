// Compiled as src/shape's users of CGAL are, by CGAL::CGAL: they do without CGAL's own check at every start.

#include <CGAL/Interval_nt.h>

#include <catch2/catch.hpp>

TEST_CASE("what is compiled as the triangulation is rounds downwards and upwards where CGAL asks for it") {
  using Interval = CGAL::Interval_nt<true>;
  for (const Interval& made : {Interval(1.1) * Interval(10.1), Interval(1) / Interval(10)}) {
    CHECK(made.inf() < made.sup());
    CHECK(made.sup() - made.inf() < 1e-14);
  }
}
