// Grid to particles, deformation gradient, stress: a chunk of particles at a time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/base/largest.hpp"
#include "mpm/nodes/node_sums.hpp"
#include "mpm/shape/second_moment.hpp"
#include "mpm/step/artificial_viscosity.hpp"
#include "mpm/step/carry_corners.hpp"
#include "mpm/step/deformation.hpp"
#include "mpm/step/law_batch.hpp"
#include "mpm/step/thread_report.hpp"
#include "mpm/step/travel.hpp"
#include "mpm/transfer/from_grid.hpp"

namespace sluice::mpm {

namespace {

double least_spacing(const Level& level) {
  double least = std::numeric_limits<double>::infinity();
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)]) least = std::min(least, level.spacing[d]);
  return least;
}

// Positions and velocities after the step. FLIP: v + dv; PIC and APIC: u; XPIC: the filtered
// velocity and dv, which nodes hold as one, and places move with u; as the format has XPIC2, by
// dt S v + dt (v_new - v)/2. The filter has left S v where the new velocities will stand: dv is
// then u - S v.
void move(const MpmScene& solids, const Body& body, const BlockWork& w, std::size_t at, int n,
          double dt, GridAtParticles& read) {
  const Columns& c = body.carried->columns;
  for (int d = 0; d < 3; ++d) {
    const auto a = static_cast<std::size_t>(d);
    const double* x = w.set->coordinate(d) + at;
    const double* v = w.set->column(static_cast<std::size_t>(c.velocity) + a) + at;
    double* to_x = w.next->coordinate(d) + at;
    double* to_v = w.next->column(static_cast<std::size_t>(c.velocity) + a) + at;
    const double reference = body.units.reference[d];
    double *u = read.u[d], *dv = read.dv[d];
    if (solids.transfer == Transfer::xpic) {
      for (int q = 0; q < n; ++q) {
        const double before = to_v[q];  // S v - v_ref
        to_v[q] = reference + dv[q];
        dv[q] = u[q] - before;
        to_x[q] =
            x[q] + dt * (solids.xpic2_of_format ? (reference + before) + 0.5 * (to_v[q] - v[q])
                                                : reference + u[q]);
      }
    } else {
      for (int q = 0; q < n; ++q) to_x[q] = x[q] + dt * (reference + u[q]);
      if (solids.transfer == Transfer::pic || solids.transfer == Transfer::apic)
        for (int q = 0; q < n; ++q) to_v[q] = reference + u[q];
      else
        for (int q = 0; q < n; ++q) to_v[q] = v[q] + dv[q];
    }
    if (c.displacement >= 0) {
      const double* way = w.set->column(static_cast<std::size_t>(c.displacement) + a) + at;
      double* to = w.next->column(static_cast<std::size_t>(c.displacement) + a) + at;
      if (solids.xpic2_of_format)
        for (int q = 0; q < n; ++q) to[q] = way[q] + (to_x[q] - x[q]);
      else
        for (int q = 0; q < n; ++q) to[q] = way[q] + dt * (reference + u[q]);
    }
  }
}

// Affine transfer of rate kappa: velocities are drawn to u, v = beta u + (1 - beta)(v + dv) with
// beta = min(1, kappa dt max(c_p)/h): what is damped in a time does not depend on dt.
void damp(const MpmScene& solids, const Body& body, const BlockWork& w, std::size_t at, int n,
          double dt, const GridAtParticles& read) {
  if (solids.transfer != Transfer::affine) return;
  const double beta = std::min(1.0, solids.affine_damping * dt * body.rates.wave);
  for (int d = 0; d < 3; ++d) {
    double* v = w.next->column(static_cast<std::size_t>(body.carried->columns.velocity + d)) + at;
    const double reference = body.units.reference[d];
    for (int q = 0; q < n; ++q) v[q] = beta * (reference + read.u[d][q]) + (1 - beta) * v[q];
  }
}

