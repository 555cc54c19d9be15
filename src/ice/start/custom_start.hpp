// What an initial state that a deck names by its kind does to one material in one cell.
#pragma once
#include "ice/deck/custom_start.hpp"

namespace sluice::ice {

// One material in one cell.
struct CellStart {
  Vec3 centre{};                        // m
  double density = 1, temperature = 0;  // kg/m^3, K
  Vec3 velocity{};                      // m/s
  double viscosity = 0;                 // Pa s
  double pressure = 0;                  // Pa
  bool pressure_given = false;  // by a start: the pressure is not that of density and temperature
};

// What a start may ask besides the cell.
struct CustomPlace {
  const Level& coarsest;
  double reference_pressure = 0;  // Pa
};

void apply(const CustomStart& start, const CustomPlace& place, CellStart& cell);

}  // namespace sluice::ice
