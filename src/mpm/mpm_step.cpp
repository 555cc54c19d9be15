#include "mpm/mpm_step.hpp"

#include <fmt/format.h>

#include "mpm/implicit/implicit_step.hpp"
#include "mpm/levels/solid_levels.hpp"
#include "mpm/mpm.hpp"
#include "mpm/step/stable_step.hpp"

namespace sluice::mpm {

namespace {

// The share by which a step of h/(c + |v|) is to be multiplied before the deck's multiplier is.
StepLimit stable_limit(const Scene& scene, const MpmScene& solids) {
  const double multiplier = scene.time.timestep_multiplier;
  const StableShare stable = stable_share(solids, scene.grid.levels.front().active);
  if (multiplier <= stable.share) return {1, "waves in particles"};
  return {stable.share / multiplier,
          fmt::format("waves in particles: {:g} of h/(c + |v|) is stable with {}", stable.share,
                      stable.reason)};
}

}  // namespace

MpmStep::MpmStep(const Mpm& mpm)
    : mpm_(&mpm), stable_(stable_limit(mpm.run_scene(), mpm.scene())) {}

const ReductionLayout& MpmStep::reductions() const {
  return mpm_->reductions();
}

// The step, as a table.
void MpmStep::declare_stages(StepShape& shape) const {
  const auto step = mpm_->make_step();
  const auto stage = [&](const char* name, Verdict (SolidLevels::*act)(const StageScope&)) {
    shape.stage(name, [step, act](const StageScope& scope) { return ((*step).*act)(scope); });
  };
  stage("bounds of the sums", &SolidLevels::begin);
  if (mpm_->scene().midpoint() && files_give_velocities(mpm_->scene()))
    stage("spins of the start", &SolidLevels::start_spins);
  stage("particles to grid", &SolidLevels::to_grid);
  stage("sums of images and ranks", &SolidLevels::share_sums);
  stage("nodes: contact, forces, contact, boundary", &SolidLevels::move_nodes);
  if (mpm_->scene().transfer == Transfer::xpic)
    stage("filtered velocities (XPIC)", &SolidLevels::filter_velocities);
  if (mpm_->scene().midpoint())
    stage("new velocities; to grid at the middle of the step", &SolidLevels::map_back);
  else if (mpm_->scene().maps_back())
    stage("particles move; velocities to grid (MUSL)", &SolidLevels::map_back);
  stage("grid to particles, deformation, stress", &SolidLevels::from_grid);
  shape.stage("energies of solids", judge_step);
  stage("take over", &SolidLevels::commit);
}

// dt = min over p, d of h_d/(c_p + |v_p,d|), times the deck's timestep_multiplier or the share that
// is stable, whichever is less.
StepLimit MpmStep::limit(const std::vector<double>& maxima) const {
  const double rate = maxima.empty() ? 0 : mpm_->maxima().of(maxima).front();
  if (!(rate > 0)) return {1e300, "nothing moves"};
  return {stable_.dt / rate, stable_.reason};
}

// The step, as a table.
void ImplicitMpmStep::declare_stages(StepShape& shape) const {
  const auto step = std::make_shared<ImplicitStep>(mpm().run_scene(), mpm().scene(),
                                                   mpm().carried(), mpm().particles()->kinds());
  const auto stage = [&](const char* name, Verdict (ImplicitStep::*act)(const StageScope&)) {
    shape.stage(name, [step, act](const StageScope& scope) { return ((*step).*act)(scope); });
  };
  stage("particles to nodes", &ImplicitStep::begin);
  stage("displacements of the nodes: Newton's method", &ImplicitStep::find_displacements);
  if (mpm().scene().implicit->conducts) stage("temperatures of the nodes", &ImplicitStep::conduct);
  stage("nodes to particles, deformation, stress", &ImplicitStep::to_particles);
  stage("take over", &ImplicitStep::take_over);
}

StepLimit ImplicitMpmStep::limit(const std::vector<double>& maxima) const {
  const double rate = maxima.empty() ? 0 : mpm().maxima().of(maxima).front();
  if (!(rate > 0)) return {1e300, "nothing moves"};
  return {1 / rate, "displacement of particles, iterations of Newton's method"};
}

}  // namespace sluice::mpm
