#include "mpm/step/step_outcome.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/lowest_text.hpp"
#include "framework/base/reduction.hpp"

namespace sluice::mpm {
namespace {

// The part of a body in a list of maxima.
std::span<double> rates_of_body(std::vector<double>& maxima, std::size_t body) {
  constexpr auto count = static_cast<std::size_t>(KindRates::count);
  return std::span(maxima).subspan(1 + body * count, count);
}

// What all report, in the order in which it is kept; a fault where some of it is no number.
std::vector<double> maxima_of(StepReport& all, std::span<const double> counts) {
  std::vector<double> maxima(rate_count(all.rates.size()));
  maxima.insert(maxima.end(), counts.begin(), counts.end());
  maxima[0] = all.rate;
  for (std::size_t k = 0; k < all.rates.size(); ++k) all.rates[k].to(rates_of_body(maxima, k));
  bool sound = true;
  for (const double m : maxima) sound &= std::isfinite(m);
  if (!sound && all.fault.empty())
    all.keep_fault(0, "what a particle holds after the step is no number");
  return maxima;
}

}  // namespace

void StepOutcome::include_velocities(int body, Vec3 up, Vec3 down) {
  const std::span<double> own = rates_of_body(rates, static_cast<std::size_t>(body));
  KindRates bounds = KindRates::from(own);
  for (int d = 0; d < 3; ++d) {
    bounds.up[d] = std::max(bounds.up[d], up[d]);
    bounds.down[d] = std::max(bounds.down[d], down[d]);
  }
  bounds.to(own);
}

void book_bodies(bool prescribed, bool midpoint, NodeBooks& books) {
  using Of = BodyEnergySums;
  for (BodyEnergySums& body : books.bodies) {
    if (prescribed) {
      body[Of::node_work].merge(body[Of::stored_before]);
      body[Of::node_work].subtract(body[Of::stored_after]);
      books.sums[StepSums::force_work].merge(body[Of::stored_after]);
      books.sums[StepSums::force_work].subtract(body[Of::stored_before]);
    }
    books.sums[StepSums::node_gain].merge(body[Of::node_gain]);
    if (midpoint) {
      books.sums[StepSums::beyond_nodes].merge(body[Of::kick_gain]);
      books.sums[StepSums::beyond_nodes].subtract(body[Of::node_gain]);
    }
    books.sums[StepSums::inner_gain].merge(body[Of::inner_gain]);
    books.sums[StepSums::open_gain].merge(body[Of::open_gain]);
    books.sums[StepSums::node_work].merge(body[Of::node_work]);
    books.sums[StepSums::load_work].merge(body[Of::load_work]);
    books.sums[StepSums::corner_work].merge(body[Of::corner_work]);
  }
}

Verdict conclude_step(const StageScope& scope, std::span<const double> counts, StepReport& all,
                      const NodeBooks& books, StepOutcome& outcome) {
  std::vector<double> maxima = maxima_of(all, counts);
  Reduction reduction;
  std::vector<Reduction::Maximum> slots;
  for (const double m : maxima) slots.push_back(reduction.add_maximum(m));
  const auto travel = reduction.add_maximum(all.travel);
  const auto left = reduction.add_any(all.left);
  const auto fault = reduction.add_any(!all.fault.empty());
  std::vector<Reduction::Sum> sums;
  for (const ExactSum& sum : books.sums) sums.push_back(reduction.add_sum(sum));
  for (const BodyEnergySums& of : books.bodies)
    for (const ExactSum& sum : of.sums) sums.push_back(reduction.add_sum(sum));
  scope.ranks->reduce(reduction);
  if (reduction.any(fault)) {
    *scope.reason = lowest_text(*scope.ranks, all.fault);
    return Verdict::reject;
  }
  for (std::size_t n = 0; n < maxima.size(); ++n) maxima[n] = reduction.maximum(slots[n]);
  outcome.rates = std::move(maxima);
  outcome.travel = reduction.maximum(travel);
  outcome.left = reduction.any(left);
  for (std::size_t s = 0; s < sums.size(); ++s) {
    const std::size_t to =
        s < StepSums::count ? s : StepSums::of_body(books.bodies.size(), 0) + (s - StepSums::count);
    (*scope.sums)[to] += reduction.sum(sums[s]).value();
  }
  return Verdict::good;
}

}  // namespace sluice::mpm
