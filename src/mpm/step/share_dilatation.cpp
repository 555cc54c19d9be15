// One dilatation for all particles of a material in a cell, against locking: J <- sum V/sum V_0 of
// them, F and L scaled to it. (As F-bar: E. A. de Souza Neto and others, Int. J. Solids Struct. 33
// (1996) 3277, with particles in place of quadrature points.)
#include <algorithm>
#include <array>
#include <cmath>

#include "framework/particle/particle_map.hpp"
#include "mpm/step/deformation.hpp"
#include "mpm/step/law_batch.hpp"
#include "mpm/step/midpoint_stage.hpp"
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {
namespace {

// Parts of a cell's volume in which volumes are summed: whole numbers, whatever their order.
constexpr double parts = 17592186044416.0;  // 2^44

struct CellVolumes {
  std::int64_t now = 0, at_start = 0;
};

}  // namespace

// Of each particle of a block, which has the particles of its cells all: from what they read of the
// nodes in the window.
void SolidStep::find_dilatations(const BlockWork& w, double dt, const Window& window,
                                 GridAtParticles& read, LawBatch& columns,
                                 std::vector<double>& dilatation) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  double* volume = w.next->column(static_cast<std::size_t>(c.volume));
  for (std::size_t at = w.run.begin; at < w.run.end; at += chunk_size) {
    const int n = static_cast<int>(std::min<std::size_t>(chunk_size, w.run.end - at));
    read_velocities(solids_->basis, body.grid, places_of_gradients(w), shape_of_gradients(w),
                    static_cast<int>(at), n, window, read);
    if (solids_->axisymmetric)
      add_hoop_rate(solids_->midpoint() ? *w.next : *w.set,
                    (solids_->maps_back() ? body.mapped_units : body.units).reference.x, at, n,
                    read);
    if (solids_->midpoint()) to_end_of_step(dt, n, read);
    Batch& b = columns.between(*w.set, *w.next, *body.carried, at, n);
    for (std::size_t e = 0; e < 9; ++e) b.L[e] = read.L[e];
    deform(solids_->subcycles_of_F, dt, b, volume + at);
  }
  const double* start = w.set->column(static_cast<std::size_t>(c.volume_0));
  const double scale = parts / level_.cell_volume();
  std::array<CellVolumes, block_nodes> cells{};
  std::vector<int> place;
  for (std::size_t p = w.run.begin; p < w.run.end; ++p) {
    place.push_back(shape_.place(cell_at(level_, w.set->position(p))));
    CellVolumes& cell = cells[static_cast<std::size_t>(place.back())];
    cell.now += std::llround(scale * volume[p]);
    cell.at_start += std::llround(scale * start[p]);
  }
  dilatation.clear();
  for (const int n : place) {
    const CellVolumes& cell = cells[static_cast<std::size_t>(n)];
    dilatation.push_back(static_cast<double>(cell.now) / static_cast<double>(cell.at_start));
  }
}

// F <- (J'/J)^(1/d) F, L <- L + I ln(J'/J)/(d dt) in the d directions that move, J' the shared one.
void SolidStep::take_dilatation(const BlockWork& w, std::size_t at, const Batch& b,
                                std::span<const double> dilatation, GridAtParticles& read) const {
  const Columns& c = bodies_[static_cast<std::size_t>(w.kind)].carried->columns;
  double* volume = w.next->column(static_cast<std::size_t>(c.volume)) + at;
  std::array<bool, 3> moves = level_.active;
  if (solids_->axisymmetric) moves[2] = true;
  int count = 0;
  for (const bool m : moves) count += m ? 1 : 0;
  for (int q = 0; q < b.count; ++q) {
    const double shared = dilatation[at - w.run.begin + static_cast<std::size_t>(q)];
    const double ratio = shared * b.volume_0[q] / volume[q];
    const double factor = std::pow(ratio, 1.0 / count);
    volume[q] *= ratio;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!moves[i]) continue;
      for (std::size_t j = 0; j < 3; ++j) const_cast<double*>(b.F[3 * i + j])[q] *= factor;
      read.L[4 * i][q] += std::log(ratio) / (count * b.dt);
    }
  }
}

}  // namespace sluice::mpm
