// What explosive that burns and detonates (DDT1) finds in cells: the same on every rank.
#pragma once
#include <cstdint>

#include "framework/base/kept_array.hpp"

namespace sluice::mpmice {

struct ExplosiveCells {
  // By cell. Mass of the explosive per volume of the cell at the start of the step, and of its
  // product, kg/m^3.
  KeptArray<double> reactant, product;
  KeptArray<double> pressure;  // of fluid and explosive together, Pa
  // Share of the explosive that detonates in the step; what burning adds to its product, kg/m^3.
  KeptArray<double> detonates, gain;
  // 1: explosive detonates there or beside it; hot enough to burn there, or beside it; a fluid that
  // counts as hot is there. Surfaces burn there in this step.
  KeptArray<std::uint8_t> beside_detonation, hot, beside_hot, hot_fluid, surface_burns;
  // Bits by models::Ignition::Kind of what burns there as the step begins, where flames need time.
  KeptArray<std::uint8_t> burning;
};

}  // namespace sluice::mpmice
