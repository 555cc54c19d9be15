// Kinds of blocks of the fluid: of one material alone each, of several, cut by solids.
#pragma once
#include "framework/run/component/block_facet.hpp"
#include "ice/fluid_part.hpp"

namespace sluice::ice {

class FluidBlocks : public BlockFacet {
 public:
  explicit FluidBlocks(const FluidPart& part) : part_(&part) {}

  int kinds() const override;
  int kind_of(const Warehouse& old_state, int local_box,
              const IndexBox& cells_with_ghosts) const override;
  std::optional<double> absent_value(Label label, int material, int kind) const override;
  BlockSize size() const override {
    return part_->scene().solids > 0 ? BlockSize::small : BlockSize::large;
  }
  bool skipping_allowed() const override;
  // What the sweep leaves in blocks that solids meet is no state yet.
  bool may_be_skipped(int kind) const override { return !has_cut_cells(kind); }
  bool has_cut_cells(int kind) const { return part_->scene().solids > 0 && kind == cut_kind(); }

 private:
  int cut_kind() const { return kinds() - 1; }
  bool meets_solid(const Warehouse& state, int box, const IndexBox& cells) const;

  const FluidPart* part_;
};

}  // namespace sluice::ice
