#include "framework/solve/composite_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/grid/cell_map.hpp"
#include "framework/grid/grid_boxes.hpp"
#include "framework/solve/all_boxes.hpp"

namespace sluice::solve {
namespace {

IntVec3 times(IntVec3 c, IntVec3 ratio) {
  return {c.x * ratio.x, c.y * ratio.y, c.z * ratio.z};
}
int floor_of(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}
IntVec3 parent_of(IntVec3 c, IntVec3 ratio) {
  return {floor_of(c.x, ratio.x), floor_of(c.y, ratio.y), floor_of(c.z, ratio.z)};
}

// The coefficients of all boxes of a level, whoever owns them.
struct WholeLevel {
  explicit WholeLevel(const LevelCoefficients& c)
      : level(*c.level), map(level), own(copied(level, c.own)) {
    for (std::size_t d = 0; d < 3; ++d) {
      face[0].push_back(copied(level, c.low[d]));
      face[1].push_back(copied(level, c.high[d]));
    }
  }
  // Of cell `c`, which the level has: across its low (side 0) or high face.
  double& across(int side, int d, IntVec3 c) const {
    const std::size_t box = map.box_of(c);
    return face[side][d].views()[box](map.image(c));
  }
  double& own_coefficient(IntVec3 c) const { return own.views()[map.box_of(c)](map.image(c)); }

  const Level& level;
  CellMap map;
  BoxArrays own;
  std::vector<BoxArrays> face[2];

 private:
  static BoxArrays copied(const Level& level, const BoxArrays& own) {
    const std::vector<IndexBox> boxes = cells_of(level.boxes);
    BoxArrays all(boxes);
    const AllBoxes from(level, own.values());
    for (std::size_t n = 0; n < boxes.size(); ++n)
      for_each_cell(boxes[n], [&](IntVec3 c) { all.views()[n](c) = from.views()[n](c); });
    return all;
  }
};

// Covered cells get what the cells above them have: sums of their own, and of the faces on each of
// their faces over the ratio (a coarse face is that much longer).
void take_from_above(const WholeLevel& fine, WholeLevel& coarse) {
  const IntVec3 ratio = fine.level.ratio;
  for (const GridBox& b : fine.level.boxes)
    for_each_cell({parent_of(b.cells.lower, ratio), parent_of(b.cells.upper, ratio)},
                  [&](IntVec3 c) {
                    const IndexBox children{times(c, ratio), times(c + IntVec3::all(1), ratio)};
                    double sum = 0;
                    for_each_cell(children, [&](IntVec3 f) { sum += fine.own_coefficient(f); });
                    coarse.own_coefficient(c) = sum;
                    for (int d = 0; d < 3; ++d)
                      for (const int side : {0, 1}) {
                        IndexBox layer = children;
                        if (side == 0)
                          layer.upper[d] = layer.lower[d] + 1;
                        else
                          layer.lower[d] = layer.upper[d] - 1;
                        double w = 0;
                        for_each_cell(layer, [&](IntVec3 f) { w += fine.across(side, d, f); });
                        w /= ratio[d];
                        coarse.across(side, d, c) = w;
                        IntVec3 next = c;
                        next[d] += side == 0 ? -1 : 1;
                        if (coarse.map.has(next)) coarse.across(1 - side, d, next) = w;
                      }
                  });
}

struct InterfaceFace {
  IntVec3 fine, coarse;
  double weight;
};

// The rows of one level: those of its uncovered cells, and of all.
class LevelRows {
 public:
  struct Matrix {
    explicit Matrix(const std::vector<IndexBox>& boxes)
        : diagonal(boxes), low{BoxArrays(boxes), BoxArrays(boxes), BoxArrays(boxes)} {}
    BoxArrays diagonal;
    std::array<BoxArrays, 3> low;
    std::array<ConstBoxViews, 3> couplings() const {
      return {low[0].values(), low[1].values(), low[2].values()};
    }
  };
  LevelRows(const WholeLevel& whole_level, const WholeLevel* finer)
      : rows(cells_of(whole_level.level.boxes)),
        whole(cells_of(whole_level.level.boxes)),
        from_(whole_level),
        finer_(finer) {
    for (std::size_t b = 0; b < from_.level.boxes.size(); ++b)
      for_each_cell(from_.level.boxes[b].cells, [&](IntVec3 cell) { fill_row(b, cell); });
  }
  bool covered(IntVec3 cell) const {
    return finer_ != nullptr && finer_->map.has(times(from_.map.image(cell), finer_->level.ratio));
  }

