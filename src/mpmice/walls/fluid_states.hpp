// What solids see of the fluid in the cells near them, as the step begins: of cells of all ranks
// that share blocks.
#pragma once
#include "mpmice/fields/fluid_cells.hpp"
#include "mpmice/fields/owner_values.hpp"
#include "mpmice/surfaces/solid_geometry.hpp"

namespace sluice::mpmice {

template <int D>
class FluidStates {
 public:
  // `looks_far`: somebody asks farther from solids than beside them (solves, explosives).
  FluidStates(const ice::FluidPart& fluid, bool looks_far)
      : fluid_(&fluid), looks_far_(looks_far) {}

  // Of this rank's cells with fluid, for those that share their blocks; after a solve (`solved`)
  // the pressure is that which was solved for, and nobody asks for the viscosity.
  void gather(const NearCells<D>& near, const Warehouse& state, bool solved);
  CellSums<D>& sums() { return known_.sums(); }
  // The largest rho c of this rank's cells, before all are known; kg/(m^2 s).
  double highest_impedance() const;
  // Once all are known.
  void take();

  // By cell; 0 without fluid: kg/m^3, Pa, m/s, m/s, Pa s.
  const Column& density() const { return density_; }
  const Column& pressure() const { return pressure_; }
  const Column& sound() const { return sound_; }
  const std::array<Column, D>& velocity() const { return velocity_; }
  const Column& viscosity() const { return viscosity_; }

  static constexpr int columns = 4 + D, lanes = 4 + D;

 private:
  enum Lane { of_density, of_pressure, of_speed, of_velocity, of_viscosity = of_velocity + D };
  CellMask cells_asked(const NearCells<D>& near) const;

  const ice::FluidPart* fluid_;
  bool looks_far_;
  bool viscous_ = false;
  OwnerValues<D> known_;
  Column density_, pressure_, sound_, viscosity_;
  std::array<Column, D> velocity_;
};

}  // namespace sluice::mpmice
