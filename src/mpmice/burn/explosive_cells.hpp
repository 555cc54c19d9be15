// What explosive that burns and detonates (DDT1) finds in cells: the same on every rank.
#pragma once
#include <cstdint>
#include <vector>

namespace sluice::mpmice {

struct ExplosiveCells {
  // By cell. Mass of the explosive per volume of the cell at the start of the step, and of its
  // product, kg/m^3.
  std::vector<double> reactant, product;
  std::vector<double> pressure;  // of fluid and explosive together, Pa
  // Share of the explosive that detonates in the step; what burning adds to its product, kg/m^3.
  std::vector<double> detonates, gain;
  // 1: explosive detonates there or beside it; hot enough to burn there, or beside it; a fluid that
  // counts as hot is there. Surfaces burn there in this step.
  std::vector<std::uint8_t> beside_detonation, hot, beside_hot, hot_fluid, surface_burns;
  // Bits by models::Ignition::Kind of what burns there as the step begins, where flames need time.
  std::vector<std::uint8_t> burning;
};

}  // namespace sluice::mpmice
