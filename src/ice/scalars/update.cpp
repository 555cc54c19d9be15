// The new values of scalars, in the frame of the cell's own: no large numbers are subtracted.
//
//   q' = q + sum_d [F- (q_f- - q) + G- - F+ (q_f+ - q) - G+]/M'      G: what spreads
// which is M' q' = M q + sum_d (F- q_f- + G- - F+ q_f+ - G+) with M' = M + sum_d (F- - F+). A
// uniform scalar keeps its bits. Without diffusion q' lies between what the cell offered and what
// came in: round-off beyond that, large where little mass is left, is cut off.
// Then the sources over the step, each exactly: dq/dt = r0 + (r1 - c) q, and in regions
// dq/dt = rate up to a highest value. A sink takes no more than there is.
// Cells that solids touch keep the amount M' q' per volume of the cell, which whoever couples the
// two divides by the mass that a cell ends with (cut_cells/variables.hpp):
//   A = M q + sum_d [F- q_f- + G- - F+ q_f+ - G+]
#include <algorithm>
#include <cmath>
#include <memory>

#include "framework/task/reductions.hpp"
#include "ice/scalars/rows.hpp"
#include "ice/scalars/variables.hpp"
#include "ice/step/cell_runs.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/step/end_of_step.hpp"

namespace sluice::ice::scalars {
namespace {

constexpr int max_cells = 64;  // of a part of a row

// A source in the cells of a region, on one level.
struct LocalSource {
  std::shared_ptr<const CellRuns> cells;
  double rate = 0, most = 0;
};

struct Each {
  In q, mass, mass_new;
  In after;  // what the step made of it; of what is saved
  Out now;
  int carrier = 0, place = 0;
  double constant_rate = 0, own_rate = 0;  // without decay by a field
  models::Decay decay;
  std::vector<LocalSource> sources;
};

struct Handles {
  std::vector<Each> each;
  std::array<In, 3> carrier, face, spread;
  In base, cut;
  In diffusivity;  // of species
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
                   bool diffusive, double* __restrict now) {
  const int n = row.count();
  const double *Fm[D], *Fp[D], *qm[D], *qp[D];
  for (int d = 0; d < D; ++d) {
    Fm[d] = row(h.carrier[d], e.carrier);
    Fp[d] = row(h.carrier[d], e.carrier, d, 1);
    qm[d] = row(h.face[d], e.place);
    qp[d] = row(h.face[d], e.place, d, 1);
  }
  double low[max_cells], high[max_cells], spread[max_cells];
  own_bounds<D>(row, h, e, second_order, low, high);
  for (int i = 0; i < n; ++i) spread[i] = 0.0;
  for (int d = 0; diffusive && d < D; ++d) {
    const double* Gm = row(h.spread[d], e.place);
    const double* Gp = row(h.spread[d], e.place, d, 1);
    for (int i = 0; i < n; ++i) {
      spread[i] += Gm[i] - Gp[i];
      low[i] = -infinity;
      high[i] = infinity;
    }
  }
  const double* __restrict q = row(e.q);
  const double* __restrict mass = row(e.mass_new);
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
    const double value = q[i] + (gain + spread[i]) / larger(mass[i], min_divisor);
    // Of mass that a source puts where there was none nothing is known: it brings no scalar.
    const double kept = least <= most ? larger(smaller(value, most), least) : value;
    now[i] = mass[i] > 0.0 ? kept : 0.0;
  }
}

// dq/dt = r0 + k q over the step: q e^(k dt) + r0 (e^(k dt) - 1)/k.
struct Growth {
  double growth, gained;

