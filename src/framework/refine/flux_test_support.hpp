// Two levels of a scalar with known fluxes, for the tests of the flux register. Numbers have no
// unit.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

#include "framework/base/exact_sum.hpp"
#include "framework/grid/box_list.hpp"
#include "framework/refine/flux_register.hpp"

namespace sluice::flux_test {

constexpr int quantities = 2;

struct Levels {
  Level coarse, fine;
};

// How a scene is cut and who owns it: pieces of the coarse domain and of each fine region.
struct Cut {
  IntVec3 coarse{1, 1, 1}, fine{1, 1, 1};
  bool all_here = true;  // every rank has all boxes, else they are dealt out
};

struct Scene {
  IntVec3 cells{8, 1, 1}, ratio{2, 1, 1};
  std::array<bool, 3> periodic{};
  std::vector<IndexBox> refined;  // coarse cells under the fine level
  IntVec3 low{};                  // of the domain
};

inline Levels levels_of(const Scene& scene, const Cut& cut, const Communicator& ranks) {
  Levels l;
  l.coarse.domain = {scene.low, scene.low + scene.cells};
  l.coarse.periodic = scene.periodic;
  for (int d = 0; d < 3; ++d) l.coarse.active[d] = scene.cells[d] > 1;
  l.fine = l.coarse;
  l.fine.index = 1;
  l.fine.ratio = scene.ratio;
  l.fine.domain = refine(l.coarse.domain, scene.ratio);
  for (int d = 0; d < 3; ++d) l.fine.spacing[d] = 1.0 / scene.ratio[d];
  const auto add = [](Level& level, const IndexBox& region, IntVec3 pieces) {
    for (const IndexBox& b : split(region, pieces))
      if (!b.empty()) level.boxes.push_back({b, 0, static_cast<int>(level.boxes.size())});
  };
  add(l.coarse, l.coarse.domain, cut.coarse);
  for (const IndexBox& r : scene.refined) {
    std::vector<GridBox>& boxes = l.fine.boxes;
    const std::size_t before = boxes.size();
    add(l.fine, r, cut.fine);  // cut in coarse cells
    for (std::size_t b = before; b < boxes.size(); ++b)
      boxes[b].cells = refine(boxes[b].cells, scene.ratio);
  }
  for (Level* level : {&l.coarse, &l.fine}) {
    assign_owners(level->boxes, ranks.size());
    if (cut.all_here)
      for (GridBox& b : level->boxes) b.owner = ranks.rank();
  }
  return l;
}

// The flux through the face between a cell and the one below it along a direction, and the state
// of a cell at the start.
using Flux = std::function<double(int quantity, int direction, IntVec3 cell, int level, int step)>;
using Start = std::function<double(int quantity, IntVec3 cell, int level)>;

inline double hashed(std::uint64_t a, std::uint64_t b, IntVec3 c) {
  std::uint64_t h = a * 0x9E3779B97F4A7C15ULL + b * 0xC2B2AE3D27D4EB4FULL;
  for (int d = 0; d < 3; ++d) {
    h = (h ^ static_cast<std::uint64_t>(c[d] + 77)) * 0xFF51AFD7ED558CCDULL;
    h ^= h >> 31;
  }
  return static_cast<double>(h >> 11) * 0x1p-52 - 1.0;  // [-1, 1)
}

// Few binary digits: sums of such numbers are exact in whatever order.
inline double short_number(double x) {
  return std::nearbyint(x * 4096) / 4096;
}

inline IntVec3 wrapped(IntVec3 cell, const Level& level) {
  for (int d = 0; d < 3; ++d) {
    const int n = level.domain.size()[d], low = level.domain.lower[d];
    cell[d] = low + ((cell[d] - low) % n + n) % n;
  }
  return cell;
}

// Density must stay positive; the second quantity may be anything.
class Positive : public TransferOperators {
 public:
  void prolong(const StateViews&, const StateViews&, const IndexBox&, const TransferGeometry&,
               int) const override {}
  void restrict_to(const StateViews&, const StateViews&, const IndexBox&,
                   const TransferGeometry&) const override {}
  int flux_quantities() const override { return quantities; }

  static double share(double density, double change) {
    for (const double s : {1.0, 0.5, 0.25, 0.125})
      if (density + s * change > 0) return s;
    return 0.0;
  }
  void correct(const StateViews& state, const ConservedChange& change,
               std::span<double> shares) const override {
    for (std::size_t c = 0; c < change.cells.size(); ++c) {
      shares[c] = share(state[0](change.cells[c]), change.amount[0][c]);
      for (std::size_t q = 0; q < quantities; ++q)
        state[q](change.cells[c]) += shares[c] * change.amount[q][c];
    }
  }
};

// One coarse step with `substeps` fine ones: the scheme of both levels moves what the given fluxes
// say, the register does the rest.
class TwoLevels {
 public:
  TwoLevels(const Scene& scene, const Cut& cut, Communicator& ranks)
      : ranks_(ranks),
        levels_(levels_of(scene, cut, ranks)),
        coarse_(levels_.coarse, ranks.rank()),
        fine_(levels_.fine, ranks.rank()),
        registers_(levels_.coarse, levels_.fine, quantities, ranks.rank()) {
    for (Warehouse* w : {&coarse_, &fine_}) {
      const Label one =
          declare_label({"flux_test_density", ValueType::real, Centring::cell, "1", ""});
      const Label two =
          declare_label({"flux_test_tracer", ValueType::real, Centring::cell, "1", ""});
      slots_ = {w->add({one, 0, 1, 1}), w->add({two, 0, 1, 0})};
    }
  }

