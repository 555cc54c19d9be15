// The coarse cells of a batch and those around them, gathered line by line from the arrays of their
// boxes; between two states in time they are blended on the way.
#pragma once
#include <span>

#include "ice/levels/children.hpp"

namespace sluice::ice {

template <int D, int Width>
class CoarseLines {
 public:
  CoarseLines(std::span<const Prolongation> regions, const Axes& axes)
      : regions_(regions), axes_(axes) {}

  // Where the lines of a batch lie, the same in the array of every quantity.
  void find(const Batch<Width>& batch) {
    Line* line = lines_;
    for (const LinePart& part : batch.parts()) {
      const RealView& v = regions_[part.region].coarse->front();
      line->first = v.offset(part.first);
      line->step = v.stride[part.along];
      for (int a = 0; a < D; ++a) line->stride[a] = v.stride[axes_.direction[a]];
      ++line;
    }
  }

  // The cells, and those below and above them along each axis: centre, low 0, high 0, low 1, ...
  static constexpr int star = 1 + 2 * D;
  void gather_star(std::size_t view, const Batch<Width>& batch, double (*to)[Width]) const {
    each_line(view, batch, [&](const Line& line, const LinePart& part, auto&& copy) {
      copy(0, to[0] + part.place);
      for (int a = 0; a < D; ++a) {
        copy(-line.stride[a], to[1 + 2 * a] + part.place);
        copy(line.stride[a], to[2 + 2 * a] + part.place);
      }
    });
    for (int k = 0; k < star; ++k) batch.repeat_last(to[k]);
  }
  // The cells, shifted along two axes.
  void gather(std::size_t view, const Batch<Width>& batch, int axis, int shift, int other, int move,
              double* to) const {
    each_line(view, batch, [&](const Line& line, const LinePart& part, auto&& copy) {
      copy(shift * line.stride[axis] + move * line.stride[other], to + part.place);
    });
    batch.repeat_last(to);
  }

 private:
  struct Line {
    std::ptrdiff_t first = 0, step = 0;  // along the line
    std::ptrdiff_t stride[D];            // by axis
  };

  // f(line, part, copy) for each line; copy(offset, to) takes the cells so far from those of it.
  template <class F>
  void each_line(std::size_t view, const Batch<Width>& batch, F&& f) const {
    const Line* line = lines_;
    for (const LinePart& part : batch.parts()) {
      const Prolongation& region = regions_[part.region];
      const double* from = (*region.coarse)[view].data + line->first;
      if (region.later == nullptr) {
        f(*line, part, [&](std::ptrdiff_t offset, double* to) {
          copy_strided(from + offset, line->step, part.count, to);
        });
      } else {
        const double* later = (*region.later)[view].data + line->first;
        f(*line, part, [&](std::ptrdiff_t offset, double* to) {
          blend_strided(from + offset, later + offset, region.share, line->step, part.count, to);
        });
      }
      ++line;
    }
  }

  std::span<const Prolongation> regions_;
  const Axes& axes_;
  Line lines_[Width];
};

}  // namespace sluice::ice
