#include "mpm/step/shared_dilatation.hpp"

#include <array>
#include <cmath>

#include "framework/particle/particle_map.hpp"
#include "mpm/step/deformation.hpp"

namespace sluice::mpm {
namespace {

// Parts of a cell's volume in which volumes are summed: whole numbers, whatever their order.
constexpr double parts = 17592186044416.0;  // 2^44

struct CellVolumes {
  std::int64_t now = 0, at_start = 0;
};

}  // namespace

void SharedDilatation::find(const ParticleMotion& motion, const Chunk& any,
                            std::vector<double>& shared) const {
  const BlockWork& w = *any.work;
  const Columns& c = any.columns();
  for_each_chunk(any, [&](const Chunk& chunk) {
    motion.read_gradient(chunk);
    Batch& b =
        chunk.buffers->columns.between(*w.set, *w.next, *chunk.body->carried, chunk.at, chunk.n);
    for (std::size_t e = 0; e < 9; ++e) b.L[e] = chunk.read().L[e];
    deform(solids_->subcycles_of_F, chunk.dt(), b, chunk.made(c.volume));
  });
  const double* volume = w.next->column(static_cast<std::size_t>(c.volume));
  const double* start = w.set->column(static_cast<std::size_t>(c.volume_0));
  const double scale = parts / nodes_->level.cell_volume();
  std::array<CellVolumes, block_nodes> cells{};
  const auto cell_of = [&](std::size_t p) -> CellVolumes& {
    const int place = nodes_->shape.place(cell_at(nodes_->level, w.set->position(p)));
    return cells[static_cast<std::size_t>(place)];
  };
  for (std::size_t p = w.run.begin; p < w.run.end; ++p) {
    CellVolumes& cell = cell_of(p);
    cell.now += std::llround(scale * volume[p]);
    cell.at_start += std::llround(scale * start[p]);
  }
  shared.clear();
  for (std::size_t p = w.run.begin; p < w.run.end; ++p) {
    const CellVolumes& cell = cell_of(p);
    shared.push_back(static_cast<double>(cell.now) / static_cast<double>(cell.at_start));
  }
}

void SharedDilatation::take(const Chunk& chunk, const Batch& b,
                            const std::vector<double>& shared) const {
  double* volume = chunk.made(chunk.columns().volume);
  const std::size_t first = chunk.at - chunk.work->run.begin;
  std::array<bool, 3> moves = nodes_->level.active;
  if (solids_->axisymmetric) moves[2] = true;
  int count = 0;
  for (const bool m : moves) count += m ? 1 : 0;
  for (int q = 0; q < b.count; ++q) {
    const double ratio = shared[first + static_cast<std::size_t>(q)] * b.volume_0[q] / volume[q];
    const double factor = std::pow(ratio, 1.0 / count);
    volume[q] *= ratio;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!moves[i]) continue;
      for (std::size_t j = 0; j < 3; ++j) const_cast<double*>(b.F[3 * i + j])[q] *= factor;
      chunk.read().L[4 * i][q] += std::log(ratio) / (count * b.dt);
    }
  }
}

}  // namespace sluice::mpm
