// Numerical fracture: particles whose neighbours at the start have lost hold of them.
//
// Two particles at a distance d along an axis hold each other by the nodes that they share, in
// the mean over their places by the convolution of their shape functions with each other: a
// B-spline, near exp(-d^2/(2 sigma^2)), sigma^2 twice the second moment of the shape function.
// Shape functions other than those of cpdi, cpti and carried corners do not stretch with the
// particle. The neighbour along edge a, at distance s_a at the start, is by the deformation
// gradient at F e_a s_a; it counts as lost once
//
//   |F_da| s_a > W_d,  exp(-W_d^2/(2 sigma_d^2)) = 1/20.
//
// Bars that are pulled apart lose coherence there: see parted_test.cpp. s_a is the width of the
// particle as the object has it, scaled to its volume at the start. It is a count of single
// particles, so that it depends on no order.
#pragma once
#include <array>

#include "framework/grid/level.hpp"
#include "mpm/step/body_energy.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

class PartedNeighbours {
 public:
  // Nothing is counted.
  PartedNeighbours() = default;
  PartedNeighbours(const MpmScene& solids, const SolidMaterial& material, const Carried& carried,
                   const Level& level);

  bool counts() const { return counts_; }
  // Adds numbers of the n particles from `at` on, as they are in `next`: what steps do not change
  // stands in `set`.
  void add(const ParticleSet& set, const ParticleSet& next, const Columns& columns, std::size_t at,
           int n, BodyEnergySums& to) const;

 private:
  bool counts_ = false;
  int directions_ = 0;     // of the run
  bool by_volume_ = true;  // not in axial symmetry: volumes there are those of a radian
  double volume_ = 1;      // of the particle of these widths, m^3
  int components_ = 0;     // of F that are looked at: their numbers, and s_a/W_d of each
  std::array<std::size_t, 9> component_{};
  std::array<double, 9> share_{};
};

}  // namespace sluice::mpm