// C of affine transfers: grad v, or for APIC the moments over the second moment of S.
void carry_affine(const MpmScene& solids, const Body& body, const BlockWork& w, std::size_t at,
                  int n, Vec3 spacing, const GridAtParticles& read) {
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
}

// Total Lagrangian: what was read is dF/dt = sum v* (x) grad_X S; L = dF/dt F^-1.
void to_spatial_gradient(const ParticleShape& shape, std::size_t at, int n, GridAtParticles& read) {
  for (int q = 0; q < n; ++q) {
    const auto f = [&](int r, int c) {
      return shape
          .F[static_cast<std::size_t>(3 * (r % 3) + c % 3)][at + static_cast<std::size_t>(q)];
    };
    double adjoint[3][3], rate[9];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        adjoint[r][c] = f(c + 1, r + 1) * f(c + 2, r + 2) - f(c + 1, r + 2) * f(c + 2, r + 1);
    const double J = f(0, 0) * adjoint[0][0] + f(0, 1) * adjoint[1][0] + f(0, 2) * adjoint[2][0];
    for (int e = 0; e < 9; ++e) rate[e] = read.L[e][q] / J;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        read.L[3 * r + c][q] = rate[3 * r] * adjoint[0][c] + rate[3 * r + 1] * adjoint[1][c] +
                               rate[3 * r + 2] * adjoint[2][c];
  }
}

}  // namespace

// Rigid bodies go with their own velocity, with that which a rule of contact prescribes, or, where
// they transmit forces, with what these make of it. As XPIC has it, the new velocity stands in dv
// and the one before in the column of the new ones.
void SolidStep::read_rigid(const BlockWork& w, std::size_t at, int n, bool booked,
                           ThreadReport& report) const {
  const Columns& c = bodies_[static_cast<std::size_t>(w.kind)].carried->columns;
  const MasterMotion* motion = contact_ != nullptr ? contact_->motion_of(w.kind) : nullptr;
  const std::array<const double*, 3> v = read_columns<3>(*w.set, c.velocity);
  const double* mass = w.set->column(static_cast<std::size_t>(c.mass));
  const std::array<double, 9> L = motion != nullptr ? motion->gradient() : std::array<double, 9>{};
  for (std::size_t e = 0; e < 9; ++e) {
    const double h = level_.spacing[static_cast<int>(e % 3)];
    const double second_moment = h * h / second_moment_factor(solids_->basis);
    std::fill_n(report.read.L[e], n, L[e]);
    std::fill_n(report.read.moment[e], n, L[e] * second_moment);
  }
  for (int d = 0; d < 3 && c.outside_force >= 0; ++d)
    std::fill_n(w.next->column(static_cast<std::size_t>(c.outside_force + d)) + at, n, 0.0);
  const Vec3 pushed = bodies_[static_cast<std::size_t>(w.kind)].pushed;
  const bool filtered = solids_->transfer == Transfer::xpic;
  for (int q = 0; q < n; ++q) {
    const std::size_t p = at + static_cast<std::size_t>(q);
    const Vec3 before{v[0][p], v[1][p], v[2][p]};
    const Vec3 after = motion != nullptr ? motion->at(w.set->position(p)) : before + pushed;
    for (int d = 0; d < 3; ++d) {
      const bool active = level_.active[static_cast<std::size_t>(d)];
      report.read.u[d][q] = active ? after[d] : 0;
      report.read.dv[d][q] = active ? after[d] - before[d] : 0;
      const double impulse = mass[p] * report.read.dv[d][q];
      if (filtered && booked) {
        w.next->column(static_cast<std::size_t>(c.velocity + d))[p] = active ? before[d] : 0;
        report.read.dv[d][q] = active ? after[d] : 0;
      }
      // Where it transmits forces, what it got is booked with them.
      if (impulse == 0 || !booked || pushed != Vec3{}) continue;
      report.books.sums[static_cast<std::size_t>(StepSums::impulse_x + d)].add(impulse);
      report.books.sums[StepSums::work].add(0.5 * impulse * (before[d] + after[d]));
    }
    for (int k = 0; k < c.corner_count; ++k) {
      const Vec3 of_corner = motion != nullptr ? motion->at(corner_at(*w.set, c, k, p)) : after;
      for (int d = 0; d < 3; ++d)
        report.read.corner[k][d][q] = level_.active[static_cast<std::size_t>(d)] ? of_corner[d] : 0;
    }
  }
}

