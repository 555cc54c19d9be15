// Finding boxes that follow each other.
#include "framework/grid/box_frames.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace sluice {
namespace {

class Framing {
 public:
  Framing(const std::vector<GridBox>& boxes, const Level& level, int ghosts)
      : boxes_(boxes),
        level_(level),
        ghosts_(level.ghosts(ghosts)),
        swept_(level.active[2]   ? 2
               : level.active[1] ? 1
                                 : 0) {}

  std::vector<BoxFrame> frames() {
    frames_.reserve(boxes_.size());
    apart_.reserve(boxes_.size());
    std::vector<int> order(boxes_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return cells(a).lower[swept_] < cells(b).lower[swept_]; });
    for (const int n : order) place(n);
    return std::move(frames_);
  }

 private:
  const IndexBox& cells(int n) const { return boxes_[n].cells; }

  bool may_share(const IndexBox& box) const {
    if (level_.active_count() < 2 || box.size()[swept_] < ghosts_[swept_]) return false;
    for (int d = 0; d < 3; ++d) {
      if (d == swept_ || !level_.active[d] || level_.periodic[d]) continue;
      if (box.lower[d] - ghosts_[d] < level_.domain.lower[d] ||
          box.upper[d] + ghosts_[d] > level_.domain.upper[d])
        return false;
    }
    return true;
  }

  // Cells that two boxes share across.
  std::int64_t meeting(IndexBox a, IndexBox b) const {
    a.lower[swept_] = b.lower[swept_] = 0;
    a.upper[swept_] = b.upper[swept_] = 1;
    return intersection(a, b).volume();
  }

  // The frame that ends where the box begins and meets it most; -1 where there is none.
  int below(const IndexBox& box) {
    std::int64_t most = 0;
    int best = -1;
    std::erase_if(open_, [&](const Open& o) { return o.end < box.lower[swept_]; });
    for (const auto& [end, f] : open_) {
      if (end > box.lower[swept_]) continue;
      const BoxFrame& frame = frames_[f];
      const std::int64_t common = meeting(cells(frame.boxes.back()), box);
      const std::int64_t apart = apart_[f] + box.grown(ghosts_).volume();
      if (common <= most || bounding(frame.hull, box.grown(ghosts_)).volume() > apart) continue;
      most = common;
      best = f;
    }
    return best;
  }

  void place(int n) {
    const IndexBox& box = cells(n);
    const bool shares = may_share(box);
    int f = shares ? below(box) : -1;
    if (f < 0) {
      f = static_cast<int>(frames_.size());
      frames_.push_back({box.grown(ghosts_), {}});
      apart_.push_back(0);
    } else {
      std::erase_if(open_, [&](const Open& o) { return o.frame == f; });
    }
    BoxFrame& frame = frames_[f];
    frame.hull = bounding(frame.hull, box.grown(ghosts_));
    frame.boxes.push_back(n);
    apart_[f] += box.grown(ghosts_).volume();
    if (shares) open_.push_back({box.upper[swept_], f});
  }

  struct Open {
    int end = 0;  // along the swept direction
    int frame = 0;
  };
  const std::vector<GridBox>& boxes_;
  const Level& level_;
  const IntVec3 ghosts_;
  const int swept_;
  std::vector<BoxFrame> frames_;
  std::vector<std::int64_t> apart_;  // numbers that arrays for each box would hold, by frame
  std::vector<Open> open_;           // frames that boxes to come may follow
};

}  // namespace

std::vector<BoxFrame> box_frames(const std::vector<GridBox>& boxes, const Level& level,
                                 int ghosts) {
  return Framing(boxes, level, ghosts).frames();
}

std::vector<std::vector<IndexBox>> held_by_frames(const Level& level, int ghosts, Arrays arrays) {
  std::vector<std::vector<IndexBox>> held(level.boxes.size());
  if (arrays == Arrays::own || level.active_count() < 2) return held;
  std::map<int, std::vector<GridBox>> by_owner;
  for (const GridBox& b : level.boxes) by_owner[b.owner].push_back(b);
  const IntVec3 layers = level.ghosts(ghosts);
  for (const auto& [owner, boxes] : by_owner)
    for (const BoxFrame& f : box_frames(boxes, level, ghosts))
      for (std::size_t n = 1; n < f.boxes.size(); ++n) {
        const GridBox& box = boxes[f.boxes[n]];
        for (std::size_t m = n; m-- > 0;) {
          const GridBox& before = boxes[f.boxes[m]];
          if (intersection(before.cells.grown(layers), box.cells.grown(layers)).empty()) break;
          held[box.id].push_back(before.cells.grown(layers));
          held[before.id].push_back(box.cells);
        }
      }
  return held;
}

std::int64_t framed_cells(const Level& level, int rank, int ghosts) {
  std::vector<GridBox> owned;
  for (const GridBox& b : level.boxes)
    if (b.owner == rank) owned.push_back(b);
  std::int64_t cells = 0;
  for (const BoxFrame& f : box_frames(owned, level, ghosts)) cells += f.hull.volume();
  return cells;
}

}  // namespace sluice
