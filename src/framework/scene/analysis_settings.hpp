// The deck's <DataAnalysis>: what is looked at while the run goes on.
#pragma once
#include <string>
#include <vector>

#include "framework/scene/index_set.hpp"

namespace sluice {

struct AnalysedVariable {
  std::string label;
  int material = 0;
  IndexSet levels;
  Location where;
};

struct AnalysedLine {
  std::string name;
  Vec3 start{}, end{};
  double step = 0;  // length; 0: every cell
  Location where;
};

// A sample is taken when time_start <= t + dt <= time_stop and t + dt >= last + 1/frequency.
struct AnalysisModule {
  std::string name;               // minMax, lineExtract, vorticity
  std::string material_name;      // <material>, or empty
  int material = 0;               // default of variables that name none
  double sampling_frequency = 0;  // per unit time; 0: every step
  double time_start = 0;
  double time_stop = 0;
  std::vector<AnalysedVariable> variables;
  std::vector<AnalysedLine> lines;
  Location where;
};

struct AnalysisSettings {
  std::vector<AnalysisModule> modules;
};

// `node` is <DataAnalysis>, or nullptr. `materials` are the names in index order.
AnalysisSettings read_analysis_settings(const DeckNode* node,
                                        const std::vector<std::string>& materials,
                                        std::vector<Fault>& faults);

}  // namespace sluice
