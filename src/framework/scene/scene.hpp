// What a deck means: grid, active directions, boundary conditions, run control. Plain data; nothing
// later asks the deck again (a component reads its own materials with a GeometryReader).
#pragma once
#include <array>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/scene/analysis_settings.hpp"
#include "framework/scene/boundary.hpp"
#include "framework/scene/directions.hpp"
#include "framework/scene/geometry_reader.hpp"
#include "framework/scene/grid_settings.hpp"
#include "framework/scene/output_settings.hpp"
#include "framework/scene/refinement_settings.hpp"
#include "framework/scene/time_settings.hpp"

namespace sluice {

struct SceneOptions {
  int ranks = 1;
  IntVec3 boxes{};                // forced split of every deck box; 0: as the deck says
  bool force_directions = false;  // every direction active
};

struct MaterialEntry {
  std::string name;  // attribute name; empty when the deck gives none
  std::string kind;  // "MPM" or "ICE"; MPM materials have the lower indices
  int index = 0;
  Location where;
};

struct PhysicalConstants {
  Vec3 gravity{};                 // m/s^2
  double reference_pressure = 0;  // Pa
  Location gravity_where;
};

struct Scene {
  std::string title;
  std::string component;  // type of <SimulationComponent>, lower case
  TimeSettings time;
  GridSettings grid_settings;
  Grid grid;  // every level that may ever exist; those of a regridder have no boxes yet
  RefinementSettings refinement;
  std::array<ActiveDirection, 3> directions;
  std::vector<MaterialEntry> materials;
  BoundaryConditions boundary;
  PhysicalConstants constants;
  OutputSettings output;
  AnalysisSettings analysis;
};

// Faults of the deck as a scene, all of them; the message lists them one a line.
class SceneError : public InputError {
 public:
  explicit SceneError(std::vector<Fault> faults);
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

// Adds errors and warnings to `faults`; the scene is good only when none of them is an error.
Scene read_scene(const Deck& deck, const SceneOptions& options, std::vector<Fault>& faults);
// Throws SceneError when there is an error; warnings are dropped.
Scene read_scene(const Deck& deck, const SceneOptions& options);

}  // namespace sluice
