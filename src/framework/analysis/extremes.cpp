// Minima and maxima over the boxes of a level.
#include "framework/analysis/extremes.hpp"
#include "framework/base/infinity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace sluice {
namespace {

namespace fs = std::filesystem;

// The indices of a label in a box. What closes a box is stored with it, and the box beyond, if
// there is one, has the same value there.
IndexBox indices_in(const IndexBox& cells, Label label, const Level& level) {
  IndexBox box = cells;
  const IntVec3 closing = closing_layers(label.info().centring);
  for (int d = 0; d < 3; ++d)
    if (level.active[d]) box.upper[d] += closing[d];
  return box;
}

std::string bracketed(const std::vector<double>& v) {
  if (v.size() == 1) return fmt::format("{:.17g}", v.front());
  return fmt::format("[{:.17g}]", fmt::join(v, " "));
}

}  // namespace

ExtremesSampler::ExtremesSampler(int level, const std::vector<AnalysedQuantity>& quantities)
    : LevelSampler({}) {
  std::set<std::string> names;
  for (const AnalysedQuantity& q : quantities) {
    const std::string name = fmt::format("MinMax/L-{}/{}_{}", level, q.label.name(), q.material);
    if (!names.insert(name).second) continue;
    quantities_.push_back(q);
    files_.emplace_back(name,
                        fmt::format("# time[s] minimum maximum of {} [{}], material {}\n",
                                    q.label.name(), q.label.info().unit, q.material),
                        0);
  }
}

void ExtremesSampler::pack(const Warehouse& outputs, int /*rank*/,
                           std::vector<double>& numbers) const {
  for (const AnalysedQuantity& q : quantities_) {
    const int slot = outputs.find(q.label, q.material);
    for (int c = 0; c < q.components; ++c) {
      double least = infinity, most = -infinity;
      for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b) {
        const RealView v = outputs.view(slot, c, b);
        for_each_cell(indices_in(outputs.local_boxes()[b].cells, q.label, outputs.level()),
                      [&](IntVec3 i) {
                        const double x = v(i) + 0.0;  // -0 becomes 0: their order would show
                        least = std::min(least, x);
                        most = std::max(most, x);
                      });
      }
      numbers.push_back(least);
      numbers.push_back(most);
    }
  }
}

void ExtremesSampler::write(RankNumbers& numbers, int /*step*/, double time) {
  for (std::size_t n = 0; n < quantities_.size(); ++n) {
    const std::size_t components = quantities_[n].components;
    std::vector<double> least(components, infinity), most(components, -infinity);
    for (int r = 0; r < numbers.ranks(); ++r) {
      const double* own = numbers.take(r, 2 * components);
      for (std::size_t c = 0; c < components; ++c) {
        least[c] = std::min(least[c], own[2 * c]);
        most[c] = std::max(most[c], own[2 * c + 1]);
      }
    }
    files_[n].append(fmt::format("{:.17g} {} {}", time, bracketed(least), bracketed(most)));
  }
}

void ExtremesSampler::flush(const fs::path& folder) {
  for (AnalysisFile& f : files_) f.flush(folder);
}

void ExtremesSampler::adopt(const fs::path& earlier, const fs::path& folder, double time) const {
  for (const AnalysisFile& f : files_) f.adopt(earlier, folder, time);
}

}  // namespace sluice
