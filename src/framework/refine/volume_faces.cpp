// Which faces of which boxes a control volume counts.
#include "framework/refine/volume_faces.hpp"

#include <algorithm>
#include <cmath>

#include "framework/grid/box_list.hpp"

namespace sluice {
namespace {

int nearest_face(double x, const Level& level, int d, bool& clipped) {
  const double at = std::round((x - level.anchor[d]) / level.spacing[d]);
  const double low = level.domain.lower[d], high = level.domain.upper[d];
  if (at < low || at > high) clipped = true;
  return static_cast<int>(std::clamp(at, low, high));
}

// Cells between two corners, at least one; whole directions that are not active.
IndexBox cells_between(Vec3 low, Vec3 high, const Level& level, bool& clipped) {
  IndexBox cells = level.domain;
  for (int d = 0; d < 3; ++d) {
    if (!level.active[d]) continue;
    const bool outside = high[d] <= level.anchor[d] + level.domain.lower[d] * level.spacing[d] ||
                         low[d] >= level.anchor[d] + level.domain.upper[d] * level.spacing[d];
    if (outside) return {};
    cells.lower[d] = std::min(nearest_face(low[d], level, d, clipped), level.domain.upper[d] - 1);
    cells.upper[d] = std::max(nearest_face(high[d], level, d, clipped), cells.lower[d] + 1);
  }
  return cells;
}

// The cells of one layer inside of a side.
IndexBox layer(const IndexBox& cells, int d, bool high) {
  IndexBox l = cells;
  (high ? l.lower[d] : l.upper[d]) = high ? cells.upper[d] - 1 : cells.lower[d] + 1;
  return l;
}

IndexBox moved(const IndexBox& box, int d, int by) {
  IntVec3 shift{};
  shift[d] = by;
  return box.shifted(shift);
}

// The cells next to a rectangle, with the side that is it.
VolumeCells cells_at(const ControlVolume& rectangle, const Level& level) {
  const int d = rectangle.flat;
  Vec3 low = rectangle.low, high = rectangle.high;
  const double start = level.anchor[d] + level.domain.lower[d] * level.spacing[d];
  const double end = level.anchor[d] + level.domain.upper[d] * level.spacing[d];
  bool outside = false;
  const int face = nearest_face(low[d], level, d, outside);
  low[d] = start;
  high[d] = end;
  VolumeCells v;
  v.cells = cells_between(low, high, level, v.clipped);
  if (outside) v.cells = {};
  if (v.cells.empty() || !level.active[d]) return v;
  const bool last = face == level.domain.upper[d];
  v.cells.lower[d] = last ? face - 1 : face;
  v.cells.upper[d] = v.cells.lower[d] + 1;
  v.sides[2 * d + (last ? 1 : 0)] = v.cells;
  return v;
}

}  // namespace

VolumeCells cells_of(const ControlVolume& volume, const Level& coarsest) {
  if (volume.flat >= 0) return cells_at(volume, coarsest);
  VolumeCells v;
  v.cells =
      volume.whole ? coarsest.domain : cells_between(volume.low, volume.high, coarsest, v.clipped);
  for (std::size_t s = 0; s < 6 && !v.cells.empty(); ++s) {
    const int d = static_cast<int>(s) / 2;
    const VolumeSide& side = volume.sides[s];
    if (!side.counts || !coarsest.active[d]) continue;
    v.sides[s] = layer(v.cells, d, s % 2 == 1);
    if (side.whole) continue;
    Vec3 low = side.start, high = side.end;
    low[d] = coarsest.anchor[d] + coarsest.domain.lower[d] * coarsest.spacing[d];
    high[d] = coarsest.anchor[d] + coarsest.domain.upper[d] * coarsest.spacing[d];
    IndexBox part = cells_between(low, high, coarsest, v.clipped);
    part.lower[d] = v.sides[s].lower[d];  // where the side is, is known
    part.upper[d] = v.sides[s].upper[d];
    v.sides[s] = intersection(v.sides[s], part);
  }
  return v;
}

std::vector<ControlVolume> control_volumes(const AnalysisSettings& settings) {
  std::vector<ControlVolume> all;
  for (const AnalysisModule& m : settings.modules)
    all.insert(all.end(), m.volumes.begin(), m.volumes.end());
  return all;
}

// Works on one level. Boxes that lie across a periodic end are seen there as images.
struct VolumeFaces::Builder {
  const Level& level;
  std::vector<IndexBox> boxes;    // of the level
  std::vector<IndexBox> covered;  // by the finer level
  VolumeFaces& to;