// Places and velocities, from the nodes in the report's window.
void SolidStep::move_particles(const BlockWork& w, const StageScope& scope, std::size_t at, int n,
                               ThreadReport& report) {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  const double dt = scope.step.dt;
  if (body.material->rigid)
    read_rigid(w, at, n, true, report);
  else if (solids_->maps_back())
    read_motion(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                static_cast<int>(at), n, report.window, report.read);
  else
    read_window(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                static_cast<int>(at), n, solids_->transfer == Transfer::apic, report.window,
                report.read);
  move(*solids_, body, w, at, n, dt, report.read);
  if (c.corners >= 0) move_corners(body, w, at, n, body.units.reference, dt, report.read.corner);
  if (!body.material->rigid) {
    take_outside_forces(w, at, n, report.read, report.books);
    damp(*solids_, body, w, at, n, dt, report.read);
    begin_losses(w, at, n, report.impulses);
  }
  report.travel = std::max(report.travel, farthest_way(*w.set, *w.next, at, n, level_.spacing));
  report.left |= any_outside(level_, *w.next, at, n);
}

// Of MUSL: the particles move before velocities are mapped back.
std::vector<KindRates> SolidStep::move_all(const StageScope& scope) {
  std::vector<ThreadReport> reports = new_reports(scope);
  scope.levels.front()->team()->for_each(work_.size(), [&](std::size_t n, int thread) {
    const BlockWork& w = work_[n];
    const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
    ThreadReport& report = reports[static_cast<std::size_t>(thread)];
    KindRates& rates = report.rates[static_cast<std::size_t>(w.kind)];
    if (!body.material->rigid) report.window.load(w.lowest, w.highest, body.table, body.nodes);
    for (std::size_t at = w.run.begin; at < w.run.end; at += chunk_size)
      move_particles(w, scope, at,
                     static_cast<int>(std::min<std::size_t>(chunk_size, w.run.end - at)), report);
    const auto v = read_columns<3>(*w.next, body.carried->columns.velocity);
    for (int d = 0; d < 3; ++d) {
      const double* along = v[static_cast<std::size_t>(d)];
      Most up(rates.up[d]), down(rates.down[d]);
      for_eights(w.run.begin, w.run.end, [&](auto p) {
        up.add(p(along));
        down.add(-p(along));
      });
      rates.up[d] = up.value();
      rates.down[d] = down.value();
    }
  });
  std::string none;
  return take_first_reports(scope, reports, none);
}

// What the first of two passes over particles came to: bounds of their new velocities.
std::vector<KindRates> SolidStep::take_first_reports(const StageScope& scope,
                                                     const std::vector<ThreadReport>& reports,
                                                     std::string& fault) {
  travel_ = 0;
  left_ = false;
  std::vector<KindRates> rates(bodies_.size());
  keep_resting(scope.step, rates);
  for (const ThreadReport& r : reports) {
    travel_ = std::max(travel_, r.travel);
    left_ |= r.left;
    for (std::size_t k = 0; k < rates.size(); ++k) rates[k].add(r.rates[k]);
    books_.merge(r.books);
    if (!r.fault.empty() && (fault.empty() || r.fault < fault)) fault = r.fault;
  }
  return rates;
}

