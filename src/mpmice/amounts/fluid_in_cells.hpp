// The fluid in cells near solids behind the sweep: amounts, what small cells share, its new state.
#pragma once
#include "mpmice/amounts/cell_merging.hpp"

namespace sluice::mpmice {

template <int D>
class FluidInCells {
 public:
  explicit FluidInCells(const ice::FluidPart& fluid) : fluid_(fluid), settled_(fluid) {}

  FluidAmounts<D>& fluid() { return fluid_; }
  CellAmounts<D>& amounts() { return fluid_.amounts(); }
  SettledFluid<D>& settled() { return settled_; }
  CellMerging<D>& merging() { return merging_; }
  void share(const NearCells<D>& near, const SolidGeometry<D>& solid,
             const SmoothNormals<D>& normals) {
    merging_.share(near, solid, normals, fluid_.amounts());
  }

 private:
  FluidAmounts<D> fluid_;
  SettledFluid<D> settled_;
  CellMerging<D> merging_;
};

}  // namespace sluice::mpmice