  Matrix rows, whole;
  std::vector<InterfaceFace> faces;

 private:
  void fill_row(std::size_t b, IntVec3 cell) {
    const Level& level = from_.level;
    const bool under = covered(cell);
    double &all = whole.diagonal.views()[b](cell), &own = rows.diagonal.views()[b](cell);
    all = from_.own.views()[b](cell);
    own = under ? 1.0 : all;
    for (int d = 0; d < 3; ++d) {
      if (!level.active[d]) continue;
      for (const int side : {0, 1}) {
        const double w = from_.face[side][d].views()[b](cell);
        IntVec3 next = cell;
        next[d] += side == 0 ? -1 : 1;
        if (from_.map.has(next)) {
          all += w;
          if (side == 0) whole.low[d].views()[b](cell) = -w;
          if (under || covered(next)) continue;
          own += w;
          if (side == 0) rows.low[d].views()[b](cell) = -w;
        } else if (!from_.map.in_domain(next)) {
          all += w;
          if (!under) own += w;
        } else {
          const double longer = w * 2.0 / (level.ratio[d] + 1);
          all += longer;
          if (under) continue;
          own += longer;
          faces.push_back({cell, parent_of(from_.map.image(next), level.ratio), longer});
        }
      }
    }
  }

  const WholeLevel& from_;
  const WholeLevel* finer_;
};

}  // namespace

LevelCoefficients::LevelCoefficients(const Level& l, int rank)
    : level(&l),
      own(boxes_of(l, rank)),
      low{BoxArrays(boxes_of(l, rank)), BoxArrays(boxes_of(l, rank)), BoxArrays(boxes_of(l, rank))},
      high{BoxArrays(boxes_of(l, rank)), BoxArrays(boxes_of(l, rank)),
           BoxArrays(boxes_of(l, rank))} {}

CompositeSystem::CompositeSystem(std::span<const LevelCoefficients> levels) {
  std::vector<WholeLevel> whole;
  for (const LevelCoefficients& c : levels) whole.emplace_back(c);
  for (std::size_t l = whole.size() - 1; l > 0; --l) take_from_above(whole[l], whole[l - 1]);
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const LevelRows made(whole[l], l + 1 < levels.size() ? &whole[l + 1] : nullptr);
    const Level& level = *levels[l].level;
    DenseSystem all(level, made.whole.diagonal.values(), made.whole.couplings());
    DenseSystem rows(level, made.rows.diagonal.values(), made.rows.couplings(), &all);
    LevelPart part{&level, std::move(rows), std::move(all), {}, {}, {}, {}, 1.0};
    for (const GridBox& box : level.boxes)
      for_each_cell(box.cells, [&](IntVec3 c) {
        if (made.covered(c)) part.covered.push_back(part.rows.place_of(c));
      });
    levels_.push_back(std::move(part));
    if (l == 0) continue;
    for (const InterfaceFace& f : made.faces)
      levels_[l].interfaces.push_back(
          {levels_[l].rows.place_of(f.fine), levels_[l - 1].rows.place_of(f.coarse), f.weight});
    // Sums over faces have the same bits whatever the order of boxes.
    std::sort(levels_[l].interfaces.begin(), levels_[l].interfaces.end(),
              [](const Interface& a, const Interface& b) {
                return std::pair(a.fine, a.coarse) < std::pair(b.fine, b.coarse);
              });
    find_parents(l);
  }
}

void CompositeSystem::find_parents(std::size_t l) {
  LevelPart& fine = levels_[l];
  const IntVec3 r = fine.level->ratio;
  fine.children = static_cast<double>(r.x) * r.y * r.z;
  for (const GridBox& box : fine.level->boxes)
    for_each_cell(box.cells, [&](IntVec3 c) {
      fine.cells.push_back(fine.rows.place_of(c));
      fine.parents.push_back(levels_[l - 1].rows.place_of(parent_of(c, r)));
    });
}