  std::vector<int> images(int d) const {
    const int n = level.domain.size()[d];
    return level.periodic[d] ? std::vector<int>{0, n, -n} : std::vector<int>{0};
  }
  // Takes from `cells` those whose neighbour `by` cells further along d is among `others`.
  std::vector<IndexBox> without(const std::vector<IndexBox>& cells,
                                const std::vector<IndexBox>& others, int d, int by) const {
    std::vector<IndexBox> holes;
    for (const int image : images(d))
      for (const IndexBox& o : others) {
        const IndexBox hole = moved(o, d, image - by);
        for (const IndexBox& c : cells)
          if (!intersection(hole, c).empty()) {
            holes.push_back(hole);
            break;
          }
      }
    return subtract(cells, holes);
  }
  void add(int box, int axis, bool high, const std::vector<IndexBox>& cells, int side, int d,
           int image) const {
    for (const IndexBox& c : cells) {
      const std::ptrdiff_t begin = to.table_.add(box, axis, high, moved(c, d, -image));
      to.side_of_.resize(begin + c.volume(), side);
    }
  }
  // Faces of a local box on the surface: `above`, the cells that have them as low faces.
  void add_side(int box, const IndexBox& own, const IndexBox& above, int axis, int d,
                int side) const {
    for (const int image : images(d)) {
      const IndexBox here = moved(own, d, image);
      std::vector<IndexBox> low = {intersection(here, above)};
      if (!low[0].empty()) {
        low = without(without(low, covered, d, 0), covered, d, -1);
        add(box, axis, false, low, side, d, image);
      }
      std::vector<IndexBox> high = {intersection(here, moved(above, d, -1))};
      if (high[0].empty()) continue;
      high = without(without(high, covered, d, 0), covered, d, 1);
      add(box, axis, true, without(high, boxes, d, 1), side, d, image);
    }
  }
};

VolumeFaces::VolumeFaces(const std::vector<VolumeCells>& volumes, const Level& coarsest,
                         const Level& level, const Level* finer, int rank) {
  const Axes axes = active_axes(level);
  IntVec3 ratio{1, 1, 1};  // against the coarsest level
  for (int d = 0; d < 3; ++d) ratio[d] = level.domain.size()[d] / coarsest.domain.size()[d];
  std::vector<GridBox> local;
  Builder builder{level, {}, {}, *this};
  for (const GridBox& b : level.boxes) {
    builder.boxes.push_back(b.cells);
    if (b.owner == rank) local.push_back(b);
  }
  if (finer != nullptr)
    for (const GridBox& b : finer->boxes) builder.covered.push_back(coarsen(b.cells, finer->ratio));
  table_ = FaceTable(local, axes, 0);
  for (std::size_t v = 0; v < volumes.size(); ++v) {
    inside_.push_back(refine(volumes[v].cells, ratio));
    for (int s = 0; s < 6; ++s) {
      const IndexBox side = refine(volumes[v].sides[s], ratio);
      if (side.empty()) continue;
      const int d = s / 2;
      int axis = 0;
      while (axes.direction[axis] != d) ++axis;
      const IndexBox above = s % 2 == 0 ? layer(side, d, false) : moved(layer(side, d, true), d, 1);
      for (std::size_t b = 0; b < local.size(); ++b)
        builder.add_side(static_cast<int>(b), local[b].cells, above, axis, d,
                         6 * static_cast<int>(v) + s);
    }
  }
  table_.seal();
}

}  // namespace sluice
