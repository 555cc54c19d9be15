#include "verification/amr_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/archive/archive.hpp"
#include "framework/base/exact_sum.hpp"
#include "framework/grid/box_list.hpp"

namespace sluice::verification {
namespace {

// Which cells of a level the next finer one covers.
class Covered {
 public:
  Covered(const Level& level, const Level* finer) : domain_(level.domain) {
    flags_.resize(static_cast<std::size_t>(domain_.volume()));
    if (finer == nullptr) return;
    for (const GridBox& box : finer->boxes)
      for_each_cell(coarsen(box.cells, finer->ratio), [&](IntVec3 c) { flags_[at(c)] = true; });
  }
  bool operator()(IntVec3 c) const { return flags_[at(c)]; }

 private:
  std::size_t at(IntVec3 c) const {
    const IntVec3 n = domain_.size(), d = c - domain_.lower;
    return static_cast<std::size_t>(d.x) +
           static_cast<std::size_t>(n.x) *
               (static_cast<std::size_t>(d.y) +
                static_cast<std::size_t>(n.y) * static_cast<std::size_t>(d.z));
  }
  IndexBox domain_;
  std::vector<bool> flags_;
};

}  // namespace

std::vector<LevelCell> level_cells(const CaseRun& run, const std::string& variable, int component,
                                   const std::string& which, int material) {
  const Archive opened = Archive::open(run.archive());
  const ArchiveStep step = opened.read_output(opened.select_output(which));
  const std::vector<Level>& levels = step.grid().levels;
  std::vector<LevelCell> cells;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const FieldInfo* field = step.find(variable, material, static_cast<int>(l));
    if (field == nullptr)
      throw std::runtime_error(fmt::format("the archive holds no {} on level {}", variable, l));
    const Covered covered(levels[l], l + 1 < levels.size() ? &levels[l + 1] : nullptr);
    for (const GridBox& box : levels[l].boxes) {
      const DenseField values = step.read(*field, box.cells);
      for_each_cell(box.cells, [&](IntVec3 c) {
        cells.push_back({static_cast<int>(l), c, levels[l].centre(c), levels[l].cell_volume(),
                         values.at(c, component), covered(c)});
      });
    }
  }
  return cells;
}

double farthest_on_levels(const CaseRun& run, const std::string& variable, int component,
                          double wanted) {
  double farthest = 0;
  for (const LevelCell& cell : level_cells(run, variable, component)) {
    const double distance = std::abs(cell.value - wanted);
    if (!(distance <= farthest)) farthest = distance;  // a NaN stays
  }
  return farthest;
}

double distance_from(const CaseRun& run, const CellValues& finer, const std::string& variable) {
  ExactSum sum, volume;
  for (const LevelCell& cell : level_cells(run, variable)) {
    if (cell.covered) continue;
    const double cells = cell.volume / (finer.spacing.x * finer.spacing.y * finer.spacing.z);
    const auto many = static_cast<int>(std::lround(std::cbrt(cells)));
    const int nx = finer.size.z > 1 ? many : static_cast<int>(std::lround(std::sqrt(cells)));
    const int n[] = {nx, nx, finer.size.z > 1 ? many : 1};
    double mean = 0;
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
          mean += finer.at(cell.cell.x * n[0] + i, cell.cell.y * n[1] + j, cell.cell.z * n[2] + k);
    mean /= n[0] * n[1] * n[2];
    sum.add(cell.volume * std::abs(cell.value - mean));
    volume.add(cell.volume);
  }
  return sum.value() / volume.value();
}

std::vector<long> max_cells(const CaseRun& run) {
  std::vector<long> cells;
  for (const auto& level : run.record().at("levels")) cells.push_back(level.at("most_cells"));
  return cells;
}

long regrids(const CaseRun& run) {
  return run.record().at("regrids").get<long>();
}

double share_of_uniform(const CaseRun& run) {
  return run.record().at("cell_updates").get<double>() /
         run.record().at("uniform_updates").get<double>();
}

std::string level_resolution(int level, int nx, int ny, int nz) {
  return fmt::format("Grid/Level[{}]/Box/resolution=[{},{},{}]", level, nx, ny, nz);
}

std::string one_level() {
  return "AMR/Regridder/max_levels=1";
}

std::string dilation(int cells) {
  return fmt::format("AMR/Regridder/cell_stability_dilation=[{0},{0},{0}]", cells);
}

std::string threshold(int variable, double value) {
  return fmt::format("AMR/ICE/Refinement_Criteria_Thresholds/Variable[{}]/@value={:g}", variable,
                     value);
}

}  // namespace sluice::verification
