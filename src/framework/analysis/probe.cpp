// Points: their stencils, who holds the cells, and their files.
#include "framework/analysis/probe.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/grid/box_list.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;
constexpr double probe_rounding = 1e-9;  // share of a cell: decimal numbers of a deck

// Two cells along a direction and the weight of the second.
struct Pair {
  int first = 0, second = 0;
  double share = 0;
};

int wrapped(int i, const Level& level, int d) {
  const int n = level.domain.size()[d], low = level.domain.lower[d];
  return low + ((i - low) % n + n) % n;
}

Pair pair_around(double x, const Level& level, int d) {
  const int low = level.domain.lower[d], last = level.domain.upper[d] - 1;
  if (!level.active[d]) return {low, low, 0};
  const double at = (x - level.anchor[d]) / level.spacing[d] - 0.5;
  const auto i = static_cast<int>(std::floor(at));
  if (level.periodic[d]) return {wrapped(i, level, d), wrapped(i + 1, level, d), at - i};
  if (i < low) return {low, low, 0};
  if (i >= last) return {last, last, 0};
  return {i, i + 1, at - i};
}

bool outside(Vec3 x, const Level& level) {
  for (int d = 0; d < 3; ++d) {
    if (!level.active[d]) continue;
    const double at = (x[d] - level.anchor[d]) / level.spacing[d];
    if (at < level.domain.lower[d] - probe_rounding || at > level.domain.upper[d] + probe_rounding)
      return true;
  }
  return false;
}

}  // namespace

ProbeStencil stencil_around(Vec3 position, const Level& level) {
  ProbeStencil s;
  if (outside(position, level)) return s;
  Pair along[3];
  for (int d = 0; d < 3; ++d) along[d] = pair_around(position[d], level, d);
  for (int corner = 0; corner < 8; ++corner) {
    IntVec3 cell;
    double weight = 1;
    for (int d = 0; d < 3; ++d) {
      const bool second = (corner >> d) % 2 == 1;
      cell[d] = second ? along[d].second : along[d].first;
      weight *= second ? along[d].share : 1.0 - along[d].share;
    }
    if (weight == 0.0) continue;
    s.cells.push_back(cell);
    s.weights.push_back(weight);
  }
  return s;
}

Probes::Probes(const std::vector<AnalysedPoint>& points,
               const std::vector<AnalysedQuantity>& quantities)
    : points_(points), current_(points.size()) {
  std::string heads;
  for (const AnalysedQuantity& q : quantities) heads += columns_of(q);
  for (const AnalysedPoint& p : points)
    files_.emplace_back(fs::path("points") / p.name,
                        fmt::format("# at {:.17g} {:.17g} {:.17g}\n# Timestep Time Level{}\n",
                                    p.position.x, p.position.y, p.position.z, heads),
                        1);
}

void Probes::set(std::size_t point, int level, std::vector<double> values) {
  current_[point] = {level, std::move(values)};
}

void Probes::end_sample(int step, double time) {
  for (std::size_t n = 0; n < files_.size(); ++n) {
    if (current_[n].level >= 0)
      files_[n].append(fmt::format("{} {:.17g} {} {:.17g}", step, time, current_[n].level,
                                   fmt::join(current_[n].values, " ")));
    current_[n] = {};
  }
}

void Probes::flush(const fs::path& folder) {
  for (AnalysisFile& f : files_) f.flush(folder);
}

void Probes::adopt(const fs::path& earlier, const fs::path& folder, double time) const {
  for (const AnalysisFile& f : files_) f.adopt(earlier, folder, time);
}

ProbeSampler::ProbeSampler(const Level& level, std::vector<AnalysedQuantity> quantities,
                           std::shared_ptr<Probes> probes)
    : LevelSampler(std::move(quantities)), level_(level.index), probes_(std::move(probes)) {
  for (const AnalysedPoint& p : probes_->points())
    stencils_.push_back(stencil_around(p.position, level));
  held_.resize(stencils_.size());
}

void ProbeSampler::lay_out(const Level& level) {
  const std::vector<int> numbers = local_numbers(level.boxes);
  std::vector<IndexBox> cells;
  for (const GridBox& b : level.boxes) cells.push_back(b.cells);
  const BoxFinder finder(std::move(cells));
  for (std::size_t n = 0; n < stencils_.size(); ++n) {
    held_[n].clear();
    for (const IntVec3 cell : stencils_[n].cells) {
      const std::vector<int> found = finder.overlapping({cell, cell + IntVec3::all(1)});
      if (found.empty()) {
        held_[n].clear();
        break;
      }
      const std::size_t b = found.front();
      held_[n].push_back({cell, level.boxes[b].owner, numbers[b]});
    }
  }
}

void ProbeSampler::pack(const Warehouse& outputs, int rank, std::vector<double>& numbers) const {
  for (const std::vector<Place>& places : held_)
    for (const Place& p : places) {
      if (p.owner != rank) continue;
      for (const AnalysedQuantity& q : quantities_)
        for (int c = 0; c < q.components; ++c)
          numbers.push_back(outputs.view(outputs.find(q.label, q.material), c, p.box)(p.cell));
    }
}

void ProbeSampler::write(RankNumbers& numbers, int /*step*/, double /*time*/) {
  std::size_t columns = 0;
  for (const AnalysedQuantity& q : quantities_) columns += q.components;
  for (std::size_t n = 0; n < held_.size(); ++n) {
    if (held_[n].empty()) continue;
    std::vector<double> values(columns, 0.0);
    for (std::size_t p = 0; p < held_[n].size(); ++p) {
      const double* own = numbers.take(held_[n][p].owner, columns);
      for (std::size_t c = 0; c < columns; ++c) values[c] += stencils_[n].weights[p] * own[c];
    }
    probes_->set(n, level_, std::move(values));
  }
}

void ProbeSampler::end_sample(int step, double time) {
  if (level_ == 0) probes_->end_sample(step, time);
}

void ProbeSampler::flush(const fs::path& folder) {
  if (level_ == 0) probes_->flush(folder);
}

void ProbeSampler::adopt(const fs::path& earlier, const fs::path& folder, double time) const {
  if (level_ == 0) probes_->adopt(earlier, folder, time);
}

}  // namespace sluice
