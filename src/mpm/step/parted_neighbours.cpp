#include "mpm/step/parted_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "framework/base/eight.hpp"
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
  std::array<const double*, 9> F{};
  for (int k = 0; k < components_; ++k)
    F[static_cast<std::size_t>(k)] =
        next.column(static_cast<std::size_t>(c.F) + component_[static_cast<std::size_t>(k)]) + at;
  const double* V_0 = set.column(static_cast<std::size_t>(c.volume_0)) + at;
  double parted = 0;
  for_eights(0, static_cast<std::size_t>(n), [&](auto q) {
    using T = typename decltype(q)::Number;
    const T none{};
    T most{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(components_); ++k)
      most = larger(most, T(magnitude(q(F[k])) * share_[k]));
    if (by_volume_) {  // to the power of the directions, as volumes go
      T power = q(V_0) * (1 / volume_);
      for (int d = 0; d < directions_; ++d) power *= most;
      most = power;
    }
    parted += sum_of_lanes(most > 1.0 ? none + 1.0 : none);
  });
  if (parted > 0) to[BodyEnergySums::parted].add(parted);
  to[BodyEnergySums::particles].add(n);
}

}  // namespace sluice::mpm
