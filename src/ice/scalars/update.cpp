// The new values of scalars, in the frame of the cell's own: no large numbers are subtracted.
//
//   q' = q + sum_d [F- (q_f- - q) + G- - F+ (q_f+ - q) - G+]/M'      G: what spreads
// which is M' q' = M q + sum_d (F- q_f- + G- - F+ q_f+ - G+) with M' = M + sum_d (F- - F+). A
// uniform scalar keeps its bits. Without diffusion q' lies between what the cell offered and what
// came in: round-off beyond that, large where little mass is left, is cut off.
// Then the sources over the step, each exactly: dq/dt = r0 + (r1 - c) q, and in regions
// dq/dt = rate up to a highest value. A sink takes no more than there is.
#include <cmath>
#include <memory>

#include "framework/task/reductions.hpp"
#include "ice/scalars/rows.hpp"
#include "ice/scalars/variables.hpp"
#include "ice/step/cell_runs.hpp"
#include "ice/step/end_of_step.hpp"

namespace sluice::ice::scalars {
namespace {

constexpr int most_cells = 64;  // of a part of a row

// A source in the cells of a region, on one level.
struct LocalSource {
  std::shared_ptr<const CellRuns> cells;
  double rate = 0, most = 0;
};

struct Each {
  In q, mass, mass_new;
  Out now;
  int carrier = 0, place = 0;
  double constant_rate = 0, own_rate = 0;
  std::vector<LocalSource> sources;
};

struct Handles {
  std::vector<Each> each;
  std::array<In, 3> carrier, face, spread;
  In base;
};

// Between which values the new one must lie, so far as the cell's own mass is concerned.
template <int D>
void own_bounds(const Row& row, const Handles& h, const Each& e, bool second_order, double* low,
                double* high) {
  const int first = e.place * (offered + D);
  const double* q = row(e.q);
  const double* M = row(e.mass);
  const double* lo = second_order ? row(h.base, first + lowest) : q;
  const double* hi = second_order ? row(h.base, first + highest) : q;
  for (int i = 0; i < row.count(); ++i) {
    low[i] = M[i] > 0.0 ? lo[i] : infinity;
    high[i] = M[i] > 0.0 ? hi[i] : -infinity;
  }
}

template <int D>
void transport_row(const Row& row, const Handles& h, const Each& e, bool second_order,
                   bool diffusive) {
  const int n = row.count();
  const double *Fm[D], *Fp[D], *qm[D], *qp[D];
  for (int d = 0; d < D; ++d) {
    const auto a = static_cast<std::size_t>(d);
    Fm[d] = row(h.carrier[a], e.carrier);
    Fp[d] = row(h.carrier[a], e.carrier, d, 1);
    qm[d] = row(h.face[a], e.place);
    qp[d] = row(h.face[a], e.place, d, 1);
  }
  double low[most_cells], high[most_cells], spread[most_cells];
  own_bounds<D>(row, h, e, second_order, low, high);
  for (int i = 0; i < n; ++i) spread[i] = 0.0;
  for (int d = 0; diffusive && d < D; ++d) {
    const double* Gm = row(h.spread[static_cast<std::size_t>(d)], e.place);
    const double* Gp = row(h.spread[static_cast<std::size_t>(d)], e.place, d, 1);
    for (int i = 0; i < n; ++i) {
      spread[i] += Gm[i] - Gp[i];
      low[i] = -infinity;
      high[i] = infinity;
    }
  }
  const double* __restrict q = row(e.q);
  const double* __restrict mass = row(e.mass_new);
  double* __restrict now = row(e.now);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double gain = 0, least = low[i], most = high[i];
    for (int d = 0; d < D; ++d) {
      gain += Fm[d][i] * (qm[d][i] - q[i]) - Fp[d][i] * (qp[d][i] - q[i]);
      least = smaller(least, Fm[d][i] > 0.0 ? qm[d][i] : infinity);
      least = smaller(least, Fp[d][i] < 0.0 ? qp[d][i] : infinity);
      most = larger(most, Fm[d][i] > 0.0 ? qm[d][i] : -infinity);
      most = larger(most, Fp[d][i] < 0.0 ? qp[d][i] : -infinity);
    }
    const double value = q[i] + (gain + spread[i]) / larger(mass[i], least_mass);
    // Of mass that a source puts where there was none nothing is known: it brings no scalar.
    const double kept = least <= most ? larger(smaller(value, most), least) : value;
    now[i] = mass[i] > 0.0 ? kept : 0.0;
  }
}

// dq/dt = r0 + k q over the step: q e^(k dt) + r0 (e^(k dt) - 1)/k.
void rates_row(const Row& row, const Each& e) {
  if (e.constant_rate == 0 && e.own_rate == 0) return;
  const double dt = row.step().dt, k = e.own_rate;
  const double growth = std::expm1(k * dt);
  const double gained = e.constant_rate * (k != 0 ? growth / k : dt);
  const double* mass = row(e.mass_new);
  double* now = row(e.now);
  for (int i = 0; i < row.count(); ++i) {
    const double value = now[i] + (growth * now[i] + gained);
    now[i] = mass[i] > 0.0 ? larger(value, smaller(now[i], 0.0)) : 0.0;
  }
}

void regions_row(const Row& row, const Each& e) {
  const double* mass = row(e.mass_new);
  double* now = row(e.now);
  for (const LocalSource& s : e.sources) {
    const double gained = s.rate * row.step().dt;
    s.cells->for_each(row.cell(), row.count(), [&](int first, int end) {
      for (int i = first; i < end; ++i) {
        const double value = larger(smaller(now[i] + gained, s.most), now[i]);
        now[i] = mass[i] > 0.0 ? value : 0.0;
      }
    });
  }
}

Each declare_each(TaskBuilder& task, const ScalarVariables::Each& e, const SchemeOptions& o,
                  int place) {
  const models::TransportedScalar& scalar = o.scalars[static_cast<std::size_t>(e.index)];
  Each each;
  each.q = task.read(e.old);
  each.mass = task.read(e.mass);
  each.mass_new = task.read(e.mass_new);
  each.now = task.write(e.now);
  each.carrier = e.carrier;
  each.place = place;
  each.constant_rate = scalar.constant_rate;
  each.own_rate = scalar.own_rate - scalar.decay;
  for (const models::ScalarSource& s : scalar.sources)
    each.sources.push_back({std::make_shared<CellRuns>(*s.piece, *o.level), s.rate, s.most});
  return each;
}

}  // namespace

