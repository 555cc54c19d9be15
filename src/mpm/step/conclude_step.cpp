// The end of a step of solids: what all threads and ranks agree upon.
#include <algorithm>
#include <cmath>

#include "framework/base/lowest_text.hpp"
#include "framework/base/reduction.hpp"
#include "mpm/step/thread_report.hpp"

namespace sluice::mpm {

void SolidStep::include_velocities(int body, Vec3 up, Vec3 down) {
  const auto own = std::span(new_rates_)
                       .subspan(1 + static_cast<std::size_t>(body * KindRates::count),
                                static_cast<std::size_t>(KindRates::count));
  KindRates rates = KindRates::from(own);
  for (int d = 0; d < 3; ++d) {
    rates.up[d] = std::max(rates.up[d], up[d]);
    rates.down[d] = std::max(rates.down[d], down[d]);
  }
  rates.to(own);
}

// The books of the run take the sums of all bodies. Where the deformation is prescribed, what it
// changes of energy is work from outside, done against the stress.
void SolidStep::book_bodies() {
  using Of = BodyEnergySums;
  for (BodyEnergySums& body : books_.bodies) {
    if (prescribed_ != nullptr) {
      body[Of::node_work].merge(body[Of::stored_before]);
      body[Of::node_work].subtract(body[Of::stored_after]);
      books_.sums[StepSums::force_work].merge(body[Of::stored_after]);
      books_.sums[StepSums::force_work].subtract(body[Of::stored_before]);
    }
    books_.sums[StepSums::node_gain].merge(body[Of::node_gain]);
    if (solids_->midpoint()) {
      books_.sums[StepSums::beyond_nodes].merge(body[Of::kick_gain]);
      books_.sums[StepSums::beyond_nodes].subtract(body[Of::node_gain]);
    }
    books_.sums[StepSums::inner_gain].merge(body[Of::inner_gain]);
    books_.sums[StepSums::node_work].merge(body[Of::node_work]);
    books_.sums[StepSums::load_work].merge(body[Of::load_work]);
    books_.sums[StepSums::corner_work].merge(body[Of::corner_work]);
  }
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
    all.books.merge(r.books);
    if (!r.fault.empty()) all.keep_fault(r.fault_id, r.fault);
  }
  if (cohesive_ != nullptr) {
    all.rate = std::max(all.rate, cohesive_->rate());
    all.travel = std::max(all.travel, cohesive_->travel());
    all.left |= cohesive_->any_left();
  }
  all.rate = std::max(all.rate, keep_resting(scope.step, all.rates));
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
  books_.merge(all.books);
  book_bodies();
  for (const ExactSum& sum : books_.sums) sums.push_back(reduction.add_sum(sum));
  for (const BodyEnergySums& of : books_.bodies)
    for (const ExactSum& sum : of.sums) sums.push_back(reduction.add_sum(sum));
  scope.ranks->reduce(reduction);
  if (reduction.any(fault)) {
    *scope.reason = lowest_text(*scope.ranks, all.fault);
    return Verdict::reject;
  }
  for (std::size_t n = 0; n < maxima.size(); ++n) maxima[n] = reduction.maximum(slots[n]);
  new_rates_ = std::move(maxima);
  travel_ = reduction.maximum(travel);
  left_ = reduction.any(left);
  for (std::size_t s = 0; s < sums.size(); ++s) {
    const std::size_t to =
        s < StepSums::count ? s : StepSums::of_body(bodies_.size(), 0) + (s - StepSums::count);
    (*scope.sums)[to] += reduction.sum(sums[s]).value();
  }
  return Verdict::good;
}

}  // namespace sluice::mpm
