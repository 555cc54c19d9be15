// Norms of the difference of two archives, over the points of the first.
//
//   L1 = sum |d| / n     L2 = sqrt(sum d^2 / n)     Linf = max |d|      d = a - b
//
// per output, label, component, material and level. The first archive's domain may be a part of the
// second's. Where resolutions or levels differ, means on the coarser grid are compared over all
// levels together (coarse_means.hpp), weighted by the volumes of its cells; else points must
// coincide, or InputError. Sums are exact, rounded once. Archives of two formats are paired by
// nearest time and by label_names.hpp, over the points that both hold.
#pragma once
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"
#include "framework/archive/compare/label_names.hpp"
#include "framework/archive/compare/step_pairs.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {

struct NormsOptions {
  LabelFilter labels;
  std::string time;  // of the first archive, as for extract; empty: all outputs
  // s; given: outputs are paired by nearest time, at most this far apart
  std::optional<double> time_tolerance = {};
  std::vector<LabelName> names = {};  // between formats, before those of the table
};

inline constexpr int all_levels = -1;

struct NormsRow {
  double time = 0;        // s
  double other_time = 0;  // of the second archive
  int level = 0;          // all_levels: means on the coarser grid
  int material = 0;
  std::string label;  // vectors: label.x and so on
  std::int64_t points = 0;
  double l1 = 0, l2 = 0, linf = 0;  // in the unit of the label
};

struct NormsResult {
  std::vector<NormsRow> rows;
  std::vector<std::string> skipped;  // labels of the first archive that the second does not have
  std::vector<std::string> notes;    // outputs without a counterpart
};

NormsResult difference_norms(const Archive& a, const Archive& b, const NormsOptions& options);

// The output of b at each chosen one of a, as difference_norms pairs them.
std::vector<StepPair> paired_outputs(const Archive& a, const Archive& b,
                                     const NormsOptions& options, std::vector<std::string>& notes);

}  // namespace sluice
