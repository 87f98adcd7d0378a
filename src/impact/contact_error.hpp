#pragma once
#include <atomic>
#include <vector>

#include "impact/scene.hpp"
#include "impact/trials.hpp"

namespace ricochet {

/// What the softness of a contact that the program chose does to scenes of a kind: the mean of 2 |x(xi) - x(2 xi)|, x
/// their accuracy_of, over at most three of them, spread evenly; the error halves with every doubling. `scenes`: with
/// method and step. NaN where a scene gives xi, or none finishes. [the differences of a sequence of order 1: here]
double contact_error(const std::vector<TrialScene>& scenes, int threads, const std::atomic<bool>& stop);

}  // namespace ricochet
