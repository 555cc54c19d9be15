#include "mpm/step/parted_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "mpm/shape/second_moment.hpp"
#include "mpm/shape/weights.hpp"
#include "mpm/transfer/particle_shape.hpp"

namespace sluice::mpm {
namespace {

// Whether the law has damage, cracks or failure of its own.
bool may_break(const Material& law) {
  constexpr std::string_view signs[] = {"p.damage", "p.crackRad", "p.COHER", "p.fail"};
  return law.failed_column() >= 0 ||
         std::any_of(law.history().begin(), law.history().end(), [&](const HistoryColumn& h) {
           return std::find(std::begin(signs), std::end(signs), h.label.name()) != std::end(signs);
         });
}

// Whether the particles of a body can lose each other although nothing lets it break: not those
// that stretch with it, nor fluids, grains and what can fail.
bool can_part(const MpmScene& solids, const SolidMaterial& material) {
  return !by_corners(solids.basis) && !solids.total_lagrangian && !solids.granular &&
         solids.prescribed_file.empty() && !material.rigid && material.law->shear_modulus() > 0 &&
         !may_break(*material.law);
}

// Half the width that the shape functions of a basis give a particle, cells; where widths differ,
// of the widest.
double half_width(Basis basis, const Carried& carried, std::size_t d) {
  if (basis == Basis::gimp && carried.columns.half < 0) return carried.half[d];
  return basis == Basis::linear ? 0 : 0.5;
}

// Cells between particles whose hold on each other is least_hold of that in one place.
double farthest_hold(double moment) {
  constexpr double least_hold = 1.0 / 20;
  return std::sqrt(-2 * std::log(least_hold) * 2 * moment);
}

}  // namespace

PartedNeighbours::PartedNeighbours(const MpmScene& solids, const SolidMaterial& material,
                                   const Carried& carried, const Level& level)
    : counts_(can_part(solids, material)), by_volume_(!solids.axisymmetric) {
  for (std::size_t a = 0; a < 3; ++a) {
    const double width = 2 * carried.half_at_rest[a] * level.spacing[static_cast<int>(a)];
    volume_ *= width;
    if (!level.active[a]) continue;
    ++directions_;
    for (std::size_t d = 0; d < 3; ++d) {
      if (!level.active[d]) continue;
      const auto n = static_cast<std::size_t>(components_++);
      component_[n] = 3 * d + a;
      const double moment = second_moment(solids.basis, half_width(solids.basis, carried, d));
      share_[n] = width / (farthest_hold(moment) * level.spacing[static_cast<int>(d)]);
    }
  }
}

void PartedNeighbours::add(const ParticleSet& set, const ParticleSet& next, const Columns& c,
                           std::size_t at, int n, BodyEnergySums& to) const {
  alignas(64) double most[chunk_size] = {};
  for (int k = 0; k < components_; ++k) {
    const auto e = static_cast<std::size_t>(k);
    const double* F = next.column(static_cast<std::size_t>(c.F) + component_[e]) + at;
    for (int q = 0; q < n; ++q) most[q] = std::max(most[q], std::fabs(F[q]) * share_[e]);
  }
  if (by_volume_) {  // to the power of the directions, as volumes go
    const double* V_0 = set.column(static_cast<std::size_t>(c.volume_0)) + at;
    alignas(64) double power[chunk_size];
    for (int q = 0; q < n; ++q) power[q] = V_0[q] * (1 / volume_);
    for (int d = 0; d < directions_; ++d)
      for (int q = 0; q < n; ++q) power[q] *= most[q];
    std::copy_n(power, n, most);
  }
  int parted = 0;
  for (int q = 0; q < n; ++q) parted += static_cast<int>(most[q] > 1);
  if (parted > 0) to[BodyEnergySums::parted].add(parted);
  to[BodyEnergySums::particles].add(n);
}

}  // namespace sluice::mpm
