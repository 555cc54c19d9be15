#include "mpm/step/chunk.hpp"

#include <algorithm>

namespace sluice::mpm {

void StepReport::keep_fault(std::int64_t id, std::string text) {
  if (!fault.empty() && fault_id <= id) return;
  fault = std::move(text);
  fault_id = id;
}

void StepReport::merge(const StepReport& r) {
  rate = std::max(rate, r.rate);
  travel = std::max(travel, r.travel);
  left |= r.left;
  for (std::size_t k = 0; k < r.rates.size(); ++k) rates[k].add(r.rates[k]);
  books.merge(r.books);
  if (!r.fault.empty()) keep_fault(r.fault_id, r.fault);
}

}  // namespace sluice::mpm
