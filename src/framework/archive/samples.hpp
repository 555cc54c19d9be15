// What a run has written as text beside its fields: histories, samples of <DataAnalysis>, cells of
// levels, seconds of effects. docs/analysis.md tells where the files lie.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {

// Files that belong together: those of the cells of a line, the snapshots of a plane, or one.
struct Sample {
  std::string name;  // as users give it: TotalMass, points/ahead, MinMax/L-0/press_CC_0
  std::string kind;  // history, extremes, probe, line, plane, average, budget, particle, levels,
                     // effects
  std::vector<std::filesystem::path> files;
  std::string unit;     // of a history, where the archive tells it
  bool vector = false;  // a history of three numbers
};

// All that an archive has: histories, then files of samples by name, then levels and effects.
std::vector<Sample> find_samples(const Archive& archive);

struct SampleTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // words as they stand in the file
};

// All lines, by time; of snapshots (planes, averages) with their time as first column. time: only
// the lines of the sampled time nearest to it, s. InputError for a file that is not such a table.
SampleTable read_sample(const Sample& sample, std::optional<double> time = {});
// The lines of a range of times. InputError where there is none, or the table has no times.
void keep_lines(SampleTable& table, const Sample& sample, const TimeRange& range);

}  // namespace sluice
