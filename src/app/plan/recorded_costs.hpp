// What a step costs, recorded on the machine of tools/bench/recorded.json: nanoseconds of processor
// time of a cell or of a particle, by component, dimension and effects.
//
// The figures of fluids are those of ./dev bench; those of solids and of coupled runs are fits to
// its decks (docs/plan_and_costs.md tells how far they are off). All are of whole runs, so that
// what is not named here is in them on the average.
#pragma once
#include <string>
#include <vector>

namespace sluice {

struct UnitCosts {
  double cell_ns = 0;      // of a cell updated
  double particle_ns = 0;  // of a particle
  double step_s = 0;       // of a step, however small the problem is
};

// dimensions: 1 to 3. effects: that are on. levels: of a run with several, cells cost more: ghost
// cells, matching and regrids are in them, and that levels grow. interpolator: of particles.
UnitCosts recorded_costs(const std::string& component, int dimensions,
                         const std::vector<std::string>& effects, bool levels,
                         const std::string& interpolator);

// Waves that start from rest become faster: the steps of a fluid are shorter than those of its
// start, by this much on the average.
inline constexpr double fluid_speeds_up = 1.4;
inline constexpr double start_s = 0.03;    // of the process, to its first step
inline constexpr double output_s = 0.006;  // of an output or checkpoint, however small
inline constexpr double written_bytes_per_s = 6e8;
inline constexpr double output_overhead_bytes = 20'000;  // XML and HDF5 beside the values
inline constexpr double start_cell_ns = 250;             // initial state, of a cell
inline constexpr double start_particle_ns = 1500;        // and of a particle

// Time of a fixed piece of arithmetic on this machine over that of the recorded one; measured once,
// in some milliseconds.
double machine_factor();

}  // namespace sluice
