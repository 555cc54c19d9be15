// Fluid and solids where they meet at the start of a step: states, pressure, friction, forces.
#pragma once
#include "mpmice/surfaces/surfaces.hpp"
#include "mpmice/walls/wall_forces.hpp"

namespace sluice::mpmice {

template <int D>
class Walls {
 public:
  // `looks_far`: somebody asks for states of the fluid farther from solids than beside them.
  Walls(const ice::FluidPart& fluid, const solids::CoupledSolids& solids, bool looks_far);
  Walls(const Walls&) = delete;  // forces refer to pressure and friction
  Walls& operator=(const Walls&) = delete;

  FluidStates<D>& states() { return states_; }
  // `impedance`: as Surfaces::add_means has it.
  void begin(const Frame<D>& frame, double impedance, double dt) {
    light_.begin(frame, impedance, dt);
  }
  // Once the states are those of all ranks. After a solve (`solved`) friction stays as it is.
  // Collective where walls may be light.
  void find(const NearCells<D>& near, const SolidSets<D>& sets, const Surfaces<D>& surfaces,
            double dt, bool solved, Communicator& ranks);

  const SmoothNormals<D>& normals() const { return normals_; }
  const WallPressure<D>& pressure() const { return pressure_; }
  WallForces<D>& forces() { return forces_; }
  // What the fluid gives to surfaces by friction leaves the amounts of its cells.
  void take_friction(const NearCells<D>& near, const Surfaces<D>& surfaces, double dt,
                     CellAmounts<D>& amounts) const;

 private:
  const ice::FluidPart* fluid_;
  bool viscous_;
  FluidStates<D> states_;
  SmoothNormals<D> normals_;
  LightWalls<D> light_;
  WallPressure<D> pressure_;
  WallFriction<D> friction_;
  WallForces<D> forces_;
};

}  // namespace sluice::mpmice
