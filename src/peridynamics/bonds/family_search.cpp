#include "peridynamics/bonds/family_search.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "framework/base/error.hpp"
#include "peridynamics/bonds/families.hpp"

namespace sluice::peridynamics {

PointRows::PointRows(const PointTable& points) {
  for (int i = PointTable::margin; i + PointTable::margin < points.size(); ++i) {
    const std::size_t n = static_cast<std::size_t>(i);
    const int z = points.bin_of(points.X[2][n], 2), y = points.bin_of(points.X[1][n], 1);
    const double at_y = points.X[1][n], at_z = points.X[2][n];
    if (rows_.empty() || rows_.back().z != z || rows_.back().y != y)
      rows_.push_back({z, y, i, i, at_y, at_y, at_z, at_z});
    Row& row = rows_.back();
    row.end = i + 1;
    row.low_y = std::min(row.low_y, at_y);
    row.high_y = std::max(row.high_y, at_y);
    row.low_z = std::min(row.low_z, at_z);
    row.high_z = std::max(row.high_z, at_z);
  }
}

int PointRows::find(int z, int y) const {
  const auto at = std::lower_bound(
      rows_.begin(), rows_.end(), std::pair(z, y),
      [](const Row& row, const std::pair<int, int>& key) { return std::pair(row.z, row.y) < key; });
  return static_cast<int>(at - rows_.begin());
}

int PointRows::row_of(int entry) const {
  const auto at = std::upper_bound(rows_.begin(), rows_.end(), entry,
                                   [](int e, const Row& row) { return e < row.begin; });
  return static_cast<int>(at - rows_.begin()) - 1;
}

FamilySearch::FamilySearch(const PointTable& points, const PointRows& rows, const PeriScene& scene)
    : points_(&points),
      rows_(&rows),
      scene_(&scene),
      rule_{scene.influence, scene.partial_volume} {}

// The rows that may hold neighbours of points of a row: bins apart by no more than the reach.
void FamilySearch::open_row(int row) {
  const PointRows::Row& own = rows_->all()[static_cast<std::size_t>(row)];
  const double reach = points_->largest_reach / points_->bin;
  const int most = static_cast<int>(std::floor(reach)) + 1;
  const auto apart = [](int bins) { return std::max(0.0, std::abs(bins) - 1.0); };
  windows_.clear();
  for (int z = own.z - most; z <= own.z + most; ++z) {
    const double rest = reach * reach - apart(z - own.z) * apart(z - own.z);
    if (rest < 0) continue;
    const int along = static_cast<int>(std::floor(std::sqrt(rest))) + 1;
    for (std::size_t n = static_cast<std::size_t>(rows_->find(z, own.y - along));
         n < rows_->all().size(); ++n) {
      const PointRows::Row& other = rows_->all()[n];
      if (other.z != z || other.y > own.y + along) break;
      windows_.push_back(
          {other.begin, other.end, other.low_y, other.high_y, other.low_z, other.high_z});
    }
  }
  row_ = row;
}

void FamilySearch::find(int entry, std::vector<Neighbour>& found) {
  found.clear();
  if (row_ < 0 || entry < last_ || entry >= rows_->all()[static_cast<std::size_t>(row_)].end)
    open_row(rows_->row_of(entry));
  last_ = entry;
  const PointTable& p = *points_;
  const std::size_t i = static_cast<std::size_t>(entry);
  const int material = p.material[i];
  const Vec3 x{p.X[0][i], p.X[1][i], p.X[2][i]};
  const double reach = p.largest_reach, square = reach * reach, margin = 1e-6 * p.bin;
  const double horizon = scene_->materials[static_cast<std::size_t>(material)].horizon;
  // Within a bin points stand by id, so that places along x rise by bins alone.
  const double low = x.x - reach - p.bin;
  const double* along = p.X[0].data();
  for (Window& window : windows_) {
    const double off_y = std::max({0.0, window.low_y - x.y, x.y - window.high_y});
    const double off_z = std::max({0.0, window.low_z - x.z, x.z - window.high_z});
    const double rest = square - off_y * off_y - off_z * off_z;
    if (rest < 0) continue;
    const double high = x.x + std::sqrt(rest) + p.bin;
    while (window.next < window.end && p.X[0][static_cast<std::size_t>(window.next)] < low)
      ++window.next;
    for (int k = window.next; k < window.end; ++k) {
      const std::size_t j = static_cast<std::size_t>(k);
      const double dx = along[j] - x.x;
      if (along[j] > high) break;
      if (dx * dx > rest * (1 + 1e-12)) continue;
      const double dy = p.X[1][j] - x.y, dz = p.X[2][j] - x.z;
      const double r2 = dx * dx + dy * dy + dz * dz;
      if (r2 > square || k == entry) continue;
      if (!scene_->all_bonded && p.material[j] != material) continue;
      const double delta =
          std::min(horizon, scene_->materials[static_cast<std::size_t>(p.material[j])].horizon);
      const double r = std::sqrt(r2), spacing = 0.5 * (p.spacing[i] + p.spacing[j]);
      if (r < 1e-6 * spacing)
        throw InputError(
            fmt::format("points {} and {} lie at the same place ({:g}, {:g}, {:g}), closer than "
                        "1e-6 of their spacing: every place holds one point",
                        p.id[i], p.id[j], x.x, x.y, x.z));
      const float w = rule_.weight(r, delta, spacing);
      if (!(w > 0)) continue;
      // Member by member: to copy one that was just made waits for its parts.
      Neighbour& n = found.emplace_back();
      n.entry = k;
      n.w = w;
      n.r = r;
      n.beta = rule_.beta(r, delta, spacing);
      for (const PreCrack& crack : scene_->precracks)
        n.cut = n.cut || crosses(crack, x, {p.X[0][j], p.X[1][j], p.X[2][j]}, margin);
    }
  }
}

}  // namespace sluice::peridynamics