// What has failed moves on as it is: L = 0. (Corners that neighbours share deform it still.)
static void hold_failed(const Material& law, const Batch& b, GridAtParticles& read) {
  const double* failed = b.old_history[static_cast<std::size_t>(law.failed_column())];
  for (double* L : read.L)
    for (int q = 0; q < b.count; ++q)
      if (failed[q] != 0) L[q] = 0;
}

void SolidStep::advance(const BlockWork& w, const StageScope& scope, ThreadReport& report) {
  Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  const Material& law = *body.material->law;
  const double dt = scope.step.dt;
  if (!body.material->rigid && solids_->midpoint())
    report.window.load(w.middle_lowest, w.middle_highest, body.table, body.mapped);
  else if (!body.material->rigid)
    report.window.load(w.lowest, w.highest, body.table,
                       solids_->maps_back() ? body.mapped : body.nodes);
  if (c.lost_energy >= 0) load_losses(w, report);
  bool warms = warms_by_friction(body) && body.friction.blocks() > 0;
  if (warms) {
    report.friction.load(w.lowest, w.highest, body.table, body.friction);
    warms = report.friction.any_in(0);
  }
  const bool wet = c.pore_pressure >= 0;
  if (wet && report.water == nullptr) report.water = std::make_unique<PoreWater::Reads>(shape_);
  if (wet) water_->load(w, body, *report.water);
  const bool shares = solids_->pressure_stabilised && !body.material->rigid;
  if (shares)
    find_dilatations(w, dt, report.window, report.read, report.columns, report.dilatation);
  for (std::size_t at = w.run.begin; at < w.run.end; at += chunk_size) {
    const int n = static_cast<int>(std::min<std::size_t>(chunk_size, w.run.end - at));
    const bool rigid = body.material->rigid;
    const bool middle = solids_->midpoint() && !rigid;
    if (!solids_->maps_back())
      move_particles(w, scope, at, n, report);
    else if (rigid)
      read_rigid(w, at, n, false, report);
    else
      read_velocities(solids_->basis, body.grid, places_of_gradients(w), shape_of_gradients(w),
                      static_cast<int>(at), n, report.window, report.read);
    if (solids_->axisymmetric)
      add_hoop_rate(middle ? *w.next : *w.set,
                    (solids_->maps_back() && !rigid ? body.mapped_units : body.units).reference.x,
                    at, n, report.read);
    if (middle) finish_motion(w, dt, at, n, report);
    carry_affine(*solids_, body, w, at, n, level_.spacing, report.read);
    if (solids_->total_lagrangian && !rigid)
      to_spatial_gradient(shape_of(*w.set, c), at, n, report.read);
    Batch& b = report.columns.between(*w.set, *w.next, *body.carried, at, n);
    b.time = scope.step.time;
    b.spacing = least_spacing(level_);
    b.dt = dt;
    if (c.corners < 0 && law.failed_keep_their_shape()) hold_failed(law, b, report.read);
    for (std::size_t e = 0; e < 9; ++e) b.L[e] = report.read.L[e];
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
    // Steps of a prescribed deformation are exact at first order.
    const int bad = deform(prescribed_ != nullptr ? 1 : solids_->subcycles_of_F, dt, b,
                           w.next->column(static_cast<std::size_t>(c.volume)) + at);
    if (bad >= 0) {
      const double J =
          w.next->column(static_cast<std::size_t>(c.volume))[at + static_cast<std::size_t>(bad)] /
          b.volume_0[bad];
      tell(bad, "the deformation gradient of the step turns it inside out, det F", J);
      continue;
    }
    if (c.corners >= 0)
      if (const auto fault = deform_to_corners(body, w, at, b, report.read)) {
        tell(fault->particle, fault->reason, fault->value);
        continue;
      }
    if (shares) take_dilatation(w, at, b, report.dilatation, report.read);
    if (const auto fault = law.update(b)) {
      tell(fault->particle, fault->reason, fault->value);
      continue;
    }
    if (c.viscous >= 0)
      add_viscosity(*solids_, body, w, at, n, dt, level_.spacing, report.read, report.heating,
                    report.wave_speed);
    if (wet) {
      water_->advance(w, body, at, n, dt, report.read, *report.water);
      add_water_to_waves(*body.material, c, *w.set, *w.next, at, n, report.wave_speed);
    }
    double* T = w.next->column(static_cast<std::size_t>(c.temperature)) + at;
    for (int q = 0; q < n; ++q) T[q] = b.temperature[q] + dt * report.heating[q];
    if (const double* rate = heat_ != nullptr ? heat_->rates(w.kind, w.box) : nullptr)
      for (int q = 0; q < n; ++q) T[q] += dt * rate[at + static_cast<std::size_t>(q)];
    if (concentration_ != nullptr) diffuse(w, at, n, dt);
    if (c.lost_energy >= 0) settle_losses(w, scope, at, n, report);
    if (warms) warm_by_friction(w, at, n, report);
    if (c.heating >= 0) {
      double* rate = w.next->column(static_cast<std::size_t>(c.heating)) + at;
      for (int q = 0; q < n; ++q) rate[q] = (T[q] - b.temperature[q]) / dt;
    }
    if (!rigid)
      add_energies(*w.set, *w.next, c, at, n, body.energy_units,
                   report.books.bodies[static_cast<std::size_t>(w.kind)]);
    if (body.parted.counts())
      body.parted.add(*w.set, *w.next, c, at, n,
                      report.books.bodies[static_cast<std::size_t>(w.kind)]);
    if (!jumps_.empty()) jump(w, at, n, report.left);
    report.rate =
        std::max(report.rate, step_rate(level_, *w.next, c, law, at, n, report.wave_speed));
    KindRates rates = rates_of(solids_->basis, body.grid, *w.set, *w.next, c, at,
                               at + static_cast<std::size_t>(n));
    rates.wave = wave_rate(level_, n, report.wave_speed);
    report.rates[static_cast<std::size_t>(w.kind)].add(rates);
  }
}