void add_update(TaskList& list, const SchemeVariables& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("scalar update", effect);
  Handles h;
  for (const ScalarVariables::Each& e : v.scalars.each)
    h.each.push_back(declare_each(task, e, o, static_cast<int>(h.each.size())));
  for (int axis = 0; axis < o.axes.count; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const Stencil both = Stencil::along(o.axes.direction[axis], 0, 1);
    h.carrier[a] = task.read(v.scalars.carrier[a], both);
    h.face[a] = task.read(v.scalars.face[a], both);
    if (v.scalars.diffusive) h.spread[a] = task.read(v.scalars.spread[a], both);
  }
  if (o.second_order) h.base = task.read(v.scalars.base);
  dispatch(o.axes.count, o.components, [&]<int D, int C>() {
    task.kernel([=, options = o, diffusive = v.scalars.diffusive](const Row& row) {
      for (int begin = 0; begin < row.count(); begin += most_cells) {
        const int left = row.count() - begin;
        const Row part = row.part(begin, left < most_cells ? left : most_cells);
        for (const Each& e : h.each) {
          transport_row<D>(part, h, e, options.second_order, diffusive);
          rates_row(part, e);
          regions_row(part, e);
        }
      }
      if (diffusive)
        row.reductions().maximum(StepSlots::diffusion_rate,
                                 ordered_bits(diffusion_rate(options, row.step().spacing)));
    });
  });
}

}  // namespace sluice::ice::scalars
