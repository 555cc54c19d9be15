// Cells of each level over time: levels.txt in the archive, a line whenever they change.
//
//   # step  time  level 0  level 1 ...
//   0<TAB>0<TAB>10000<TAB>2560
//
// The numbers of a line hold until the next one; the last line is that of the run's end. A run on
// one level writes no such file. The ranks call all functions; the root writes.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "framework/analysis/sample_file.hpp"

namespace sluice {

class LevelHistory {
 public:
  // `levels`: those that may ever exist.
  LevelHistory(int levels, bool is_root);

  // Where to write; before that nothing is kept.
  void open(std::filesystem::path folder);
  // The lines of an earlier archive up to the time of a restart.
  void adopt(const std::filesystem::path& earlier, double time);
  // The cells of the levels after a coarse step that ended at `time` (s), as the next one will be
  // made with.
  void sample(int step, double time, const std::vector<std::int64_t>& cells);
  // Before outputs and checkpoints.
  void flush();
  // A line for the end of the run, unless its last step has one.
  void finish();

 private:
  void append();

  AnalysisFile file_;
  std::filesystem::path folder_;
  bool writes_ = false;  // this rank, in a run with several levels
  int step_ = 0, written_step_ = -1;
  double time_ = 0;
  std::vector<std::int64_t> cells_;
};

}  // namespace sluice
