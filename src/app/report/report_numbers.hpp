// The tables of a report, from what the run wrote of itself (run.json) and from the archive. Each
// is a piece of HTML, empty where there is nothing to tell.
#pragma once
#include <string>

#include "framework/archive/archive.hpp"
#include "framework/base/json.hpp"

namespace sluice {

std::string report_summary(const Archive& archive, const Json& run);
// Conserved quantities: start, now, through the boundary, from sources, drift.
std::string report_conservation(const Json& run);
// What steps had to correct, or that nothing was.
std::string report_events(const Json& run);
// Start, steps, outputs; effects and stages; levels; particles; messages between ranks.
std::string report_times(const Json& run);
// Each output and checkpoint with its bytes.
std::string report_outputs(const Archive& archive);

}  // namespace sluice