  Growth(const Each& e, double k, double dt)
      : growth(std::expm1(k * dt)), gained(e.constant_rate * (k != 0 ? growth / k : dt)) {}
  double operator()(double now, double mass) const {
    const double value = now + (growth * now + gained);
    return mass > 0.0 ? larger(value, smaller(now, 0.0)) : 0.0;
  }
};

void rates_row(const Row& row, const Each& e, const Level& level, int along) {
  const double dt = row.step().dt;
  const double* mass = row(e.mass_new);
  double* now = row(e.now);
  if (e.decay.field) {
    IntVec3 cell = row.cell();
    for (int i = 0; i < row.count(); ++i, ++cell[along]) {
      const double c2 = e.decay.field->at(level.centre(cell));
      now[i] = Growth(e, e.own_rate - e.decay.rate(c2), dt)(now[i], mass[i]);
    }
    return;
  }
  if (e.constant_rate == 0 && e.own_rate == 0) return;
  const Growth grown(e, e.own_rate, dt);
  for (int i = 0; i < row.count(); ++i) now[i] = grown(now[i], mass[i]);
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

// A and M' of touched cells.
template <int D>
void amount_row(const Row& row, const Handles& h, const Each& e, bool diffusive, double* amount,
                double* left) {
  const int n = row.count();
  const double *q = row(e.q), *M = row(e.mass);
  for (int i = 0; i < n; ++i) {
    amount[i] = M[i] * q[i];
    left[i] = M[i];
  }
  for (int d = 0; d < D; ++d) {
    const double *Fm = row(h.carrier[d], e.carrier), *Fp = row(h.carrier[d], e.carrier, d, 1);
    const double *qm = row(h.face[d], e.place), *qp = row(h.face[d], e.place, d, 1);
    for (int i = 0; i < n; ++i) {
      amount[i] += Fm[i] * qm[i] - Fp[i] * qp[i];
      left[i] += Fm[i] - Fp[i];
    }
    if (!diffusive) continue;
    const double *Gm = row(h.spread[d], e.place), *Gp = row(h.spread[d], e.place, d, 1);
    for (int i = 0; i < n; ++i) amount[i] += Gm[i] - Gp[i];
  }
}

// Sources act on what a cell holds before its neighbours share, which may be less than nothing:
// linear in the mass, so that what all cells lose alike stays the same everywhere.
void touched_row(const Row& row, const Handles& h, const Each& e, const double* amount,
                 const double* left, const double* before) {
  const double* cut = row(h.cut);
  double* now = row(e.now);
  for (int i = 0; i < row.count(); ++i) {
    if (cut[i] == 0) continue;
    const double gain = now[i] - before[i];
    now[i] = amount[i] + left[i] * gain;
  }
}

// Rates of the species' own diffusivities, with the margin of diffusion_rate().
void law_rates(const Row& row, const Handles& h, const SchemeOptions& o) {
  const double of_one = diffusion_rate_of(1.0, o, row.step().spacing);
  double most = 0;
  for (const Each& e : h.each) {
    const double* D = row(h.diffusivity, e.place);
    for (int i = 0; i < row.count(); ++i) most = larger(most, D[i]);
  }
  row.reductions().maximum(StepSlots::diffusion_rate, ordered_bits(of_one * most));
}

Each declare_each(TaskBuilder& task, const ScalarVariables::Each& e, const SchemeOptions& o,
                  int place, bool saved = false) {
  const models::TransportedScalar& scalar = o.materials.scalars[e.index];
  Each each;
  each.q = task.read(e.old);
  each.mass = task.read(e.mass);
  each.mass_new = task.read(e.mass_new);
  if (saved)
    each.after = task.read(e.now);
  else
    each.now = task.write(e.now);
  each.carrier = e.carrier;
  each.place = place;
  each.constant_rate = scalar.constant_rate;
  each.decay = scalar.decay;
  each.own_rate = scalar.own_rate - (scalar.decay.field ? 0.0 : scalar.decay.rate(scalar.decay.c2));
  for (const models::ScalarSource& s : scalar.sources)
    each.sources.push_back({std::make_shared<CellRuns>(*s.piece, *o.grid.level), s.rate, s.most});
  return each;
}

// What all scalars' updates read of faces.
void read_faces(TaskBuilder& task, const FlowOfScalars& v, const SchemeOptions& o, Handles& h) {
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 0, 1);
    h.carrier[axis] = task.read(v.scalars.carrier[axis], both);
    h.face[axis] = task.read(v.scalars.face[axis], both);
    if (v.scalars.diffusive) h.spread[axis] = task.read(v.scalars.spread[axis], both);
  }
  if (o.scheme.second_order) h.base = task.read(v.scalars.base);
  if (v.scalars.walls.has_cut_cells) h.cut = task.read(v.scalars.walls.cut);
  if (o.transport.spreads_species) h.diffusivity = task.read(v.scalars.diffusivity);
}

