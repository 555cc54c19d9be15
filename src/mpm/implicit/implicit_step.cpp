#include "mpm/implicit/implicit_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/run/component/event_ledger.hpp"
#include "mpm/implicit/conduction.hpp"
#include "mpm/implicit/step_books.hpp"
#include "mpm/step/body.hpp"
#include "mpm/step/book_leaving.hpp"
#include "mpm/step/rates.hpp"

namespace sluice::mpm {
namespace {

constexpr double most_cells = 0.8;     // that a particle goes in a step
constexpr int most_shorter_steps = 2;  // without inertia, before a run ends
constexpr int many_unknowns = 20000;   // of a direct solution

}  // namespace

ImplicitStep::ImplicitStep(const Scene& scene, const MpmScene& solids,
                           const std::vector<Carried>& carried,
                           const std::vector<ParticleKind>& kinds)
    : scene_(&scene), solids_(&solids), carried_(&carried), kinds_(&kinds) {}

NodesOfStep::Parts ImplicitStep::parts() const {
  return {scene_, solids_, &level_, boundary_.get(), carried_, &particles_, reached_.get()};
}

Verdict ImplicitStep::begin(const StageScope& scope) {
  const StepScope& step = scope.step;
  level_ = scope.levels.front()->level();
  if (boundary_ == nullptr) {
    boundary_ = std::make_unique<NodeBoundary>(*scene_, *solids_, level_);
    outside_ = std::make_unique<OutsideForces>(*solids_, level_, *carried_);
  }
  particles_.gather(*scope.particles, *kinds_, *scope.ranks);
  reached_ = std::make_unique<ReachedNodes>(*solids_, level_, *boundary_, *carried_, particles_);
  find_rigid_displacements(step.time, step.dt);
  find_forces(scope);
  nodes_ = std::make_unique<NodesOfStep>(parts(), rigid_, forces_, step.dt, scope.dt_before == 0);
  equilibrium_ = std::make_unique<Equilibrium>(parts(), *scope.levels.front()->team(), step.time);
  return Verdict::good;
}

// Their own velocity until a rule stops them, and then what it says.
void ImplicitStep::find_rigid_displacements(double time, double dt) {
  rigid_.assign(particles_.count(), {});
  stopped_.assign(particles_.count(), false);
  for (std::size_t k = 0; k < particles_.count(); ++k) {
    if (!solids_->materials[k].rigid) continue;
    const ParticleSet& set = particles_.kind(k).now;
    const auto v = read_columns<3>(set, (*carried_)[k].columns.velocity);
    double moving = 1;  // share of the step
    Vec3 after{};
    for (const ContactRule& rule : solids_->rigid_contacts)
      if (rule.takes(static_cast<int>(k)) && rule.stop_time) {
        moving = std::clamp((*rule.stop_time - time) / dt, 0.0, 1.0);
        after = rule.velocity_after_stop;
        break;
      }
    stopped_[k] = moving == 0;
    rigid_[k].resize(set.size());
    for (std::size_t q = 0; q < set.size(); ++q)
      for (int d = 0; d < 3; ++d)
        if (level_.active[static_cast<std::size_t>(d)])
          rigid_[k][q][d] =
              dt * (moving * v[static_cast<std::size_t>(d)][q] + (1 - moving) * after[d]);
  }
}

void ImplicitStep::find_forces(const StageScope& scope) {
  const std::vector<double>& maxima = scope.maxima->front();
  outside_->count(*scope.particles, *scope.ranks,
                  std::span(maxima).subspan(rate_count(particles_.count())));
  fill_forces(scope.step.time, forces_before_);
  fill_forces(scope.step.time + scope.step.dt, forces_);
}

void ImplicitStep::fill_forces(double time, NodesOfStep::Vectors& forces) {
  forces.assign(particles_.count(), {});
  for (std::size_t k = 0; k < particles_.count(); ++k) {
    const auto kind = static_cast<int>(k);
    if (!outside_->acts(kind) || solids_->materials[k].rigid) continue;
    const ParticleSet& set = particles_.kind(k).now;
    outside_->make_room(kind, set.size());
    outside_->fill(kind, 0, set, 0, set.size(), time);
    const auto f = outside_->forces(kind, 0);
    forces[k].resize(set.size());
    for (std::size_t q = 0; q < set.size(); ++q) forces[k][q] = {f[0][q], f[1][q], f[2][q]};
  }
}

Verdict ImplicitStep::find_displacements(const StageScope& scope) {
  newton_ = {};
  if (!solids_->implicit->mechanics) {
    for (std::vector<Vec3>* field : {&nodes_->u, &nodes_->v0, &nodes_->a0})
      std::fill(field->begin(), field->end(), Vec3{});
    newton_.converged = true;
    return Verdict::good;
  }
  newton_ = equilibrium_->find(*nodes_, solver_);
  record_events(scope);
  if (newton_.converged) return Verdict::good;
  *scope.reason = newton_.reason;
  retried_ = true;
  // Loads do not shrink with the step: a shorter one helps laws alone that depend on its length.
  if (!solids_->implicit->dynamic && ++failures_ > most_shorter_steps)
    throw PhysicsError(fmt::format("the step at t = {:g}, with {} shorter steps too: {}",
                                   scope.step.time, most_shorter_steps, newton_.reason));
  return Verdict::reject;
}

// Every rank has found the same: one of them records it.
void ImplicitStep::record_events(const StageScope& scope) const {
  if (scope.ranks->rank() != 0) return;
  const auto record = [&](const char* name, int count, double value) {
    EventPlace place;
    place.task = "displacements of the nodes";
    place.value = value;
    if (count > 0) scope.events->record(name, place, count);
  };
  record("loads were applied in increments", newton_.increments, newton_.increments);
  record("negative eigenvalues of tangents were left out", newton_.projected, newton_.projected);
  record("direct solution of more than 20,000 unknowns (<solver>simple)",
         newton_.directly && newton_.unknowns > many_unknowns ? 1 : 0, newton_.unknowns);
}

Verdict ImplicitStep::conduct(const StageScope& scope) {
  warmed_.clear();
  if (!solids_->implicit->conducts) return Verdict::good;
  const HeatStep step{scope.step.time, scope.step.dt, scope.levels.front()->team()};
  if (conduct_heat(parts(), *outside_, step, warmed_)) return Verdict::good;
  *scope.reason =
      "the conduction of heat has no solution: without storage of heat "
      "(DoTransientImplicitHeatConduction false) a side must give a temperature";
  return Verdict::reject;
}

// Positions, velocities, accelerations from the nodes.
void ImplicitStep::read_nodes(std::size_t k, const Response::Span& span) {
  const Columns& c = (*carried_)[k].columns;
  const Stencils& s = reached_->of(k);
  const ParticleSet& now = particles_.kind(k).now;
  ParticleSet& next = particles_.kind(k).next;
  const auto v = read_columns<3>(now, c.velocity), way = read_columns<3>(now, c.displacement);
  const auto to_v = write_columns<3>(next, c.velocity),
             to_a = write_columns<3>(next, c.acceleration),
             to_way = write_columns<3>(next, c.displacement),
             to_force = write_columns<3>(next, c.outside_force);
  const bool dynamic = solids_->implicit->dynamic;
  for (std::size_t p = span.at; p < span.at + static_cast<std::size_t>(span.count); ++p) {
    Vec3 u{}, change{}, a{};
    for (std::size_t e = s.first(p); e < s.first(p + 1); ++e) {
      const auto n = static_cast<std::size_t>(s.node[e]);
      const Vec3 v1 = nodes_->velocity(n), a1 = nodes_->acceleration(n);
      for (int d = 0; d < 3; ++d) {
        const double share = s.weight[e] * s.sign(e, d);
        u[d] += share * nodes_->u[n][d];
        change[d] += share * (v1[d] - nodes_->v0[n][d]);
        a[d] += share * a1[d];
      }
    }
    for (int d = 0; d < 3; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      next.coordinate(d)[p] = now.coordinate(d)[p] + u[d];
      if (!solids_->implicit->mechanics)
        to_v[axis][p] = v[axis][p];
      else
        to_v[axis][p] = dynamic ? v[axis][p] + change[d] : u[d] / span.dt;
      to_a[axis][p] = a[d];
      if (to_way[axis] != nullptr) to_way[axis][p] = way[axis][p] + u[d];
      if (to_force[axis] != nullptr) to_force[axis][p] = forces_[k].empty() ? 0 : forces_[k][p][d];
    }
  }
}

void ImplicitStep::warm(std::size_t k, const Response::Span& span, const double* heating) {
  const Columns& c = (*carried_)[k].columns;
  const Stencils& s = reached_->of(k);
  const double* T = span.set->column(static_cast<std::size_t>(c.temperature));
  ParticleSet& next = particles_.kind(k).next;
  double* to = next.column(static_cast<std::size_t>(c.temperature));
  for (int q = 0; q < span.count; ++q) {
    const std::size_t p = span.at + static_cast<std::size_t>(q);
    to[p] = T[p] + (heating != nullptr ? span.dt * heating[q] : 0);
    if (!warmed_.empty())
      for (std::size_t e = s.first(p); e < s.first(p + 1); ++e)
        to[p] += s.weight[e] * warmed_[static_cast<std::size_t>(s.node[e])];
    if (c.heating >= 0)
      next.column(static_cast<std::size_t>(c.heating))[p] = (to[p] - T[p]) / span.dt;
    if (c.heat_source >= 0) next.column(static_cast<std::size_t>(c.heat_source))[p] = 0;
  }
}

bool ImplicitStep::move_chunk(std::size_t k, const Response::Span& span, Response& response,
                              std::string& reason) {
  ChunkOfMatrices phi, T;
  equilibrium_->particles().deformation(*nodes_, k, span, response, phi);
  if (const auto fault = response.forces(span, phi, particles_.kind(k).next, span.at, T)) {
    if (reason.empty()) reason = describe_fault(*span.set, k, solids_->materials[k], *fault);
    return false;
  }
  read_nodes(k, span);
  warm(k, span, response.heating());
  return true;
}

// Rigid particles keep all but their place, their velocity and their temperature; without
// mechanics these too.
void ImplicitStep::keep_rigid(std::size_t k, double dt) {
  AllParticles::Kind& kind = particles_.kind(k);
  const Columns& c = (*carried_)[k].columns;
  for (const std::size_t a : (*kinds_)[k].advanced_columns())
    std::copy_n(kind.now.column(a), kind.now.size(), kind.next.column(a));
  const auto v = write_columns<3>(kind.next, c.velocity),
             way = write_columns<3>(kind.next, c.displacement);
  for (std::size_t p = 0; p < kind.now.size(); ++p)
    for (int d = 0; d < 3 && !solids_->implicit->mechanics; ++d)
      kind.next.coordinate(d)[p] = kind.now.coordinate(d)[p];
  for (std::size_t p = 0; p < kind.now.size() && solids_->implicit->mechanics; ++p)
    for (int d = 0; d < 3; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      kind.next.coordinate(d)[p] = kind.now.coordinate(d)[p] + rigid_[k][p][d];
      if (stopped_[k]) v[axis][p] = rigid_[k][p][d] / dt;
      if (way[axis] != nullptr) way[axis][p] += rigid_[k][p][d];
    }
  for (std::size_t at = 0; at < kind.now.size(); at += chunk_size)
    warm(k,
         {&kind.now, at, static_cast<int>(std::min<std::size_t>(chunk_size, kind.now.size() - at)),
          0, dt},
         nullptr);
}

bool ImplicitStep::move_kind(const StageScope& scope, std::size_t k, std::string& reason) {
  double spacing = 1e300;
  for (int d = 0; d < 3; ++d)
    if (level_.active[static_cast<std::size_t>(d)]) spacing = std::min(spacing, level_.spacing[d]);
  Response response(*solids_, solids_->materials[k], (*carried_)[k], spacing, level_.active);
  const ParticleSet& now = particles_.kind(k).now;
  for (std::size_t at = 0; at < now.size(); at += chunk_size)
    if (!move_chunk(k,
                    {&now, at, static_cast<int>(std::min<std::size_t>(chunk_size, now.size() - at)),
                     scope.step.time, scope.step.dt},
                    response, reason))
      return false;
  return true;
}

Verdict ImplicitStep::to_particles(const StageScope& scope) {
  for (std::size_t k = 0; k < particles_.count(); ++k) {
    if (solids_->materials[k].rigid)
      keep_rigid(k, scope.step.dt);
    else if (!move_kind(scope, k, *scope.reason))
      return Verdict::reject;
  }
  find_rates(scope);
  for (const double rate : new_rates_)
    if (!std::isfinite(rate)) {
      *scope.reason = "what a particle holds after the step is no number";
      return Verdict::reject;
    }
  if (solids_->implicit->mechanics)
    book_step({parts(), nodes_.get(), equilibrium_.get(), &forces_before_, &forces_, scope.step.dt},
              *scope.sums);
  particles_.give_back(*scope.particles, *kinds_);
  return Verdict::good;
}

// The next step: no particle goes farther than it may, and as Newton's method went.
void ImplicitStep::find_rates(const StageScope& scope) {
  const ImplicitSettings& settings = *solids_->implicit;
  const std::size_t kinds = particles_.count();
  new_rates_.assign(rate_count(kinds), 0.0);
  double rate = 0;
  for (std::size_t k = 0; k < kinds; ++k) {
    const AllParticles::Kind& kind = particles_.kind(k);
    if (kind.now.empty()) continue;
    const Columns& c = (*carried_)[k].columns;
    const KindRates rates =
        rates_of(solids_->basis, transfer_grid(*solids_, level_, (*carried_)[k].half), kind.now,
                 kind.next, c, 0, kind.now.size());
    rates.to(std::span(new_rates_)
                 .subspan(1 + k * static_cast<std::size_t>(KindRates::count),
                          static_cast<std::size_t>(KindRates::count)));
    for (int d = 0; d < 3; ++d)
      if (level_.active[static_cast<std::size_t>(d)])
        rate = std::max(rate, std::max(std::fabs(rates.up[d]), std::fabs(rates.down[d])) /
                                  (most_cells * level_.spacing[d]));
  }
  double factor = 1;
  if (newton_.iterations <= settings.iterations_to_grow) factor = settings.grow;
  if (newton_.iterations >= settings.iterations_to_shrink) factor = settings.shrink;
  // A step that an output or the end of the run cut says nothing about the next.
  double length = scope.step.dt;
  const double before = scope.maxima->front().front();
  if (!retried_ && scope.dt_before > 0 && before > 0) {
    const double most = scene_->time.delt_max > 0 ? scene_->time.delt_max : 1e300;
    length = std::max(length, std::min(scene_->time.timestep_multiplier / before, most));
  }
  new_rates_[0] = std::max(rate, 1 / (factor * length / scene_->time.timestep_multiplier));
  new_rates_.insert(new_rates_.end(), outside_->counts().begin(), outside_->counts().end());
}

Verdict ImplicitStep::take_over(const StageScope& scope) {
  scope.journal->at_acceptance([this, cloud = scope.particles, maxima = scope.maxima,
                                ranks = scope.ranks, sums = scope.sums, events = scope.events,
                                end = scope.step.time + scope.step.dt] {
    retried_ = false;
    failures_ = 0;
    cloud->commit(end);
    book_leaving(*solids_, *carried_, {level_}, *cloud, *ranks, *sums, *events);
    std::vector<double>& all = maxima->front();
    all.resize(std::max(all.size(), new_rates_.size()));
    std::copy(new_rates_.begin(), new_rates_.end(), all.begin());
    cloud->relocate();
  });
  return Verdict::good;
}

}  // namespace sluice::mpm
