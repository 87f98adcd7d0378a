#pragma once
// What elements that yield remember, of all bodies and in W lanes.

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "body/elements/flow.hpp"
#include "body/solid.hpp"
#include "core/carrier.hpp"

namespace ricochet {

template <int W>
class Flows {
 public:
  explicit Flows(std::size_t bodies) : of_(bodies) {}

  /// Lets the elements of a body yield.
  void let(std::size_t body, const Elements& elements, double yield, double hardening) {
    of_[body] = std::make_unique<Flow<W>>();
    of_[body]->yield = yield;
    of_[body]->hardening = hardening;
    of_[body]->memory.resize(elements.nodes.size());
  }

  Flow<W>* of(std::size_t body) const { return of_[body].get(); }

  bool any() const {
    return std::any_of(of_.begin(), of_.end(), [](const auto& flow) { return flow != nullptr; });
  }

  /// An impact begins in a lane: nothing has flowed.
  void begin(int lane) {
    const PlasticMemory<1> none;
    each([&](Flow<W>& flow) {
      flow.lost[lane] = 0;
      for (PlasticMemory<W>& m : flow.memory) {
        m.xx[lane] = none.xx[0];
        m.xy[lane] = none.xy[0];
        m.yy[lane] = none.yy[0];
        m.zz[lane] = none.zz[0];
        m.strain[lane] = none.strain[0];
      }
    });
  }

  void carry(int lane, Carrier& carrier) {
    each([&](Flow<W>& flow) {
      carrier.pass(flow.lost[lane]);
      for (PlasticMemory<W>& m : flow.memory)
        for (Lane<W>* number : {&m.xx, &m.xy, &m.yy, &m.zz, &m.strain}) carrier.pass((*number)[lane]);
    });
  }

  /// Adds what these bodies have lost.
  void add_lost(const std::vector<int>& bodies, Lane<W>& energy) const {
    for (const int b : bodies)
      if (const Flow<W>* flow = of(static_cast<std::size_t>(b))) energy += flow->lost;
  }

  /// How many elements of a lane have flowed.
  double count(int lane) const {
    double count = 0;
    each([&](const Flow<W>& flow) {
      for (const PlasticMemory<W>& m : flow.memory) count += m.strain[lane] > 0;
    });
    return count;
  }

  /// The greatest plastic strain of a lane; undefined where nothing yields.
  double most_strain(int lane) const {
    double most = any() ? 0 : std::numeric_limits<double>::quiet_NaN();
    each([&](const Flow<W>& flow) {
      for (const PlasticMemory<W>& m : flow.memory) most = std::max(most, m.strain[lane]);
    });
    return most;
  }

 private:
  template <class Use>
  void each(Use&& use) const {
    for (const auto& flow : of_)
      if (flow) use(*flow);
  }

  std::vector<std::unique_ptr<Flow<W>>> of_;  // [body] nothing where none yields
};

}  // namespace ricochet