// C <- C + dt dC/dt within the bounds of the material.
void SolidStep::diffuse(const BlockWork& w, std::size_t at, int n, double dt) const {
  const double* rate = concentration_->rates(w.kind, w.box);
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  if (rate == nullptr || !body.material->diffusion) return;
  const Diffusion& bounds = *body.material->diffusion;
  const auto column = static_cast<std::size_t>(body.carried->columns.concentration);
  const double* before = w.set->column(column) + at;
  double* C = w.next->column(column) + at;
  for (int q = 0; q < n; ++q)
    C[q] = std::clamp(before[q] + dt * rate[at + static_cast<std::size_t>(q)], bounds.least,
                      bounds.most);
}

std::vector<SolidStep::ThreadReport> SolidStep::new_reports(const StageScope& scope) const {
  std::vector<ThreadReport> reports;
  for (int t = 0; t < scope.levels.front()->team()->size(); ++t)
    reports.emplace_back(shape_, bodies_.size());
  return reports;
}

Verdict SolidStep::from_grid(const StageScope& scope) {
  for (Heat* spreads : {heat_.get(), concentration_.get()})
    if (spreads != nullptr)
      spreads->conduct(
          {&scope, &bodies_, &work_, exchange_.get(), boundary_.get(), outside_.get()});
  if (solids_->midpoint()) book_corner_work(scope.step.dt, books_);
  std::vector<ThreadReport> reports = new_reports(scope);
  if (solids_->maps_back()) {
    reports.front().travel = travel_;
    reports.front().left = left_;
  }
  scope.levels.front()->team()->for_each(work_.size(), [&](std::size_t n, int thread) {
    advance(work_[n], scope, reports[static_cast<std::size_t>(thread)]);
  });
  return conclude(scope, reports);
}

}  // namespace sluice::mpm
