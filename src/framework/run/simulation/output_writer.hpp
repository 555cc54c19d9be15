// What a run keeps: which labels, when, as pieces for the archive.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/archive/archive_writer.hpp"
#include "framework/run/analysis/analysis_recorder.hpp"
#include "framework/run/component/component.hpp"
#include "framework/run/levels/hierarchy.hpp"
#include "framework/scene/scene.hpp"

namespace sluice {

// The labels of a deck's <save> entries, sorted by how they are made.
struct SavedLabels {
  std::vector<Label> step;        // stored while a step runs
  std::vector<Label> diagnostic;  // computed from the state after it
  std::vector<Label> analysed;    // fields that analyses keep
  std::vector<Label> histories;   // reductions
  std::vector<Label> particles;
  std::vector<Label> on_grid;  // what particles have on the grid
};

// Throws InputError naming entry and nearest label when a label is unknown. `analysed`: labels of
// fields that analyses keep.
SavedLabels sort_saves(const OutputSettings& output, const Hierarchy& hierarchy,
                       const std::vector<Label>& analysed = {});

class OutputWriter {
 public:
  OutputWriter(const Scene& scene, const Component& component, Hierarchy& hierarchy,
               ArchiveWriter archive, AnalysisRecorder* analysis = nullptr);

  // Another component goes on, on levels like those before.
  void follow(const Scene& scene, const Component& component, Hierarchy& hierarchy,
              AnalysisRecorder* analysis);

  const SavedLabels& saved() const { return saved_; }
  // Labels that a step must store for this output.
  const std::vector<Label>& step_labels() const { return saved_.step; }

  // The states are those after the step; ghosts need not be filled.
  void write_output(const StepInfo& info, bool initial);
  void write_checkpoint(const StepInfo& info);
  bool writes_histories(int step) const;  // is a line due after this step
  void write_histories(int step, double time, const Totals& totals);  // time: s
  void finish(const std::string& run_json);

  std::string archive_folder() const { return archive_.folder().string(); }
  // What a user should know although the run goes on.
  const std::vector<std::string>& warnings() const { return archive_.warnings(); }
  double seconds() const { return seconds_; }  // wall time of all writing

 private:
  void add_output_pieces(LevelSolver& solver, bool initial, std::vector<FieldPiece>& pieces) const;
  void add_analysed_pieces(LevelSolver& solver, std::vector<FieldPiece>& pieces) const;
  void add_checkpoint_pieces(LevelSolver& solver, std::vector<FieldPiece>& pieces) const;
  bool wants(Label label, int material, int level, const SaveRequest*& request) const;

  const Scene* scene_;
  const Component* component_;
  Hierarchy* hierarchy_;
  AnalysisRecorder* analysis_;  // or null
  ArchiveWriter archive_;
  SavedLabels saved_;
  double seconds_ = 0;
};

}  // namespace sluice
