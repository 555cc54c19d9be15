// On-the-fly analysis: what <DataAnalysis> asks for, sampled while the run goes on.
//
//   minMax       MinMax/L-<level>/<label>_<material>    time minimum maximum
//   lineExtract  <line>/L-<level>/i<i>_j<j>_k<k>        X Y Z Timestep Time values
//   planeExtract <plane>/tNNNNN/L-<level>/<label>_<material>.dat    X Y Z value
//   pointExtract points/<name>                          Timestep Time Level values
//   planeAverage, planeAvgTurbFluxes    see framework/analysis/average.hpp
//   statistics, turbulentFluxes    fields, see analysis_statistics.hpp
//   spatialAvg                     fields, see analysis_spatial.hpp
//   flatPlate_heatFlux    a history, see analysis_heat.hpp
//   particleExtract    see analysis_particles.hpp
//   controlVolFluxes, momentumAnalysis, firstLawThermo    see analysis_volume.hpp
//
// in the archive's folder, 17 digits, '#' before header lines; every level on its own, as far as
// the variable asks for it and the level exists. A negative level counts from the finest level that
// the deck allows, so that the columns of a file never change. A sample is taken at the end of a
// step, time t + dt, when timeStart <= t + dt <= timeStop and t + dt >= last + 1/samplingFrequency;
// the first one as soon as timeStart is reached. (vorticity and SGS_ReynoldsStress
// are labels to be saved, no files.)
// What is written depends on neither ranks nor boxes.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/analysis/modules.hpp"
#include "framework/analysis/sampler.hpp"
#include "framework/base/communicator.hpp"
#include "framework/run/analysis/analysis_heat.hpp"
#include "framework/run/analysis/analysis_particles.hpp"
#include "framework/run/analysis/analysis_spatial.hpp"
#include "framework/run/analysis/analysis_statistics.hpp"
#include "framework/run/analysis/analysis_volume.hpp"
#include "framework/run/levels/hierarchy.hpp"
#include "framework/scene/scene.hpp"

namespace sluice {

class AnalysisRecorder {
 public:
  // InputError naming entry and nearest label when a label is unknown. Keeps references.
  AnalysisRecorder(const Scene& scene, Hierarchy& hierarchy, Communicator& communicator);

  // Does any module write files.
  bool any() const { return !modules_.empty(); }
  // What a user should know before the run: lines that leave the domain.
  const std::vector<Fault>& warnings() const { return warnings_; }

  // The archive that gets the files; `earlier` and `time`: where a restarted run comes from.
  void open(const std::filesystem::path& folder);
  void adopt(const std::filesystem::path& earlier, double time);

  // Labels that a step ending at this time must store.
  std::vector<Label> step_labels(double end) const;
  // What passed through control volumes in an accepted step of length dt (s).
  void record(double dt, const std::vector<double>& sums);
  // Takes the samples that are due after an accepted step, on the levels that it was made with (a
  // regrid drops what the step has stored). Collective. True when it has filled the ghost cells of
  // the state.
  bool sample(int step, double time);
  // The boxes of levels may have changed: what is kept of cells moves with them. Collective.
  void follow_levels() { lay_out(); }
  // Fields that can be saved as labels, and their values into the outputs of all levels.
  std::vector<Label> field_labels() const;
  void store_fields(const std::vector<Label>& wanted, double time);
  // Labels of the state that the outputs must hold before that.
  std::vector<Label> sources_of(const std::vector<Label>& wanted) const;
  void add_checkpoint_pieces(std::vector<FieldPiece>& pieces) const;
  // What a history has after the last step; none that is no analysis.
  std::optional<double> history(Label label) const;
  // To disk. Collective.
  void flush();

  // For checkpoints: times of the last samples, what passed since. Fields need the levels of the
  // checkpoint.
  std::string state() const;
  void restore(const std::string& json_text, const ArchiveStep* checkpoint = nullptr);

 private:
  // A module at work.
  struct Module {
    const AnalysisModule* settings = nullptr;
    // By level that may exist; null where nothing is asked for.
    std::vector<std::unique_ptr<LevelSampler>> levels;
    std::unique_ptr<VolumeBudgets> budgets;        // of its control volumes, if it keeps some
    std::unique_ptr<Statistics> statistics;        // if it keeps some
    std::unique_ptr<CellAverages> averages;        // of boxes of cells, if it takes them
    std::unique_ptr<ParticleHistories> particles;  // if it follows some
    std::optional<double> last;
    // Averages are taken when they are written.
    bool due(double time) const { return !averages && sample_is_due(*settings, last, time); }
  };
  using Visit = std::function<void(int level, LevelSampler&)>;

  // Before the run, in analysis_modules.cpp.
  std::vector<int> materials_of(Label label) const;
  AnalysedQuantity find_quantity(const AnalysedVariable& variable) const;
  std::unique_ptr<VolumeBudgets> make_budgets(const AnalysisModule& module, int first);
  void check_labels(const std::vector<Label>& labels, const AnalysisModule& module) const;
  void add_particles(const AnalysisModule& module);
  void add_planes_of_heat(const AnalysisModule& module, int first, const Scene& scene);
  // Lines, planes and volumes: their names, and whether the domain holds them.
  void check_places(const AnalysisModule& module, std::set<std::string>& names);
  void check_place(const char* kind, const std::string& name, const Location& where, bool outside,
                   bool clipped, std::set<std::string>& names);
  void warn_of_place(const char* kind, const std::string& name, const Location& where, bool outside,
                     bool clipped);

  // The samplers of these modules on the levels that exist now, always in the same order.
  void visit(const std::vector<Module*>& modules, const Visit& work) const;
  void lay_out();
  bool compute_labels(const std::vector<Module*>& due, double time);
  // Rank 0 works; when it fails, every rank throws.
  void on_root(const std::function<void()>& work) const;

  Hierarchy* hierarchy_;
  Communicator* communicator_;
  std::vector<Module> modules_;
  HeatThroughPlanes heat_;
  std::vector<Fault> warnings_;
  std::filesystem::path folder_;
  int layouts_ = -1;  // of the hierarchy when boxes were last looked at
  std::size_t pending_lines_ = 0;
};

}  // namespace sluice
