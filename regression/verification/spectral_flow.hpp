// A small spectral solver of incompressible flow in a periodic cube, as a reference.
#pragma once
#include <vector>

namespace sluice::verification {

// Kinetic energy per volume of the vortices of Taylor and Green, u = sin x cos y cos z,
// v = -cos x sin y cos z, w = 0 at the start, at a later time or at several, in their order. n:
// points along each side.
double taylor_green_energy(int n, double viscosity, double time);
std::vector<double> taylor_green_energies(int n, double viscosity,
                                          const std::vector<double>& times);

}  // namespace sluice::verification
