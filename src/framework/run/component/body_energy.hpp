// The energy of one body in a step, as a component sums it and the guard of energies judges it.
#pragma once
#include <string>

namespace sluice {

// What a step summed of one body (exact sums, rounded once); J and kg.
struct BodyEnergy {
  std::string name;
  int material = 0;
  double mass = 0;
  // 1/2 m v^2 with v-, (v- + v+)/2 and v+; stored energy before and after the step.
  double kinetic_before = 0, kinetic_middle = 0, kinetic_after = 0;
  double stored_before = 0, stored_after = 0;
  double work = 0;  // J . (v- + v+)/2 of all but the stress
  double kick = 0;  // J . (v+ - v-) of impulses that may be as large as the momentum
  // By what the work may be more: contact that holds a velocity works by that one, contact that
  // stops one by the middle of before and behind; which of both it is no node knows.
  double contact_slack = 0;
  double heat = 0;  // that came in, where heat can move
  // Of what the body had lost but to contact, what became heat of it; all that its particles have
  // lost since the start.
  double returned = 0, lost = 0;
  // Numbers of particles: that lost their neighbours (simulation/parted_bodies.hpp), and all.
  double parted = 0, particles = 0;
};

}  // namespace sluice
