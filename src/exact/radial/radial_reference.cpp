#include "exact/radial/radial_reference.hpp"

#include <mutex>

#include "exact/base/symmetry.hpp"

namespace sluice::exact {
namespace {

// The run of a problem to a time, kept or new. Each starts from 0: going on from an earlier time
// would cut the steps differently, and the answer would depend on what was asked before.
std::shared_ptr<const RadialLagrangian> run_to(const RadialProblem& problem, double t) {
  constexpr std::size_t most_kept = 16;
  static std::mutex mutex;
  static std::vector<std::shared_ptr<const RadialLagrangian>> kept;
  const std::lock_guard lock(mutex);
  for (const auto& run : kept) {
    if (run->time() == t && run->problem() == problem) return run;
  }
  const auto run = std::make_shared<RadialLagrangian>(problem);
  run->advance_to(t);
  if (kept.size() == most_kept) kept.erase(kept.begin());
  kept.push_back(run);
  return run;
}

}  // namespace

RadialReference::RadialReference(RadialProblem problem, Vec3 origin, Vec3 axis)
    : problem_(std::move(problem)), origin_(origin), axis_(axis) {
  check(problem_);
}

State RadialReference::at(Vec3 x, double t) const {
  if (!run_ || run_->time() != t) run_ = run_to(problem_, t);
  State out;
  out.gamma = problem_.gamma;
  RadialState found{};
  if (problem_.dimension == 1) {
    found = run_->at(dot(x - origin_, axis_));
    out.velocity = axis_ * found.velocity;
  } else {
    const RadialPoint point = radial_point(x - origin_, problem_.dimension, axis_);
    found = run_->at(point.r);
    out.velocity = point.outward * found.velocity;
  }
  out.density = found.density;
  out.pressure = found.pressure;
  return out;
}

}  // namespace sluice::exact
