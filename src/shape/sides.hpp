#pragma once
#include <vector>

namespace ricochet {

inline constexpr int side_unseen = 0, side_outside = 1, side_inside = 2;

/// On which side of the constraints every face of a constrained triangulation lies: side_of(face) is a reference to a
/// number that was side_unseen. Faces joined to the infinite one without crossing a constraint lie outside; those
/// behind one inside, and so on.
template <class Triangulation, class Side>
void mark_sides(Triangulation& triangulation, Side&& side_of) {
  std::vector<typename Triangulation::Face_handle> stack{triangulation.infinite_face()}, beyond;
  for (int side = side_outside; !stack.empty(); side = side == side_outside ? side_inside : side_outside) {
    while (!stack.empty()) {
      const auto face = stack.back();
      stack.pop_back();
      if (side_of(face) != side_unseen) continue;
      side_of(face) = side;
      for (int edge = 0; edge < 3; ++edge)
        if (side_of(face->neighbor(edge)) == side_unseen)
          (face->is_constrained(edge) ? beyond : stack).push_back(face->neighbor(edge));
    }
    stack.swap(beyond);
  }
}

}  // namespace ricochet
