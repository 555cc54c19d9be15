// Heat given to a material everywhere, with constant power per mass.
#pragma once
#include "framework/deck/deck.hpp"
#include "models/sources/time_window.hpp"

namespace sluice::models {

struct AddedHeat {
  int material = 0;
  double power = 0;  // W/kg
  TimeWindow when;
  Location where;

  // J/kg in a step of length dt that begins at `time`.
  double energy(double time, double dt) const { return power * when.overlap(time, dt); }
};

}  // namespace sluice::models
