#pragma once

namespace ricochet {

/// What the past of a spring has left of it: its own law acts on the stretch `elastic`, and counts `share` times.
template <class Number>
struct SpringRest {
  Number elastic;  ///< [R]
  Number share;    ///< 1, or 0 once it is broken
};

}  // namespace ricochet
