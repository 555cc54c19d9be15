// Wall time of the stages of steps on this rank, by their names.
#pragma once
#include <chrono>
#include <string>
#include <vector>

#include "framework/run/component/run_report.hpp"

namespace sluice {

class StageCosts {
 public:
  // The place of a stage; stages of one name, such as in passes of an iteration, share it.
  std::size_t place_of(const std::string& name);
  // What act() gives; its time counts for the stage at a place.
  template <class Act>
  auto measure(std::size_t place, Act&& act) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const auto result = act();
    costs_[place].seconds += std::chrono::duration<double>(Clock::now() - start).count();
    return result;
  }
  // In the order in which a step has them first.
  const std::vector<StageCost>& all() const { return costs_; }

 private:
  std::vector<StageCost> costs_;
};

}  // namespace sluice
