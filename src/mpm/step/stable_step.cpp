#include "mpm/step/stable_step.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sluice::mpm {
namespace {

// Shares with one, two, three or more particles of a cell in a direction.
struct BasisLimit {
  const char* name;
  std::array<double, 3> shares;
};

BasisLimit limit_of(const MpmScene& solids) {
  if (solids.total_lagrangian) return {"total Lagrangian form", {0.9, 0.9, 0.9}};
  if (solids.midpoint()) return {"the midpoint transfer", {0.9, 0.9, 0.9}};
  if (solids.maps_back())
    return {solids.basis == Basis::linear ? "linear basis" : "<musl> true", {0.9, 0.9, 0.9}};
  switch (solids.basis) {
    case Basis::linear:
      return {"linear basis without <musl>", {0.4, 0.4, 0.4}};
    case Basis::gimp:
    case Basis::cpgimp:
      return {"GIMP", {0.55, 0.52, 0.5}};
    case Basis::quadratic:
      return {"quadratic basis", {0.55, 0.65, 0.65}};
    case Basis::cubic:
      return {"cubic basis", {0.8, 0.8, 0.8}};
    case Basis::cpdi:
    case Basis::fast_cpdi:
    case Basis::cpti:
      return {"CPDI", {0.7, 0.65, 0.55}};
    case Basis::carried:
      return {"particles with corners of their own", {0.65, 0.65, 0.55}};
  }
  return {"", {1, 1, 1}};
}

}  // namespace

StableShare stable_share(const MpmScene& solids, const std::array<bool, 3>& active) {
  const BasisLimit limit = limit_of(solids);
  // A fluid beside them adds its stiffness to nodes of little mass (MPMICE).
  constexpr double beside_fluid = 0.55;
  // Nodes at which contact acts have the velocities that it gave, not those of particles.
  constexpr double where_bodies_meet = 0.8;
  StableShare least;
  const auto consider = [&](int count) {
    double share = limit.shares[static_cast<std::size_t>(std::clamp(count, 1, 3)) - 1];
    if (solids.whole_kicks) share = std::min(share, beside_fluid);
    if (solids.midpoint() && !solids.contacts.empty()) share = std::min(share, where_bodies_meet);
    if (share < least.share)
      least = {share, fmt::format("{} with {} particle{} per cell and direction", limit.name, count,
                                  count == 1 ? "" : "s")};
  };
  for (const SolidMaterial& m : solids.materials) {
    if (m.rigid) continue;
    for (const SeedObject& o : m.forms())
      for (int d = 0; d < 3; ++d)
        if (active[static_cast<std::size_t>(d)]) consider(o.per_cell[d]);
  }
  return least;
}

}  // namespace sluice::mpm
