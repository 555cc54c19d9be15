#include "mpmice/mpmice.hpp"

#include <algorithm>

#include "ice/fluid/labels.hpp"

namespace sluice::mpmice {
namespace {

// Where the fluid's numbers begin.
IndexOffsets places_of_fluid(const mpm::Mpm& solids, int fluids) {
  IndexOffsets places;
  places.effect = solids.effects().size();
  const ice::Labels& l = ice::labels();
  places.common = {l.mask,
                   l.pressure,
                   l.equilibrium_pressure,
                   l.pressure_change,
                   l.source_pressure,
                   l.gradient_pressure};
  for (int d = 0; d < 3; ++d) {
    places.common.push_back(l.face_pressure[d]);
    places.common.push_back(l.face_pressure_gradient[d]);
  }
  for (int m = 0; m < fluids; ++m) places.material.push_back(solids.material_count() + m);
  return places;
}

// The coupling takes particles that carry their corners, whatever basis the deck names.
mpm::MpmScene with_corners(mpm::MpmScene solids, const std::vector<models::SolidBurn>& burns,
                           const Level& level) {
  for (const models::SolidBurn& burn : burns) {
    mpm::SolidMaterial& solid = solids.materials[burn.solid];
    solid.burns = true;
    const models::BurningMemory memory = burn.law->memory();
    solid.awaits_flames |= memory.flame;
    solid.has_surface_history |= memory.surface;
  }
  solids.carry_corners(level.active);
  solids.whole_kicks = true;
  return solids;
}

BurnReductions register_burning(ReductionLayout& reductions,
                                const std::vector<models::SolidBurn>& burns, int materials) {
  if (burns.empty()) return {};
  return {reductions.add_sums_of_stages(BurnedSums::count(materials)),
          reductions.add_sums_of_stages(static_cast<int>(output_switches(burns).size()))};
}

}  // namespace

std::vector<OutputSwitch> output_switches(const std::vector<models::SolidBurn>& burns) {
  std::vector<OutputSwitch> switches;
  for (const models::SolidBurn& burn : burns)
    for (const OutputSwitch& to : burn.law->output_switches()) switches.push_back(to);
  return switches;
}

void bind_solids(const ice::IceScene& fluid, mpm::MpmScene& solids) {
  const int count = static_cast<int>(solids.materials.size());
  for (int m = 0; m < count; ++m)
    for (int n = m + 1; n < count; ++n) {
      if (fluid.momentum_of_all(m, n) < ice::one_velocity_coefficient) continue;
      mpm::ContactRule rule;
      rule.kind = mpm::ContactKind::single_velocity;
      rule.materials = {m, n};
      rule.type = "single_velocity";
      rule.where = fluid.exchange.where;
      solids.contacts.insert(solids.contacts.begin(), rule);
    }
}

MpmIce::MpmIce(const Scene& scene, ice::IceScene fluid, mpm::MpmScene solids,
               const std::vector<models::SolidBurn>& burns)
    : scene_(scene),
      solids_(scene, with_corners(std::move(solids), burns, scene.grid.levels.front()),
              reductions_),
      fluid_(scene, fluid, places_of_fluid(solids_, static_cast<int>(fluid.materials.size())),
             reductions_),
      burning_{burns, register_burning(*reductions_, burns, material_count()),
               BurningCells(scene, burns, solids_.material_count(), fluid.models.any_source())} {
  for (const EffectList* list : {&solids_.effects(), &fluid_.effects()})
    for (int e = 0; e < list->size(); ++e) effects_.add((*list)[e]);
  if (const ParticleMethod* tracers = fluid_.particles())
    joined_ = std::make_unique<JoinedParticles>(*solids_.particles(), *tracers);
}

bool MpmIce::has_budget() const {
  const auto& solids = solids_.scene().materials;
  return burning_.laws.empty() &&
         std::none_of(solids.begin(), solids.end(), [](const auto& m) { return m.rigid; });
}

}  // namespace sluice::mpmice
