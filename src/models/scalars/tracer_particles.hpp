// Model "TracerParticles": points that move with a material and act on nothing. Plain data.
//
// They stand in regions at the start, and appear in others from timeStart to timeStop: in each cell
// of a region the n-th one (n = 0, 1, ...) at timeStart + (n + 1/2)/particlesPerCellPerSecond. A
// particle may carry a number that decays from when it appears: dq/dt = -(c1 c2 + c3) q, with c2 of
// its cell, and copies of scalars of its cell.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/deck/deck.hpp"
#include "framework/field/label.hpp"
#include "framework/scene/geometry_reader.hpp"
#include "models/scalars/exponential_decay.hpp"
#include "models/sources/time_window.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

struct TracerRegion {
  PiecePtr piece;
  double number = 0;  // particles per cell; of a source: per cell and second
};

// What each particle carries.
struct TracerScalar {
  std::string name;    // of its variable
  double initial = 0;  // in any unit
  Decay decay;
  Label label() const;
  // With a decay: c2 where the particle is; (c1 c2 + c3) dt summed since it appeared.
  Label coefficient() const;
  Label total() const;
};

struct TracerParticles {
  std::string name;
  int material = 0;
  TimeWindow window;  // of the sources
  std::vector<TracerRegion> start, sources;
  std::optional<TracerScalar> scalar;
  std::vector<std::string> clones;  // variables of cells that particles have copies of
  double refine_distance = -1;      // around particles, m; below 0: they ask for no finer level
  Location where;
};

TagSpec tracer_particles_tag();
void check_tracer_particles(const DeckNode& parameters, const std::vector<std::string>& materials,
                            std::vector<Fault>& faults);
TracerParticles read_tracer_particles(const DeckNode& parameters,
                                      const std::vector<std::string>& materials,
                                      const GeometryReader& geometry, std::vector<Fault>& faults);
Label clone_label(const std::string& variable);
// Variables that particles of every material have, and those of these ones beside them.
const std::vector<std::string>& particle_variables();
std::vector<std::string> tracer_labels(const DeckNode& parameters);
// Old decks save the copy of a variable as p.NAME: renamed, with a warning, unless a scalar of the
// particles has that name.
void rename_clones(DeckNode& root, std::vector<Fault>& faults);

}  // namespace sluice::models
