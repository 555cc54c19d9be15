// Holders from the finest level down; trilinear weights with corners from coarser levels.
#include "framework/archive/extract/point_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/archive/selection.hpp"

namespace sluice {
namespace {

constexpr double round_off = 1e-9;  // of a cell
constexpr int most_components = 9;

const Level& level_of(const Grid& grid, const FieldInfo& f) {
  return grid.levels.at(static_cast<std::size_t>(f.level));
}

bool is_flat(const Level& level, int d) {
  return level.domain.size()[d] == 1;
}

// In cells from the place of index 0.
double place_in_cells(const Level& level, Centring centring, Vec3 p, int d) {
  const double shift = closing_layers(centring)[d] == 1 ? 0.0 : 0.5;
  return (p[d] - level.anchor[d]) / level.spacing[d] - shift;
}

int clamped_floor(double x) {
  return static_cast<int>(std::clamp(std::floor(x), -1e9, 1e9));
}

// The indices around all points, with what linear values need beside them.
IndexBox box_around(const Level& level, const FieldInfo& f, const std::vector<Vec3>& points) {
  constexpr int beside = 3;  // a corner of a finer level and its own corners
  const IndexBox all = index_range(level, f.centring);
  IndexBox box{all.upper, all.lower};
  for (const Vec3& p : points)
    for (int d = 0; d < 3; ++d) {
      const int i = clamped_floor(place_in_cells(level, f.centring, p, d));
      box.lower[d] = std::min(box.lower[d], i - beside);
      box.upper[d] = std::max(box.upper[d], i + 2 + beside);
    }
  for (int d = 0; d < 3; ++d) {
    const bool wraps =
        level.periodic[d] && (box.lower[d] < all.lower[d] || box.upper[d] > all.upper[d]);
    if (!is_flat(level, d) && !wraps) continue;
    box.lower[d] = all.lower[d];
    box.upper[d] = all.upper[d];
  }
  return intersection(box, all);
}

}  // namespace

PointValues::PointValues(const ArchiveStep& step, const std::vector<FieldInfo>& fields,
                         const std::vector<Vec3>& points)
    : grid_(step.grid()) {
  for (const FieldInfo& f : fields) {
    IndexBox box = intersection(step.range(f), box_around(level_of(grid_, f), f, points));
    if (box.empty()) box = {};
    loaded_.push_back({f, step.read(f, box)});
  }
}

bool PointValues::inside(Vec3 p) const {
  const Level& coarse = grid_.levels.front();
  for (int d = 0; d < 3; ++d) {
    const double x = (p[d] - coarse.anchor[d]) / coarse.spacing[d];
    const bool between =
        x >= coarse.domain.lower[d] - round_off && x <= coarse.domain.upper[d] + round_off;
    if (!between && !is_flat(coarse, d)) return false;
  }
  return true;
}

std::optional<IntVec3> PointValues::index_on(const Loaded& on, Vec3 p) const {
  const Level& level = level_of(grid_, on.info);
  const IndexBox all = index_range(level, on.info.centring);
  IntVec3 index;
  for (int d = 0; d < 3; ++d) {
    index[d] = clamped_floor(place_in_cells(level, on.info.centring, p, d) + 0.5);
    index[d] = std::clamp(index[d], all.lower[d], all.upper[d] - 1);
  }
  if (!on.values.has(index)) return std::nullopt;
  return index;
}

std::optional<PointValues::Holder> PointValues::holder(Vec3 p) const {
  if (!inside(p)) return std::nullopt;
  for (std::size_t n = loaded_.size(); n-- > 0;)
    if (const auto index = index_on(loaded_[n], p)) return Holder{n, *index};
  return std::nullopt;
}

Vec3 PointValues::place(const Holder& h) const {
  const FieldInfo& f = loaded_[h.field].info;
  return position(level_of(grid_, f), f.centring, h.index);
}

void PointValues::values(const Holder& h, double* components) const {
  const Loaded& on = loaded_[h.field];
  for (int m = 0; m < on.info.components(); ++m) components[m] = on.values.at(h.index, m);
}

// The two indices along each direction between which a point lies, and its share of the second.
struct PointValues::Corners {
  std::array<std::array<int, 2>, 3> index{};
  Vec3 share;
};

PointValues::Corners PointValues::corners(const Loaded& on, Vec3 p) const {
  const Level& level = level_of(grid_, on.info);
  const IndexBox all = index_range(level, on.info.centring);
  Corners found;
  for (int d = 0; d < 3; ++d) {
    const int low = all.lower[d], count = all.upper[d] - low;
    if (is_flat(level, d)) {
      found.index[d] = {low, low};
      continue;
    }
    const double x = place_in_cells(level, on.info.centring, p, d);
    int i = clamped_floor(x);
    const bool wraps = level.periodic[d] && closing_layers(on.info.centring)[d] == 0;
    if (!wraps) i = std::clamp(i, low, std::max(low, low + count - 2));
    found.share[d] = count > 1 ? x - i : 0;
    for (int side = 0; side < 2; ++side) {
      const int j = i + side - low;
      found.index[d][side] = low + (wraps ? (j % count + count) % count : std::min(j, count - 1));
    }
  }
  return found;
}

bool PointValues::at_corner(std::size_t n, IntVec3 index, double* components) const {
  const Loaded& on = loaded_[n];
  bool found = on.values.has(index);
  if (found)
    values({n, index}, components);
  else if (n > 0)
    found = linear_on(n - 1, place({n, index}), components);
  for (int m = 0; found && m < on.info.components(); ++m) found = !std::isnan(components[m]);
  return found;
}

bool PointValues::linear_on(std::size_t n, Vec3 p, double* components) const {
  const Corners c = corners(loaded_[n], p);
  const int count = loaded_[n].info.components();
  std::fill_n(components, count, 0.0);
  std::array<double, most_components> there{};
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    IntVec3 index;
    for (int d = 0; d < 3; ++d) {
      const int side = corner >> d & 1;
      weight *= side == 1 ? c.share[d] : 1 - c.share[d];
      index[d] = c.index[d][side];
    }
    if (weight == 0) continue;
    if (!at_corner(n, index, there.data())) return false;
    for (int m = 0; m < count; ++m) components[m] += weight * there[m];
  }
  return true;
}

void PointValues::linear(Vec3 p, const Holder& h, double* components) const {
  if (!linear_on(h.field, p, components)) values(h, components);
}

}  // namespace sluice