  CorrectionReport step(const Start& start, const Flux& flux, int substeps) {
    each(coarse_, [&](int q, IntVec3 c, double& value) { value = start(q, c, 0); });
    each(fine_, [&](int q, IntVec3 c, double& value) { value = start(q, c, 1); });
    registers_.clear();
    sweep(coarse_, registers_.coarse_faces(), flux, 0, 0);
    for (int s = 0; s < substeps; ++s) {
      sweep(fine_, registers_.fine_faces(), flux, 1, s);
      registers_.add_substep();
    }
    return registers_.correct(coarse_, fine_, slots_, Positive(), ranks_);
  }

  // Calls f(quantity, cell, value) for the interior cells of this rank.
  void each(Warehouse& w, const std::function<void(int, IntVec3, double&)>& f) {
    for (std::size_t b = 0; b < w.local_boxes().size(); ++b)
      for (int q = 0; q < quantities; ++q) {
        const RealView v = w.view(slots_[q], 0, static_cast<int>(b));
        for_each_cell(w.local_boxes()[b].cells, [&](IntVec3 c) { f(q, c, v(c)); });
      }
  }

  bool covered(IntVec3 coarse_cell) const {
    for (const GridBox& b : levels_.fine.boxes)
      if (coarsen(b.cells, levels_.fine.ratio).contains(coarse_cell)) return true;
    return false;
  }

  bool only_correct = false;  // leaves out what the schemes themselves move

  const Levels& levels() const { return levels_; }
  Warehouse& coarse() { return coarse_; }
  Warehouse& fine() { return fine_; }
  FluxRegister& registers() { return registers_; }

 private:
  // Through the ends of a domain that is not periodic nothing passes.
  double through(const Flux& flux, int q, int d, IntVec3 cell, const Level& level, int step) const {
    const bool end = cell[d] == level.domain.lower[d] || cell[d] == level.domain.upper[d];
    if (end && !level.periodic[d]) return 0.0;
    return flux(q, d, wrapped(cell, level), level.index, step);
  }

  void sweep(Warehouse& w, FaceTable& table, const Flux& flux, int level_index, int step) {
    const Level& level = level_index == 0 ? levels_.coarse : levels_.fine;
    const Axes axes = active_axes(level);
    const auto flux_at = [&](int q, int d, IntVec3 cell) {
      return through(flux, q, d, cell, level, step);
    };
    each(w, [&](int q, IntVec3 c, double& value) {
      if (only_correct) return;
      double change = 0;
      for (int a = 0; a < axes.count; ++a) {
        IntVec3 next = c;
        ++next[axes.direction[a]];
        change += flux_at(q, axes.direction[a], c) - flux_at(q, axes.direction[a], next);
      }
      value += change;
    });
    for (std::size_t b = 0; b < w.local_boxes().size(); ++b)
      for (const IndexBox& block : blocks(w.local_boxes()[b].cells, level))
        record(table, static_cast<int>(b), block, axes, flux_at);
  }

  static std::vector<IndexBox> blocks(const IndexBox& box, const Level& level) {
    IntVec3 pieces{1, 1, 1};
    for (int d = 0; d < 3; ++d)
      if (level.active[d]) pieces[d] = (box.size()[d] + 4) / 5;
    return split(box, pieces);
  }

  // As a row kernel does it: only the part of each row that lies in the block.
  template <class F>
  static void record(FaceTable& table, int box, const IndexBox& block, const Axes& axes,
                     const F& flux) {
    const int along = axes.direction[0];
    IndexBox rows = block;
    rows.upper[along] = rows.lower[along] + 1;
    bool any = false;
    for (int axis = 0; axis < axes.count; ++axis)
      for_each_cell(rows, [&](IntVec3 start) {
        for (const FaceTable::Segment& s : table.segments(box, axis, start)) {
          const int end = std::min(s.first + s.count, block.upper[along]);
          for (int i = std::max(s.first, block.lower[along]); i < end; ++i) {
            IntVec3 cell = start;
            cell[along] = i;
            cell[axes.direction[axis]] += s.high ? 1 : 0;
            for (int q = 0; q < quantities; ++q)
              table.values(q)[s.slot + i - s.first] = flux(q, axes.direction[axis], cell);
            any = true;
          }
        }
      });
    if (any != table.touches(box, block)) throw std::logic_error("a block that records sleeps");
  }

  Communicator& ranks_;
  Levels levels_;
  Warehouse coarse_, fine_;
  FluxRegister registers_;
  std::vector<int> slots_;
};

}  // namespace sluice::flux_test
