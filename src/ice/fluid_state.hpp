// What the fluid keeps in cells: masses, momentum, energies, volumes, scalars; and their boundary.
#pragma once
#include "framework/run/component/state_facet.hpp"
#include "ice/fluid_part.hpp"

namespace sluice::ice {

class FluidState : public StateFacet {
 public:
  explicit FluidState(const FluidPart& part) : part_(&part) {}

  std::vector<SlotInfo> slots() const override;
  std::vector<std::vector<Label>> checkpoint_labels() const override;
  void initialise(Warehouse& state) const override;
  void fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                     const ThreadTeam& team) const override;
  int boundary_sums() const override;
  void add_boundary_sums(const Warehouse& state, std::span<ExactSum> sums) const override;
  std::vector<SlotInfo> work_slots() const override;
  void fill_work_boundary(Warehouse& state, Label label, const ThreadTeam& team) const override;

 private:
  const FluidPart* part_;
};

}  // namespace sluice::ice
