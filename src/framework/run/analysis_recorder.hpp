// On-the-fly analysis: what <DataAnalysis> asks for, sampled while the run goes on.
//
//   minMax       MinMax/L-<level>/<label>_<material>    time minimum maximum
//   lineExtract  <line>/L-<level>/i<i>_j<j>_k<k>        X Y Z Timestep Time values
//
// in the archive's folder, 17 digits, '#' before header lines. Minimum and maximum of a vector are
// taken component by component and stand in brackets; a value on a line is that of the cell (of its
// low face for a face variable) and a vector fills three columns. A sample is taken at the end of a
// step, time t + dt, when timeStart <= t + dt <= timeStop and t + dt >= last + 1/samplingFrequency;
// the first one as soon as timeStart is reached. (vorticity is a label to be saved, no file.)
// What is written depends on neither ranks nor boxes: minima and maxima have no order, and a value
// on a line comes from the one box that owns the cell.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/run/analysis_file.hpp"
#include "framework/run/analysis_line.hpp"
#include "framework/run/level_solver.hpp"
#include "framework/scene/scene.hpp"

namespace sluice {

// May a module take a sample at this time, having taken the last one then.
bool sample_is_due(const AnalysisModule& module, std::optional<double> last, double time);

class AnalysisRecorder {
 public:
  // InputError naming entry and nearest label when a label is unknown. Keeps references.
  AnalysisRecorder(const Scene& scene, LevelSolver& solver, Communicator& communicator);

  // Does any module write files.
  bool any() const { return !samplers_.empty(); }
  // What a user should know before the run: lines that leave the domain.
  const std::vector<std::string>& warnings() const { return warnings_; }

  // The archive that gets the files; `earlier` and `time`: where a restarted run comes from.
  void open(const std::filesystem::path& folder);
  void adopt(const std::filesystem::path& earlier, double time);

  // Labels that a step ending at this time must store.
  std::vector<Label> step_labels(double end) const;
  // Takes the samples that are due after an accepted step. Collective. True when it has filled the
  // ghost cells of the state.
  bool sample(int step, double time);
  // To disk. Collective.
  void flush();

  // For checkpoints: times of the last samples.
  std::string state() const;
  void restore(const std::string& json_text);

 private:
  struct Quantity {
    Label label;
    int material = 0;
    int components = 1;
  };
  struct Point {
    IntVec3 cell;
    int owner = 0;  // rank
    int box = -1;   // local box number there
  };
  // A module at work.
  struct Sampler {
    const AnalysisModule* module = nullptr;
    std::vector<Quantity> quantities;
    std::vector<Point> points;        // of all lines; empty: minima and maxima
    std::vector<AnalysisFile> files;  // one a quantity, or one a point
    std::optional<double> last;
    bool due(double time) const;
  };

  Quantity find_quantity(const AnalysedVariable& variable) const;
  void add_points(Sampler& sampler, std::set<std::string>& lines);
  Point find_point(IntVec3 cell) const;
  void add_minmax_files(Sampler& sampler) const;
  // This rank's share of a sample, as numbers that write() on rank 0 reads in the same order.
  void pack(const Sampler& sampler, std::vector<double>& numbers) const;
  void pack_extremes(const Quantity& q, std::vector<double>& numbers) const;
  void write(Sampler& sampler, const std::vector<std::vector<double>>& ranks,
             std::vector<std::size_t>& next, int step, double time) const;
  void write_extremes(Sampler& sampler, const std::vector<std::vector<double>>& ranks,
                      std::vector<std::size_t>& next, double time) const;
  // Rank 0 works; when it fails, every rank throws.
  void on_root(const std::function<void()>& work) const;

  const Scene* scene_;
  LevelSolver* solver_;
  Communicator* communicator_;
  std::vector<Sampler> samplers_;
  std::vector<std::string> warnings_;
  std::filesystem::path folder_;
  std::size_t pending_lines_ = 0;
};

}  // namespace sluice
