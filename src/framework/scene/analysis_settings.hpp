// The deck's <DataAnalysis>: what is looked at while the run goes on. Places and lengths in m,
// times in s.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/index_set.hpp"

namespace sluice {

// How cells count in an average over a plane.
enum class Weighting { none, cells, mass };  // sum; sum / cells; sum of w q / sum of w

struct AnalysedVariable {
  std::string label;
  int material = 0;
  IndexSet levels;
  Weighting weighting = Weighting::none;
  bool reynolds_stress = false;  // computeReynoldsStress
  bool fluid_velocity = false;   // fluidVelocityLabel
  Location where;
};

struct AnalysedLine {
  std::string name;
  Vec3 start{}, end{};
  double step = 0;  // length; 0: every cell
  Location where;
};

// A rectangle along two axes: two opposite corners.
struct AnalysedPlane {
  std::string name;
  Vec3 start{}, end{};
  int normal = 0;  // the direction in which the corners agree
  Location where;
};

struct AnalysedPoint {
  std::string name;
  Vec3 position{};
  Location where;
};

// A side of a control volume through which fluxes count.
struct VolumeSide {
  bool counts = false;
  bool whole = true;  // else only the rectangle of these corners
  Vec3 start{}, end{};
};

// Whole domain, or a box.
struct ControlVolume {
  std::string name;
  bool whole = true;
  Vec3 low{}, high{};
  std::array<VolumeSide, 6> sides;  // x-, x+, y-, y+, z-, z+
  Location where;
  int flat = -1;  // the direction across which it is only a rectangle; -1: none
};

// A sample is taken when time_start <= t + dt <= time_stop and t + dt >= last + 1/frequency.
struct AnalysisModule {
  std::string name;               // minMax, lineExtract, vorticity, ...
  std::string material_name;      // <material>, or empty
  int material = 0;               // default of variables that name none
  double sampling_frequency = 0;  // per unit time; 0: every step
  double time_start = 0;
  double time_stop = 0;
  std::vector<AnalysedVariable> variables;
  std::vector<AnalysedLine> lines;
  std::vector<AnalysedPlane> planes;
  std::vector<AnalysedPoint> points;
  std::vector<ControlVolume> volumes;
  int plane_normal = 2;                      // planeOrientation
  std::string weight;                        // label of the weight of Weighting::mass
  std::optional<AnalysedVariable> velocity;  // of planeAvgTurbFluxes
  bool higher_order = false;                 // computeHigherOrderStats
  double energy_factor = 1;                  // engy_convt_factor, on energies in J
  double colour_threshold = 0;               // colorThreshold of particleExtract, without unit
  IntVec3 average_cells{1, 1, 1};            // avgBoxCells, odd
  // Where cells have averages: all, those whose box is whole, or the others.
  enum class AverageWhere { everywhere, interior, boundaries };
  AverageWhere average_where = AverageWhere::everywhere;  // domain
  Location where;
};

struct AnalysisSettings {
  std::vector<AnalysisModule> modules;
};

// `node` is <DataAnalysis>, or nullptr. `materials` are the names in index order.
AnalysisSettings read_analysis_settings(const DeckNode* node,
                                        const std::vector<std::string>& materials,
                                        std::vector<Fault>& faults);

// Where a module looks: its lines, planes, points and control volumes. (analysis_places.cpp)
void read_analysis_places(const DeckNode& module, AnalysisModule& m, std::vector<Fault>& faults);

}  // namespace sluice
