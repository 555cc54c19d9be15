// What a run of particles in stages carries and does: found by setting its initial state.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/loading/scene_loader.hpp"
#include "framework/run/component/component.hpp"

namespace sluice {

// The particles of a material at the start.
struct PlannedKind {
  std::string name;
  int material = 0;
  std::int64_t count = 0;
  int numbers = 0;            // that each carries, position and id among them
  int temporary_numbers = 0;  // that a step makes beside them
  int numbers_written = 0;    // into a checkpoint
  double bytes() const { return 8.0 * static_cast<double>(count) * (numbers + temporary_numbers); }
};

struct PlannedParticles {
  std::vector<PlannedKind> kinds;   // none: the run has no particles that move in stages
  std::vector<std::string> stages;  // of a step
  bool known = true;                // the counts
  std::optional<StepLimit> limit;   // of the first step; found by setting the particles

  bool any() const { return !kinds.empty(); }
  double bytes() const;
  double checkpoint_bytes() const;
};

// Kinds and counts alone, without making a particle.
PlannedParticles count_particles(const LoadedScene& loaded);

// A coarsest level with more than `max_cells` cells is not set, nor are particles that would take
// more than half of the memory that there is: they are counted.
PlannedParticles plan_particles(const LoadedScene& loaded, std::int64_t max_cells);

// For people: a line a kind, and the stages. Empty where there are none.
std::string particles_text(const PlannedParticles& particles);

}  // namespace sluice
