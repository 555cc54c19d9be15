#include "ice/fluid_levels.hpp"

#include "ice/fluid/labels.hpp"
#include "ice/levels/interface_seeds.hpp"
#include "ice/levels/mixture_transfer.hpp"
#include "ice/levels/offset_transfer.hpp"
#include "ice/levels/scalar_transfer.hpp"
#include "ice/one_material/leaving_shocks.hpp"
#include "ice/outputs/criteria.hpp"

namespace sluice::ice {
namespace {

std::unique_ptr<TransferOperators> make_flow_transfer(const Scene& scene, const IceScene& ice,
                                                      const SchemeOptions& o,
                                                      const std::vector<SlotInfo>& slots) {
  const bool matches = matches_fluxes(scene, ice);
  std::unique_ptr<TransferOperators> flow;
  std::vector<std::size_t> by_volume;  // views of scalars
  const std::size_t materials = o.materials.fluids.size();
  std::size_t views = 0;  // of the flow: the components of its slots, which scalars follow
  const std::size_t beside =
      ice.models.scalars.size() + (o.scheme.implicit ? 1 : 0) + (ice.solids > 0 ? 1 : 0);
  for (std::size_t s = 0; s + beside < slots.size(); ++s) views += slots[s].components;
  for (std::size_t s = 0; s < ice.models.scalars.size(); ++s)
    if (ice.models.scalars[s].by_volume) by_volume.push_back(views + s);
  if (materials == 1)
    flow = std::make_unique<IceTransfer>(o.grid.components, o.scheme.internal_energy_form, matches,
                                         o.materials.fluid, by_volume);
  else
    flow = std::make_unique<MixtureTransfer>(
        o.materials.fluids, o.grid.components, matches, o.materials.multi_velocity,
        by_volume.empty() ? MixedGasView{} : MixedGasView{o.materials.mixed, by_volume.front()});
  if (ice.models.scalars.empty()) return flow;
  std::vector<std::size_t> mass;
  for (const models::TransportedScalar& s : ice.models.scalars) mass.push_back(s.material);
  return std::make_unique<scalars::ScalarTransfer>(std::move(flow), std::move(mass), views,
                                                   std::move(by_volume));
}

std::unique_ptr<TransferOperators> make_transfer(const Scene& scene, const IceScene& ice,
                                                 const SchemeOptions& o,
                                                 const std::vector<SlotInfo>& slots) {
  auto flow = make_flow_transfer(scene, ice, o, slots);
  if (o.scheme.implicit) flow = std::make_unique<OffsetTransfer>(std::move(flow));
  if (ice.solids > 0) flow = std::make_unique<OffsetTransfer>(std::move(flow));  // theta
  return flow;
}

}  // namespace

FluidLevels::FluidLevels(const FluidPart& part, const std::vector<SlotInfo>& slots)
    : part_(&part),
      transfer_(make_transfer(part.run_scene(), part.scene(), part.options(), slots)),
      estimates_(wanted_estimates(part.run_scene().refinement.errors)) {}

// Shocks do not leave levels that follow them.
IntVec3 FluidLevels::interface_depth(const Level& level) const {
  const RefinementSettings& r = part_->run_scene().refinement;
  const bool follow =
      r.adaptive && !r.once &&
      !(part_->scene().criteria.empty() && r.errors.empty() && r.interfaces.empty());
  if (part_->options().scheme.internal_energy_form || !part_->options().scheme.second_order ||
      part_->options().scheme.third_order || follow)
    return {};
  return leaving_depth(level);
}

Label FluidLevels::refine_flag() const {
  return labels().refine_flag;
}

std::vector<FlagSeeds> FluidLevels::flag_seeds(const Warehouse& state) const {
  std::vector<int> numbers;
  for (int m = 0; m < part_->material_count(); ++m) numbers.push_back(part_->options().place(m));
  return interface_seeds(state, numbers, part_->run_scene().refinement.interfaces);
}

}  // namespace sluice::ice
