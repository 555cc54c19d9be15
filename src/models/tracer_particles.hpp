// Model "TracerParticles": points that move with a material and act on nothing. Plain data.
//
// They stand in regions at the start, and appear in others from timeStart to timeStop: in each cell
// of a region the n-th one (n = 0, 1, ...) at timeStart + (n + 1/2)/particlesPerCellPerSecond. A
// particle may carry a number that decays from when it appears: dq/dt = -(c1 c2 + c3) q.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/deck/deck.hpp"
#include "framework/field/label.hpp"
#include "framework/scene/geometry_reader.hpp"
#include "models/time_window.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

struct TracerRegion {
  PiecePtr piece;
  double number = 0;  // a cell; of a source: a cell and second
};

// What each particle carries.
struct TracerScalar {
  std::string name;  // of its variable
  double initial = 0;
  double decay = 0;  // 1/s
  Label label() const;
};

struct TracerParticles {
  std::string name;
  int material = 0;
  TimeWindow window;  // of the sources
  std::vector<TracerRegion> start, sources;
  std::optional<TracerScalar> scalar;
  double refine_distance = -1;  // around particles; below 0: they ask for no finer level
  Location where;
};

TagSpec tracer_particles_tag();
void check_tracer_particles(const DeckNode& parameters, const std::vector<std::string>& materials,
                            std::vector<Fault>& faults);
TracerParticles read_tracer_particles(const DeckNode& parameters,
                                      const std::vector<std::string>& materials,
                                      const GeometryReader& geometry, std::vector<Fault>& faults);
// Variables that particles of every material have, and those of these ones beside them.
const std::vector<std::string>& particle_variables();
std::vector<std::string> tracer_labels(const DeckNode& parameters);

}  // namespace sluice::models
