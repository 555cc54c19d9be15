// From amounts of cells to the state of the fluid in them, of several fluids at one pressure.
#pragma once
#include "mpmice/amounts/fluid_amounts.hpp"

namespace sluice::mpmice {

// Largest rates of sound and flow in cells, 1/s: what the deck's factor, flow alone and sound rest
// on.
struct CellRates {
  double deck = 0, flow = 0, sound = 0;
};

template <int D>
class SettledFluid {
 public:
  explicit SettledFluid(const ice::FluidPart& fluid) : fluid_(&fluid) {}

  // A gap that no fluid has reached closes: it waits. False: some of this rank's cells are in no
  // state, and the first says so in `reason`.
  bool settle(const NearCells<D>& near, CellAmounts<D>& amounts, SolidGeometry<D>& solid,
              std::string& reason);
  // 1: what is left there is no state.
  const CellMask& inadmissible() const { return inadmissible_; }
  // In this rank's cells that solids touch; the sweep has rated the others.
  CellRates rates(const NearCells<D>& near, const CellAmounts<D>& amounts) const;
  // Cells without fluid hold the mean of the states around them, two layers deep.
  void fill_dry(const NearCells<D>& near, const CellAmounts<D>& amounts);
  // Into the new state. Cells deep in a solid keep what they had before.
  void store(const Frame<D>& frame, const CellAmounts<D>& amounts, const Column& theta,
             const Warehouse& before, Warehouse& next) const;

 private:
  struct OneCell;
  bool settle_cell(const CellAmounts<D>& amounts, std::size_t i,
                   const ice::mixture::Equilibration& laws, OneCell& cell) const;
  void settle_scalars(const CellAmounts<D>& amounts, std::size_t i);
  std::string fault_of(const CellAmounts<D>& amounts, std::size_t i, IntVec3 at,
                       const OneCell& cell) const;

  const ice::FluidPart* fluid_;
  CellAmounts<D> settled_;  // per volume of fluid
  CellMask filled_;         // 1: they are known
  CellMask inadmissible_;
};

}  // namespace sluice::mpmice
