// Fields of the cells in which solids burn: SteadyBurn.BurningCell, UnsteadyBurn.BurningCell,
// SurfTemp and SurfTempGrad; those of DDT1; modelMass_src. Each is kept only where the deck saves
// it.
#pragma once
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/scene/scene.hpp"
#include "framework/task/task.hpp"
#include "models/models.hpp"

namespace sluice::mpmice {

using models::BurningValue;

// An output of a law: its label in the archive, and that of the work slot that keeps it till then.
struct BurningField {
  BurningValue value = BurningValue::burns;
  Label saved, kept;
};
// Fluids that fill less of a cell than this share do not count as hot.
inline constexpr double seen_volume = 0.2;

// What can be saved of a law.
std::vector<BurningField> burning_fields(const models::SolidBurn& burn);

class BurningCells {
 public:
  // `other_sources`: fluids tell modelMass_src of their own.
  BurningCells(const Scene& scene, const std::vector<models::SolidBurn>& burns, int first_fluid,
               bool other_sources);

  // Work slots of the coupling, by solid.
  const std::vector<SlotInfo>& slots() const { return slots_; }
  void clear(Warehouse& state) const;
  // `effect`: what the outputs belong to.
  void declare(TaskList& diagnostics, int effect) const;

 private:
  std::vector<SlotInfo> slots_;
  std::vector<Label> saved_;  // of each slot
};

}  // namespace sluice::mpmice
