#pragma once

namespace ricochet {

/// A triangle as its edges d1, d2 from one corner see it. With D = [d1 d2], and D0 at rest:
///   |F|^2 = sum of (D^T D) (D0^T D0)^-1,  J = det D / det D0
struct EdgeMetric {
  double xx, xy, yy;     ///< its weight times (D0^T D0)^-1
  double per_rest_area;  ///< 1/det D0 [1/R^2]
  double share;          ///< its weight over det D0
};

}  // namespace ricochet
