// The switch and the ramp.
#include "ice/one_material/leaving_shocks.hpp"

#include <array>
#include <cmath>

#include "ice/fluid/limiters.hpp"

namespace sluice::ice {
namespace {

// threshold: fall of the pressure over two cells, relative to rho c^2, above which a shock is
//   widened before it leaves a level; unit: 1; test: AmrPassage.ReflectsLessThanAHundredthOfTheJump
constexpr double min_fall = 0.07;
// threshold: fall above which it is widened in full; unit: 1; test:
//   AmrPassage.ReflectsLessThanAHundredthOfTheJump
constexpr double full_fall = 0.21;
// threshold: fall above which it is widened as a steep one; unit: 1; test:
//   AmrPassage.ReflectsLessThanAHundredthOfTheJump
constexpr double steep_fall = 1;
constexpr int max_depth = 80;

// Towards cells that are so many times as wide.
struct Widening {
  int depth = 0;
  double full = 0, steep = 0;                // of what is taken away beside the end
  std::array<double, max_depth + 1> part{};  // of it in the k-th cell before the end

  Widening(int cells, double at_full_fall, double at_steep_fall, double power)
      : depth(cells), full(at_full_fall), steep(at_steep_fall) {
    for (int k = 0; k <= depth; ++k) {
      const double w = larger(0.0, k - 0.5) / depth;
      part[k] = 1.0 - std::pow(w, power);
    }
  }
};
const Widening by_two(2 * 12, 0.7, 0.7, 1), by_four(4 * 20, 1.5, 5.5, 0.5);

}  // namespace

IntVec3 leaving_depth(const Level& level) {
  IntVec3 d;
  for (int n = 0; n < 3; ++n) {
    const int ratio = level.index > 0 ? level.ratio[n] : 1;
    d[n] = ratio >= 4 ? by_four.depth : ratio >= 2 ? by_two.depth : 0;
  }
  return d;
}

void damp_leaving_shocks(const Row& row, const InterfaceDistance& ends, int axis,
                         const PressureRows& q, double* __restrict slope) {
  const Widening& by = ends.depth(axis) == by_two.depth ? by_two : by_four;
  const auto ramp = [](double fall, double from, double to) {
    return smaller(larger(0.0, fall - from) / (to - from), 1.0);
  };
  for (const bool high : {false, true}) {
    const std::uint8_t* far = ends.ahead(row.box(), axis, high, row.cell());
    if (far == nullptr) continue;
    const double* __restrict behind = high ? q.minus : q.plus;
    const double* __restrict ahead = high ? q.plus : q.minus;
    for (int i = 0; i < row.count(); ++i) {
      if (far[i] > by.depth) continue;
      const double fall = (behind[i] - ahead[i]) / (q.rho[i] * (q.sound[i] * q.sound[i]));
      const double most = ramp(fall, min_fall, full_fall) * by.full +
                          ramp(fall, full_fall, steep_fall) * (by.steep - by.full);
      slope[i] *= 1.0 - most * by.part[far[i]];
    }
  }
}

}  // namespace sluice::ice
