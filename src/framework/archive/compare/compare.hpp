// Comparing two archives, whatever their boxes and ranks. Particles are paired by their ids.
//
// Two numbers differ when |a - b| > abs and |a - b| > rel max(|a|, |b|); both bounds are 0 unless
// given, so that any difference counts. NaN differs from everything, -0 equals +0. a, b and abs
// have the unit of the label, rel has none.
// Archives are not comparable when grids, times, labels, materials or covered cells differ; with
// CompareOptions::means other resolutions and levels are: as means on the coarser grid
// (coarse_means.hpp), without particles.
//
// An archive in Uintah's raw layout is compared with one of Sluice in what both hold: outputs are
// paired by nearest time, labels by label_names.hpp, particles by particle_pairs.hpp; extra cells
// do not count. What only one of them holds is a note.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"
#include "framework/archive/compare/label_names.hpp"
#include "framework/archive/compare/step_pairs.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {

struct CompareOptions {
  double absolute = 0, relative = 0;
  LabelFilter labels;
  bool checkpoints = false;   // compare these instead of the outputs
  bool common_times = false;  // only steps whose times both have
  // s; given: steps are paired by nearest time, at most this far apart
  std::optional<double> time_tolerance = {};
  std::vector<LabelName> names = {};  // between formats, before those of the table
  bool means = false;                 // where grids differ: means on the coarser grid
};

struct Difference {
  int step = 0;
  double time = 0;  // s
  std::string label;
  int level = 0, material = 0, component = 0, components = 1;
  IntVec3 index{};
  double a = 0, b = 0;
  std::int64_t particle = -1;  // its id; -1: a value of a cell, at `index`
  bool of_second = false;      // of means: the cell is one of the second archive
  double size() const;         // |a - b|; infinite when one is NaN
  double relative() const;     // |a - b| / max(|a|, |b|); infinite likewise
};
std::string to_string(const Difference&);

// One label, material, level and step in which something differs.
struct FieldDifference {
  Difference first, largest, largest_relative;
  std::int64_t differing = 0, values = 0;
  bool means = false;  // on the coarser grid, over all levels together
};

// Why steps cannot be compared: one cause, however many steps it spoils.
struct RefusedCause {
  std::string cause, detail;
  int step = 0;     // the first of them
  double time = 0;  // s
  int steps = 1;    // how many
  int last_step = 0;
};
std::string to_string(const RefusedCause&);

struct CompareResult {
  std::vector<std::string> not_comparable;  // of steps: `refused` as text
  std::vector<RefusedCause> refused;
  std::vector<std::string> notes;  // between formats: what only one archive holds
  std::vector<StepPair> paired;    // the steps that were compared
  std::vector<FieldDifference> fields;
  std::int64_t values = 0, differing = 0;
  int steps() const { return static_cast<int>(paired.size()); }
  // 0 equal, 1 different, 2 not comparable (although what could be compared was)
  int exit_status() const { return !not_comparable.empty() ? 2 : differing > 0 ? 1 : 0; }
  std::optional<Difference> first() const;
  std::optional<Difference> largest() const;
};

// One label, material and level over all steps in which something differs, in order of labels.
std::vector<FieldDifference> differences_by_label(const CompareResult& result);

bool numbers_differ(double a, double b, double absolute, double relative);
CompareResult compare(const Archive& a, const Archive& b, const CompareOptions& options);

// The .dat files that both indexes name, at the same times (history_table.hpp), with the same rule
// for numbers.
struct HistoryComparison {
  std::vector<std::string> not_comparable, differences;
  std::int64_t values = 0, differing = 0;
  int exit_status() const { return !not_comparable.empty() ? 2 : differing > 0 ? 1 : 0; }
};
HistoryComparison compare_histories(const Archive& a, const Archive& b,
                                    const CompareOptions& options);

// Why two levels cannot be compared index by index, or "".
std::string grid_mismatch(const Level& a, const Level& b);

}  // namespace sluice
