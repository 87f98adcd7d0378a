#pragma once
// The interior of a body of springs: a network that joins its nodes.

#include <array>
#include <cstddef>
#include <vector>

#include "material/spring_law.hpp"

namespace ricochet {

struct Spring {
  int node, other;   ///< its ends; the first holds it and is the smaller
  bool on_rim;       ///< joins neighbours in the surface
  double length;     ///< rest length: the distance of its ends at rest, but for prestress [R]
  double stiffness;  ///< relative to the body's stiffness
};

/// Read like a vector of Spring, kept as one array a quantity: a loop over one impact alone takes several at once.
class SpringList {
 public:
  void push_back(const Spring& s) {
    ends_.push_back({s.node, s.other});
    on_rim_.push_back(s.on_rim);
    length_.push_back(s.length);
    stiffness_.push_back(s.stiffness);
  }
  Spring operator[](std::size_t s) const { return {ends_[s][0], ends_[s][1], on_rim_[s], length_[s], stiffness_[s]}; }
  std::size_t size() const { return ends_.size(); }
  void set_length(std::size_t s, double length) { length_[s] = length; }

  const std::array<int, 2>* ends() const { return ends_.data(); }  ///< [spring] node, other
  const double* length() const { return length_.data(); }          ///< [spring]
  const double* stiffness() const { return stiffness_.data(); }    ///< [spring]

 private:
  std::vector<std::array<int, 2>> ends_;
  std::vector<bool> on_rim_;
  std::vector<double> length_, stiffness_;
};

/// Springs are a half list: those of node i to larger numbers are list[first[i]] ... list[first[i+1]-1]. Springs
/// between two anchored nodes, which never stretch, are left out of it.
struct Springs {
  std::vector<int> first;  ///< [node + 1] first spring of a node
  SpringList list;
  SpringLawNumbers law;
  bool uniform = true;     ///< every spring has the body's stiffness
  double rest_energy = 0;  ///< at rest, which prestress alone gives, per unit of the body's stiffness [R^2]
};

/// Calls `use(i, s, spring)` for every spring, by rising s; the free nodes i hold them.
template <class Use>
void each_spring(const Springs& springs, int free, Use&& use) {
  for (int i = 0; i < free; ++i)
    for (int s = springs.first[static_cast<std::size_t>(i)]; s < springs.first[static_cast<std::size_t>(i) + 1]; ++s)
      use(i, s, springs.list[static_cast<std::size_t>(s)]);
}

}  // namespace ricochet
