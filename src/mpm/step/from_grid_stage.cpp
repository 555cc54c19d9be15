// Grid to particles, deformation gradient, stress: a chunk of particles at a time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/artificial_viscosity.hpp"
#include "mpm/step/deformation.hpp"
#include "mpm/step/solid_step.hpp"
#include "mpm/transfer/from_grid.hpp"

namespace sluice::mpm {

// What the particles of one thread came to.
struct SolidStep::ThreadReport {
  ThreadReport(const BlockShape& shape, int reach, std::size_t kinds)
      : window(shape, reach), rates(kinds) {}

  Window window;
  GridAtParticles read;
  alignas(64) double wave_speed[chunk_size], heating[chunk_size];
  double rate = 0;    // of the time step, 1/s
  double travel = 0;  // farthest way of a particle, cells
  bool left = false;
  std::vector<KindRates> rates;
  NodeBooks books;  // of loads
  std::vector<const double*> old_history;
  std::vector<double*> history;
  std::string fault;  // of the particle with the lowest id; empty: none
  std::int64_t fault_id = 0;

  void keep_fault(std::int64_t id, std::string text) {
    if (!fault.empty() && fault_id <= id) return;
    fault = std::move(text);
    fault_id = id;
  }
};

namespace {

double second_moment_factor(Basis basis) {
  return basis == Basis::cubic ? 3.0 : 4.0;
}

// Positions and velocities after the step; FLIP: v + dv, PIC and APIC: u.
void move(const MpmScene& solids, const Body& body, const BlockWork& w, std::size_t at, int n,
          double dt, const GridAtParticles& read) {
  const Columns& c = body.carried->columns;
  for (int d = 0; d < 3; ++d) {
    const auto a = static_cast<std::size_t>(d);
    const double* x = w.set->coordinate(d) + at;
    const double* v = w.set->column(static_cast<std::size_t>(c.velocity) + a) + at;
    double* to_x = w.next->coordinate(d) + at;
    double* to_v = w.next->column(static_cast<std::size_t>(c.velocity) + a) + at;
    const double reference = body.units.reference[d];
    const double *u = read.u[d], *dv = read.dv[d];
    for (int q = 0; q < n; ++q) to_x[q] = x[q] + dt * (reference + u[q]);
    if (solids.transfer == Transfer::pic || solids.transfer == Transfer::apic)
      for (int q = 0; q < n; ++q) to_v[q] = reference + u[q];
    else
      for (int q = 0; q < n; ++q) to_v[q] = v[q] + dv[q];
    if (c.displacement >= 0) {
      const double* way = w.set->column(static_cast<std::size_t>(c.displacement) + a) + at;
      double* to = w.next->column(static_cast<std::size_t>(c.displacement) + a) + at;
      for (int q = 0; q < n; ++q) to[q] = way[q] + dt * (reference + u[q]);
    }
  }
}

// C of affine transfers: grad v, or for APIC the moments over the second moment of S; with rate
// kappa the velocities are drawn to u: v = beta u + (1 - beta)(v + dv), beta = kappa dt c/h.
void carry_affine(const MpmScene& solids, const Body& body, const BlockWork& w, std::size_t at,
                  int n, double beta, Vec3 spacing, const GridAtParticles& read) {
  const Columns& c = body.carried->columns;
  if (c.affine < 0) return;
  for (int e = 0; e < 9; ++e) {
    double* to = w.next->column(static_cast<std::size_t>(c.affine + e)) + at;
    const double h = spacing[e % 3];
    const double factor = second_moment_factor(solids.basis) / (h * h);
    if (solids.transfer == Transfer::apic)
      for (int q = 0; q < n; ++q) to[q] = factor * read.moment[e][q];
    else
      for (int q = 0; q < n; ++q) to[q] = read.L[e][q];
  }
  if (solids.transfer != Transfer::affine) return;
  for (int d = 0; d < 3; ++d) {
    double* v = w.next->column(static_cast<std::size_t>(c.velocity + d)) + at;
    const double reference = body.units.reference[d];
    for (int q = 0; q < n; ++q)
      v[q] = beta * (reference + read.u[d][q]) + (1 - beta) * v[q];
  }
}

double farthest(const GridAtParticles& read, Vec3 reference, int n, double dt, Vec3 spacing) {
  double far = 0;
  for (int d = 0; d < 3; ++d)
    for (int q = 0; q < n; ++q)
      far = std::max(far, std::fabs(reference[d] + read.u[d][q]) * (dt / spacing[d]));
  return far;
}

// Of the next step's length: max over directions of (c_p + |v_d|)/h_d.
double step_rate(const Level& level, const ParticleSet& next, int velocity, std::size_t at, int n,
                 const double* c) {
  double rate = 0;
  for (int d = 0; d < 3; ++d) {
    if (!level.active[static_cast<std::size_t>(d)]) continue;
    const double* v = next.column(static_cast<std::size_t>(velocity + d)) + at;
    double most = 0;
    for (int q = 0; q < n; ++q) most = std::max(most, c[q] + std::fabs(v[q]));
    rate = std::max(rate, most / level.spacing[d]);
  }
  return rate;
}

bool any_outside(const Level& level, const ParticleSet& next, std::size_t at, int n) {
  bool out = false;
  for (int d = 0; d < 3; ++d) {
    if (!level.active[static_cast<std::size_t>(d)]) continue;
    const double low = level.anchor[d] + level.domain.lower[d] * level.spacing[d];
    const double high = level.anchor[d] + level.domain.upper[d] * level.spacing[d];
    const double* x = next.coordinate(d) + at;
    // Written so that what is no number counts as outside.
    for (int q = 0; q < n; ++q) out |= !(x[q] >= low && x[q] < high);
  }
  return out;
}

Batch batch_of(const Body& body, const BlockWork& w, std::size_t at, int n,
               const StageScope& scope, GridAtParticles& read) {
  const Columns& c = body.carried->columns;
  const auto old = [&](int first) { return w.set->column(static_cast<std::size_t>(first)) + at; };
  const auto made = [&](int first) { return w.next->column(static_cast<std::size_t>(first)) + at; };
  Batch b;
  b.count = n;
  b.time = scope.step.time;
  b.dt = scope.step.dt;
  for (std::size_t e = 0; e < 9; ++e) {
    const int i = static_cast<int>(e);
    b.old_F[e] = old(c.F + i);
    b.F[e] = made(c.F + i);
    b.L[e] = read.L[e];
  }
  for (int e = 0; e < 6; ++e) {
    b.old_stress[static_cast<std::size_t>(e)] = old(c.stress + e);
    b.stress[static_cast<std::size_t>(e)] = made(c.stress + e);
  }
  b.temperature = old(c.temperature);
  b.mass = old(c.mass);
  b.volume_0 = old(c.volume_0);
  b.id = w.set->ids().data() + at;
  b.old_energy = old(c.energy);
  b.energy = made(c.energy);
  return b;
}

}  // namespace

void SolidStep::advance(const BlockWork& w, const StageScope& scope, ThreadReport& report) {
  Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  const Material& law = *body.material->law;
  const double dt = scope.step.dt;
  report.window.load(w.run.block, body.table, body.nodes);
  std::array<const double*, 3> x;
  for (int d = 0; d < 3; ++d) x[static_cast<std::size_t>(d)] = w.set->coordinate(d);
  std::vector<const double*>& old_history = report.old_history;
  std::vector<double*>& history = report.history;
  for (std::size_t at = w.run.begin; at < w.run.end; at += chunk_size) {
    const int n = static_cast<int>(std::min<std::size_t>(chunk_size, w.run.end - at));
    read_window(solids_->basis, body.grid, x, static_cast<int>(at), n,
                solids_->transfer == Transfer::apic, report.window, report.read);
    if (solids_->axisymmetric) add_hoop_rate(*w.set, body.units.reference.x, at, n, report.read);
    move(*solids_, body, w, at, n, dt, report.read);
    take_outside_forces(w, at, n, report.read, report.books);
    carry_affine(*solids_, body, w, at, n, affine_beta_, level_.spacing, report.read);
    Batch b = batch_of(body, w, at, n, scope, report.read);
    old_history.clear();
    history.clear();
    for (int h = 0; h < body.carried->history_columns; ++h) {
      old_history.push_back(w.set->column(static_cast<std::size_t>(c.history + h)) + at);
      history.push_back(w.next->column(static_cast<std::size_t>(c.history + h)) + at);
    }
    b.old_history = old_history;
    b.history = history;
    std::fill_n(report.heating, n, 0.0);
    b.wave_speed = report.wave_speed;
    b.heating = report.heating;
    const auto tell = [&](int q, const char* reason, double value) {
      const std::size_t i = at + static_cast<std::size_t>(q);
      const Vec3 p = w.set->position(i);
      report.keep_fault(
          w.set->id(i),
          fmt::format("particle {} of material {} '{}' at [{:g}, {:g}, {:g}]: {} ({:g})",
                      w.set->id(i), w.kind, body.material->name, p.x, p.y, p.z, reason, value));
    };
    const int bad = deform(solids_->subcycles_of_F, dt, b,
                           w.next->column(static_cast<std::size_t>(c.volume)) + at);
    if (bad >= 0) {
      const double J = w.next->column(static_cast<std::size_t>(c.volume))[at + static_cast<std::size_t>(bad)] /
                       b.volume_0[bad];
      tell(bad, "the deformation gradient of the step turns it inside out, det F", J);
      continue;
    }
    if (const auto fault = law.update(b)) {
      tell(fault->particle, fault->reason, fault->value);
      continue;
    }
    if (c.viscous >= 0)
      add_viscosity(*solids_, body, w, at, n, dt, level_.spacing, report.read, report.heating);
    double* T = w.next->column(static_cast<std::size_t>(c.temperature)) + at;
    for (int q = 0; q < n; ++q) T[q] = b.temperature[q] + dt * report.heating[q];
    if (const double* rate = heat_ != nullptr ? heat_->rates(w.kind, w.box) : nullptr)
      for (int q = 0; q < n; ++q) T[q] += dt * rate[at + static_cast<std::size_t>(q)];
    report.travel = std::max(report.travel, farthest(report.read, body.units.reference, n, dt,
                                                     level_.spacing));
    report.left |= any_outside(level_, *w.next, at, n);
    report.rate = std::max(
        report.rate, step_rate(level_, *w.next, c.velocity, at, n, report.wave_speed));
    report.rates[static_cast<std::size_t>(w.kind)].add(
        rates_of(*w.set, *w.next, c, at, at + static_cast<std::size_t>(n)));
  }
}

Verdict SolidStep::from_grid(const StageScope& scope) {
  // beta = kappa dt max(c_p)/h, with the rate of the step before in place of the speed over h.
  affine_beta_ = solids_->transfer == Transfer::affine
                     ? std::min(1.0, solids_->affine_damping * scope.step.dt *
                                         scope.maxima->front().front())
                     : 0;
  if (heat_ != nullptr)
    heat_->conduct({&scope, &bodies_, &work_, exchange_.get(), boundary_.get(), outside_.get()});
  const ThreadTeam& team = *scope.levels.front()->team();
  const int reach = reach_of(solids_->basis);
  std::vector<ThreadReport> reports;
  for (int t = 0; t < team.size(); ++t) reports.emplace_back(shape_, reach, bodies_.size());
  team.for_each(work_.size(), [&](std::size_t n, int thread) {
    advance(work_[n], scope, reports[static_cast<std::size_t>(thread)]);
  });
  return conclude(scope, reports);
}

// What all ranks agree upon: maxima of the next step, faults, sums.
Verdict SolidStep::conclude(const StageScope& scope, std::vector<ThreadReport>& reports) {
  ThreadReport& all = reports.front();
  for (std::size_t t = 1; t < reports.size(); ++t) {
    const ThreadReport& r = reports[t];
    all.rate = std::max(all.rate, r.rate);
    all.travel = std::max(all.travel, r.travel);
    all.left |= r.left;
    for (std::size_t k = 0; k < r.rates.size(); ++k) all.rates[k].add(r.rates[k]);
    for (std::size_t s = 0; s < r.books.sums.size(); ++s)
      all.books.sums[s].merge(r.books.sums[s]);
    if (!r.fault.empty()) all.keep_fault(r.fault_id, r.fault);
  }
  std::vector<double> maxima(rate_count(bodies_.size()));
  maxima.insert(maxima.end(), outside_->counts().begin(), outside_->counts().end());
  maxima[0] = all.rate;
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    all.rates[k].to(std::span(maxima).subspan(1 + k * static_cast<std::size_t>(KindRates::count),
                                              static_cast<std::size_t>(KindRates::count)));
  bool sound = true;
  for (const double m : maxima) sound &= std::isfinite(m);
  if (!sound && all.fault.empty())
    all.keep_fault(0, "what a particle holds after the step is no number");
  Reduction reduction;
  std::vector<Reduction::Maximum> slots;
  for (const double m : maxima) slots.push_back(reduction.add_maximum(m));
  const auto travel = reduction.add_maximum(all.travel);
  const auto left = reduction.add_any(all.left);
  const auto fault = reduction.add_any(!all.fault.empty());
  std::vector<Reduction::Sum> sums;
  for (std::size_t s = 0; s < books_.sums.size(); ++s) {
    books_.sums[s].merge(all.books.sums[s]);
    sums.push_back(reduction.add_sum(books_.sums[s]));
  }
  scope.ranks->reduce(reduction);
  if (reduction.any(fault)) {
    *scope.reason = all.fault;
    for (const std::string& text : scope.ranks->gather_to_all(all.fault))
      if (!text.empty() && (scope.reason->empty() || text < *scope.reason)) *scope.reason = text;
    return Verdict::reject;
  }
  for (std::size_t n = 0; n < maxima.size(); ++n) maxima[n] = reduction.maximum(slots[n]);
  new_rates_ = std::move(maxima);
  travel_ = reduction.maximum(travel);
  left_ = reduction.any(left);
  for (std::size_t s = 0; s < sums.size(); ++s)
    (*scope.sums)[s] += reduction.sum(sums[s]).value();
  return Verdict::good;
}

}  // namespace sluice::mpm