std::int64_t CompositeSystem::unknowns() const {
  std::int64_t count = 0;
  for (const LevelPart& part : levels_)
    count += part.rows.unknowns() - static_cast<std::int64_t>(part.covered.size());
  return count;
}

DenseVector CompositeSystem::unknowns_of(std::size_t level) const {
  DenseVector found = levels_[level].rows.ones();
  for (const std::ptrdiff_t c : levels_[level].covered) found[c] = 0;
  return found;
}

CompositeVector CompositeSystem::vector() const {
  CompositeVector v;
  for (const LevelPart& part : levels_) v.push_back(part.rows.vector());
  return v;
}

void CompositeSystem::load(std::size_t level, const ConstBoxViews& boxes,
                           CompositeVector& v) const {
  levels_[level].rows.load(boxes, v[level]);
  for (const std::ptrdiff_t c : levels_[level].covered) v[level][c] = 0.0;
}

void CompositeSystem::store(const CompositeVector& v, std::size_t level,
                            const BoxViews& boxes) const {
  levels_[level].rows.store(v[level], boxes);
}

void CompositeSystem::clear_covered(CompositeVector& v) const {
  for (std::size_t l = 0; l < levels_.size(); ++l)
    for (const std::ptrdiff_t c : levels_[l].covered) v[l][c] = 0.0;
}

void CompositeSystem::gather(const CompositeVector& v, std::size_t level,
                             CompositeVector& sums) const {
  for (std::size_t l = level; l < levels_.size(); ++l) sums[l] = v[l];
  for (std::size_t l = levels_.size() - 1; l > level; --l) {
    const LevelPart& fine = levels_[l];
    for (std::size_t n = 0; n < fine.cells.size(); ++n)
      sums[l - 1][fine.parents[n]] += sums[l][fine.cells[n]];
  }
}

void CompositeSystem::spread(CompositeVector& v, std::size_t level) const {
  for (std::size_t l = level + 1; l < levels_.size(); ++l) {
    const LevelPart& fine = levels_[l];
    for (std::size_t n = 0; n < fine.cells.size(); ++n)
      v[l][fine.cells[n]] = v[l - 1][fine.parents[n]];
  }
}

void CompositeSystem::cover(CompositeVector& v) const {
  clear_covered(v);
  for (std::size_t l = levels_.size() - 1; l > 0; --l) {
    const LevelPart& fine = levels_[l];
    for (std::size_t n = 0; n < fine.cells.size(); ++n)
      v[l - 1][fine.parents[n]] += v[l][fine.cells[n]] / fine.children;
  }
}

void CompositeSystem::apply(CompositeVector& x, CompositeVector& y) const {
  for (std::size_t l = 0; l < levels_.size(); ++l) levels_[l].rows.apply(x[l], y[l]);
  for (std::size_t l = 1; l < levels_.size(); ++l)
    for (const Interface& f : levels_[l].interfaces) {
      const std::size_t fine = f.fine, coarse = f.coarse;
      y[l][fine] -= f.weight * x[l - 1][coarse];
      y[l - 1][coarse] += f.weight * (x[l - 1][coarse] - x[l][fine]);
    }
}

double CompositeSystem::step_share(std::size_t level) const {
  constexpr double most = 1.6;  // 2 is the end
  int ratio = 1;
  for (std::size_t l = level + 1; l < levels_.size(); ++l)
    ratio = std::max(
        {ratio, levels_[l].level->ratio.x, levels_[l].level->ratio.y, levels_[l].level->ratio.z});
  return ratio > most ? most / ratio : 1.0;
}

double CompositeSystem::dot(const CompositeVector& a, const CompositeVector& b) const {
  double sum = 0;
  for (std::size_t l = 0; l < levels_.size(); ++l) sum += levels_[l].rows.dot(a[l], b[l]);
  return sum;
}

double CompositeSystem::norm(const CompositeVector& v, Norm kind) const {
  double all = 0;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const double of_level = levels_[l].rows.norm(v[l], kind);
    all = kind == Norm::largest ? std::max(all, of_level)
          : kind == Norm::one   ? all + of_level
                                : std::hypot(all, of_level);
  }
  return all;
}

}  // namespace sluice::solve
