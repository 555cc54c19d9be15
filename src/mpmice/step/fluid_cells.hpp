// The fluid's state in single cells, for those who do not sweep rows.
#pragma once
#include <optional>

#include "framework/field/warehouse.hpp"
#include "ice/fluid_part.hpp"

namespace sluice::mpmice {

struct FluidState {
  double rho = 0, pressure = 0, sound = 0;
  Vec3 velocity{};
};

class FluidBox;

// Slots of one fluid in a state.
class FluidCells {
 public:
  FluidCells(const ice::FluidPart& part, const Warehouse& state);
  FluidBox box(int b) const;

  const ice::FluidPart* part;
  const Warehouse* state;
  int mass, momentum, energy;  // slots
  std::array<int, 3> direction;
  int components;
};

class FluidBox {
 public:
  FluidBox(const FluidCells& cells, int b);
  FluidState at(IntVec3 cell) const;
  double& mass(IntVec3 c) const { return mass_(c); }
  double& energy(IntVec3 c) const { return energy_(c); }
  double& momentum(int component, IntVec3 c) const {
    return momentum_[static_cast<std::size_t>(component)](c);
  }

 private:
  const FluidCells* cells_;
  RealView mass_, energy_;
  std::array<RealView, 3> momentum_;
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
