// All runs of some hard cases, several at once.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "app/process/run_journal.hpp"
#include "app/stability/stability_map.hpp"

namespace sluice {

// Called after each run, by one thread at a time.
using TellRun = std::function<void(std::size_t done, std::size_t all, const CaseMap& map,
                                   const StabilityResult& result)>;

// Runs every point of every case, `jobs` at a time, but those that the journal has. The result does
// not depend on their number. The first error that a run throws is thrown again when the others at
// work have ended.
std::vector<CaseMap> run_cases(const std::vector<StabilityCase>& cases,
                               const StabilityRunner& runner, int jobs, RunJournal& journal,
                               const TellRun& tell);

}  // namespace sluice
