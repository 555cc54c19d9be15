// Finding the boxes that hold the cells of lines, and sampling there.
#include "framework/analysis/points.hpp"

#include <fmt/format.h>

#include "framework/grid/box_list.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;
constexpr int time_of_point = 4;  // after X Y Z Timestep

std::string header_line(const std::vector<AnalysedQuantity>& quantities) {
  std::string header = "# X Y Z Timestep Time";
  for (const AnalysedQuantity& q : quantities) header += columns_of(q);
  return header + "\n";
}

}  // namespace

PointsSampler::PointsSampler(const Level& level, std::vector<AnalysedQuantity> quantities,
                             const std::vector<SampledLine>& lines)
    : LevelSampler(std::move(quantities)), level_(level.index), header_(header_line(quantities_)) {
  for (const AnalysedQuantity& q : quantities_) columns_ += q.components;
  for (const SampledLine& line : lines) {
    for (IntVec3 c : line.cells) candidates_.push_back({c, level.centre(c), names_.size()});
    names_.push_back(line.name);
  }
}

AnalysisFile PointsSampler::file_of(std::size_t candidate) const {
  const Candidate& c = candidates_[candidate];
  return AnalysisFile(
      fmt::format("{}/L-{}/i{}_j{}_k{}", names_[c.line], level_, c.cell.x, c.cell.y, c.cell.z),
      header_, time_of_point);
}

void PointsSampler::lay_out(const Level& level) {
  points_.clear();
  if (level.boxes.empty()) return;
  const std::vector<int> numbers = local_numbers(level.boxes);
  std::vector<IndexBox> cells;
  for (const GridBox& b : level.boxes) cells.push_back(b.cells);
  const BoxFinder finder(std::move(cells));
  for (std::size_t n = 0; n < candidates_.size(); ++n) {
    const IntVec3 cell = candidates_[n].cell;
    for (const int b : finder.overlapping({cell, cell + IntVec3::all(1)})) {
      points_.push_back({n, level.boxes[b].owner, numbers[b]});
    }
  }
}

void PointsSampler::pack(const Warehouse& outputs, int rank, std::vector<double>& numbers) const {
  std::vector<int> slots;
  for (const AnalysedQuantity& q : quantities_) slots.push_back(outputs.find(q.label, q.material));
  for (const Point& p : points_) {
    if (p.owner != rank) continue;
    for (std::size_t q = 0; q < quantities_.size(); ++q)
      for (int c = 0; c < quantities_[q].components; ++c)
        numbers.push_back(outputs.view(slots[q], c, p.box)(candidates_[p.candidate].cell));
  }
}

void PointsSampler::write(RankNumbers& numbers, int step, double time) {
  for (const Point& p : points_) {
    auto file = files_.find(p.candidate);
    if (file == files_.end()) file = files_.emplace(p.candidate, file_of(p.candidate)).first;
    const double* first = numbers.take(p.owner, columns_);
    const Vec3 x = candidates_[p.candidate].centre;
    file->second.append(fmt::format("{:.17g} {:.17g} {:.17g} {} {:.17g} {:.17g}", x.x, x.y, x.z,
                                    step, time, fmt::join(first, first + columns_, " ")));
  }
}

void PointsSampler::flush(const fs::path& folder) {
  for (auto& [candidate, file] : files_) file.flush(folder);
}

// The earlier run may have sampled any of the cells.
void PointsSampler::adopt(const fs::path& earlier, const fs::path& folder, double time) const {
  for (std::size_t n = 0; n < candidates_.size(); ++n) file_of(n).adopt(earlier, folder, time);
}

}  // namespace sluice
