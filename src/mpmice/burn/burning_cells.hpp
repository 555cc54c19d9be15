// The field SteadyBurn.BurningCell: 1 where surfaces of the solid of a model Steady_Burn lost mass
// in the step. Kept only where the deck saves it.
#pragma once
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/scene/scene.hpp"
#include "framework/task/task.hpp"
#include "models/models.hpp"

namespace sluice::mpmice {

class BurningCells {
 public:
  BurningCells(const Scene& scene, const std::vector<models::SolidBurn>& burns);

  // Work slots of the coupling, by solid.
  const std::vector<SlotInfo>& slots() const { return slots_; }
  void clear(Warehouse& state) const;
  // `effect`: what the output belongs to.
  void declare(TaskList& diagnostics, int effect) const;

 private:
  std::vector<SlotInfo> slots_;
};

}  // namespace sluice::mpmice