// scalar-NAME_src: the new value less that of transport alone.
void save_source(TaskList& list, const FlowOfScalars& v, const SchemeOptions& o,
                 std::size_t scalar) {
  const ScalarVariables::Each& e = v.scalars.each[scalar];
  const models::TransportedScalar& of = o.materials.scalars[e.index];
  if (of.plain_name || (o.materials.releases_heat && of.of_species)) return;  // reactions.cpp
  TaskBuilder task = list.task("save " + of.source().name(), effect_saved_intermediates);
  Handles h;
  h.each.push_back(declare_each(task, e, o, static_cast<int>(scalar), true));
  read_faces(task, v, o, h);
  const Out out = task.write(list.output(of.source(), of.material));
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=, second = o.scheme.second_order,
                 has_cut_cells = v.scalars.walls.has_cut_cells](const Row& row) {
      for (int begin = 0; begin < row.count(); begin += max_cells) {
        const Row part = row.part(begin, std::min(row.count() - begin, max_cells));
        const Each& q = h.each.front();
        double carried[max_cells], amount[max_cells], left[max_cells];
        transport_row<D>(part, h, q, second, false, carried);
        const double* now = part(q.after);
        double* to = part(out);
        for (int i = 0; i < part.count(); ++i) to[i] = now[i] - carried[i];
        if (!has_cut_cells) continue;
        amount_row<D>(part, h, q, false, amount, left);
        const double* cut = part(h.cut);
        for (int i = 0; i < part.count(); ++i)
          if (cut[i] != 0) to[i] = left[i] > 0 ? (now[i] - amount[i]) / left[i] : 0.0;
      }
    });
  });
}

}  // namespace

void add_update(TaskList& list, const FlowOfScalars& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("scalar update", effect);
  Handles h;
  for (const ScalarVariables::Each& e : v.scalars.each)
    h.each.push_back(declare_each(task, e, o, static_cast<int>(h.each.size())));
  read_faces(task, v, o, h);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=, options = o, diffusive = v.scalars.diffusive,
                 has_cut_cells = v.scalars.walls.has_cut_cells](const Row& row) {
      for (int begin = 0; begin < row.count(); begin += max_cells) {
        const int left = row.count() - begin;
        const Row part = row.part(begin, left < max_cells ? left : max_cells);
        for (const Each& e : h.each) {
          transport_row<D>(part, h, e, options.scheme.second_order, diffusive, part(e.now));
          double before[max_cells], amount[max_cells], mass[max_cells];
          if (has_cut_cells) {
            std::copy_n(part(e.now), part.count(), before);
            amount_row<D>(part, h, e, diffusive, amount, mass);
          }
          rates_row(part, e, *options.grid.level, options.grid.axes.direction[0]);
          regions_row(part, e);
          if (has_cut_cells) touched_row(part, h, e, amount, mass, before);
        }
      }
      if (!diffusive) return;
      row.reductions().maximum(StepSlots::diffusion_rate,
                               ordered_bits(diffusion_rate(options, row.step().spacing)));
      if (h.diffusivity.index >= 0) law_rates(row, h, options);
    });
  });
  for (std::size_t n = 0; n < v.scalars.each.size(); ++n) save_source(list, v, o, n);
}

}  // namespace sluice::ice::scalars
