#include "framework/run/levels/step_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace sluice {
namespace {

// Rare: the lowest of the cells that ranks have found.
CellFault lowest_of_ranks(Communicator& ranks, bool found, const CellFault& lowest) {
  std::string mine;
  if (found) mine.assign(reinterpret_cast<const char*>(&lowest), sizeof lowest);
  bool first = true;
  CellFault lowest_of_all = lowest;
  for (const std::string& text : ranks.gather_to_all(mine)) {
    if (text.size() != sizeof(CellFault)) continue;
    CellFault f;
    std::copy(text.begin(), text.end(), reinterpret_cast<char*>(&f));
    if (first || before(f, lowest_of_all)) lowest_of_all = f;
    first = false;
  }
  return lowest_of_all;
}

}  // namespace

const StepAttempt& StepReduction::reduce(const Reductions& local, const RunControl* control) {
  CellFault lowest;
  for (const CellFault& f : local.faults())
    if (&f == &local.faults().front() || before(f, lowest)) lowest = f;
  result_.first_fault = lowest;
  result_.maxima.resize(local.maxima_count());
  result_.sums.resize(local.sum_count());
  reduction_.clear();
  const auto faults = reduction_.add_count(local.fault_count());
  RunControl::Question question{};
  if (control != nullptr) question = control->ask(reduction_);
  if (ranks_->size() == 1) {
    for (int m = 0; m < local.maxima_count(); ++m) result_.maxima[m] = local.maximum(m);
    for (int s = 0; s < local.sum_count(); ++s) result_.sums[s] = local.sum(s).value();
  } else {
    std::vector<Reduction::Maximum> maxima;
    std::vector<std::pair<int, Reduction::Sum>> sums;
    for (int m = 0; m < local.maxima_count(); ++m)
      maxima.push_back(reduction_.add_maximum(local.maximum(m)));
    for (int s = 0; s < local.sum_count(); ++s) {
      if (!layout_->is_of_stages(s))
        sums.emplace_back(s, reduction_.add_sum(local.sum(s)));
      else if (local.sum(s).value() != 0)
        throw std::logic_error("a sweep has added to a sum of stages");
    }
    ranks_->reduce(reduction_);
    for (std::size_t m = 0; m < maxima.size(); ++m)
      result_.maxima[m] = reduction_.maximum(maxima[m]);
    result_.sums.assign(result_.sums.size(), 0.0);
    for (const auto& [s, slot] : sums) result_.sums[s] = reduction_.sum(slot).value();
  }
  result_.faults = reduction_.count(faults);
  if (control != nullptr) result_.control = control->read(reduction_, question);
  if (result_.faults > 0 && ranks_->size() > 1)
    result_.first_fault = lowest_of_ranks(*ranks_, local.fault_count() > 0, lowest);
  return result_;
}

std::optional<UnsoundCell> first_unsound_cell(const LevelStates& states, Communicator& ranks) {
  const Warehouse& state = states.present();
  CellFault lowest;
  std::int64_t found = 0;
  for (const int slot : states.slots())
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      for (int c = 0; c < state.info(slot).components; ++c) {
        const RealView v = state.view(slot, c, b);
        for_each_cell(state.local_boxes()[b].cells, [&](IntVec3 cell) {
          if (std::isfinite(v(cell))) return;
          const CellFault f{cell, states.level().index, state.info(slot).material, slot, v(cell)};
          if (found == 0 || before(f, lowest)) lowest = f;
          ++found;
        });
      }
  Reduction all;
  const auto count = all.add_count(found);
  ranks.reduce(all);
  if (all.count(count) == 0) return std::nullopt;
  lowest = lowest_of_ranks(ranks, found > 0, lowest);
  return UnsoundCell{lowest, state.info(lowest.kind).label};
}

}  // namespace sluice
