// The fluids' state in single cells, for those who do not sweep rows.
#pragma once
#include <optional>

#include "framework/field/warehouse.hpp"
#include "ice/closure/equilibrate.hpp"
#include "ice/fluid_part.hpp"

namespace sluice::mpmice {

// What walls see of a cell.
struct FluidState {
  double rho = 0, pressure = 0, sound = 0;
  Vec3 velocity{};
};

class FluidBox;

// Slots of the fluids in a state.
class FluidCells {
 public:
  FluidCells(const ice::FluidPart& part, const Warehouse& state);
  FluidBox box(int b) const;
  int materials() const { return static_cast<int>(mass.size()); }

  const ice::FluidPart* part;
  const Warehouse* state;
  ice::mixture::Equilibration laws;
  std::vector<int> mass, energy, volume;  // slots by material; volume: of several
  std::vector<int> slip;                  // likewise, of those that move apart
  std::vector<int> scalar;                // of each scalar of the fluids
  std::vector<std::size_t> carrier;       // and the material that carries it
  int momentum, fraction;
  std::array<int, 3> direction;
  int components;
};

class FluidBox {
 public:
  FluidBox(const FluidCells& cells, int b);
  FluidState at(IntVec3 cell) const;
  double viscosity(IntVec3 cell) const;  // molecular: sum V_m mu_m, Pa s
  double& mass(int m, IntVec3 c) const { return mass_[static_cast<std::size_t>(m)](c); }
  double& energy(int m, IntVec3 c) const { return energy_[static_cast<std::size_t>(m)](c); }
  // Of several fluids; one alone fills what solids leave.
  double& volume(int m, IntVec3 c) const { return volume_[static_cast<std::size_t>(m)](c); }
  double& momentum(int component, IntVec3 c) const {
    return momentum_[static_cast<std::size_t>(component)](c);
  }
  // Kinetic energy of what moves against the mixture, per volume of fluid; makes it move with it.
  double energy_of_slip(IntVec3 c) const;
  void bind(IntVec3 c) const;
  // Per mass of its carrier.
  double& scalar(std::size_t s, IntVec3 c) const { return scalar_[s](c); }
  double& fraction(IntVec3 c) const { return fraction_(c); }

 private:
  FluidState of_one(IntVec3 cell) const;
  FluidState of_several(IntVec3 cell) const;

  const FluidCells* cells_;
  std::vector<RealView> mass_, energy_, volume_, scalar_;
  std::array<RealView, 3> momentum_;
  std::vector<std::array<RealView, 3>> slip_;
  RealView fraction_;
};

// Work pressure of a semi-implicit step, X- or X- + d; else the pressure itself.
class WorkPressure {
 public:
  WorkPressure(const ice::FluidPart& part, const Warehouse& state, bool solved);

  class Box {
   public:
    double at(IntVec3 c, double p) const {
      if (offset_) p += (*offset_)(c);
      return increment_ ? p + (*increment_)(c) : p;
    }

   private:
    friend class WorkPressure;
    std::optional<RealView> offset_, increment_;
  };
  Box box(int b) const;

 private:
  const Warehouse* state_;
  int offset_ = -1, increment_ = -1;  // slots
};

}  // namespace sluice::mpmice
