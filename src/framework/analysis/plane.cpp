// The cells of planes, and their values in the order of cells whatever boxes hold them.
#include "framework/analysis/plane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sluice {
namespace {

namespace fs = std::filesystem;
constexpr double decimal_rounding = 1e-9;  // share of a cell: decimal numbers of a deck

// Cells along one direction that hold more of [from, to] than an end; at least the one of `from`.
void cells_along(double from, double to, const Level& level, int d, PlaneCells& found) {
  const double low = (from - level.anchor[d]) / level.spacing[d];
  const double high = (to - level.anchor[d]) / level.spacing[d];
  const double begin = level.domain.lower[d], end = level.domain.upper[d];
  if (low < begin - decimal_rounding || high > end + decimal_rounding) found.clipped = true;
  if (high < begin - decimal_rounding || low > end + decimal_rounding) {
    found.cells.upper[d] = found.cells.lower[d];
    return;
  }
  const double first = std::clamp(std::floor(low + decimal_rounding), begin, end - 1);
  const double last = std::clamp(std::ceil(high - decimal_rounding), first + 1, end);
  found.cells.lower[d] = static_cast<int>(first);
  found.cells.upper[d] = static_cast<int>(last);
}

}  // namespace

PlaneCells cells_in_plane(const AnalysedPlane& plane, const Level& level) {
  PlaneCells found;
  for (int d = 0; d < 3; ++d) cells_along(plane.start[d], plane.end[d], level, d, found);
  if (found.cells.empty()) found.cells = {};
  return found;
}

PlaneSampler::PlaneSampler(const Level& level, std::vector<AnalysedQuantity> quantities,
                           const std::vector<SampledPlane>& planes)
    : LevelSampler(std::move(quantities)), geometry_(level) {
  geometry_.boxes.clear();
  for (const SampledPlane& p : planes)
    planes_.push_back({p, {}, SnapshotFiles(p.name, level.index)});
}

void PlaneSampler::lay_out(const Level& level) {
  lines_ = 0;
  const std::vector<int> numbers = local_numbers(level.boxes);
  for (Plane& plane : planes_) {
    plane.pieces.clear();
    for (std::size_t b = 0; b < level.boxes.size(); ++b) {
      const IndexBox cells = intersection(level.boxes[b].cells, plane.where.cells);
      if (cells.empty()) continue;
      plane.pieces.push_back({cells, level.boxes[b].owner, numbers[b]});
      lines_ += cells.volume() * quantities_.size();
    }
  }
}

// All faces or nodes of every cell: one between two boxes has the same value in both.
IndexBox PlaneSampler::indices_of(const IndexBox& cells, Label label) const {
  IndexBox indices = cells;
  const IntVec3 closing = closing_layers(label.info().centring);
  for (int d = 0; d < 3; ++d)
    if (geometry_.active[d]) indices.upper[d] += closing[d];
  return indices;
}

void PlaneSampler::pack(const Warehouse& outputs, int rank, std::vector<double>& numbers) const {
  for (const Plane& plane : planes_)
    for (const AnalysedQuantity& q : quantities_) {
      const int slot = outputs.find(q.label, q.material);
      for (const Piece& p : plane.pieces) {
        if (p.owner != rank) continue;
        for (int c = 0; c < q.components; ++c) {
          const ConstRealView v = outputs.view(slot, c, p.box);
          for_each_cell(indices_of(p.cells, q.label), [&](IntVec3 i) { numbers.push_back(v(i)); });
        }
      }
    }
}

std::string PlaneSampler::text_of(const Plane& plane, const AnalysedQuantity& q,
                                  RankNumbers& numbers, double time) const {
  const IndexBox all = indices_of(plane.where.cells, q.label);
  const std::size_t n = all.volume();
  const std::size_t components = q.components;
  std::vector<double> values(n * components);
  std::vector<char> held(n, 0);
  const IntVec3 size = all.size();
  auto place = [&](IntVec3 i) {
    const IntVec3 at = i - all.lower;
    return at.x + size.x * (at.y + static_cast<std::size_t>(size.y) * at.z);
  };
  for (const Piece& p : plane.pieces) {
    const IndexBox indices = indices_of(p.cells, q.label);
    for (std::size_t c = 0; c < components; ++c) {
      const double* next = numbers.take(p.owner, indices.volume());
      for_each_cell(indices, [&](IntVec3 i) {
        values[place(i) * components + c] = *next++;
        held[place(i)] = 1;
      });
    }
  }
  std::string text = snapshot_head(time) + fmt::format("# X Y Z{}\n", columns_of(q));
  const IntVec3 closing = closing_layers(q.label.info().centring);
  for_each_cell(all, [&](IntVec3 i) {
    const std::size_t at = place(i);
    if (held[at] == 0) return;
    Vec3 x = geometry_.centre(i);
    for (int d = 0; d < 3; ++d) x[d] -= 0.5 * closing[d] * geometry_.spacing[d];
    fmt::format_to(std::back_inserter(text), "{:.17g} {:.17g} {:.17g}", x.x, x.y, x.z);
    for (std::size_t c = 0; c < components; ++c)
      fmt::format_to(std::back_inserter(text), " {:.17g}", values[at * components + c]);
    text += '\n';
  });
  return text;
}

void PlaneSampler::write(RankNumbers& numbers, int step, double time) {
  for (Plane& plane : planes_)
    for (const AnalysedQuantity& q : quantities_) {
      if (plane.pieces.empty()) continue;
      plane.files.add(step, fmt::format("{}_{}.dat", q.label.name(), q.material),
                      text_of(plane, q, numbers, time));
    }
}

void PlaneSampler::flush(const fs::path& folder) {
  for (Plane& plane : planes_) plane.files.flush(folder);
}

void PlaneSampler::adopt(const fs::path& earlier, const fs::path& folder, double time) const {
  for (const Plane& plane : planes_) plane.files.adopt(earlier, folder, time);
}

}  // namespace sluice
