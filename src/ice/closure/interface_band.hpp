// What counts as an interface between materials: fractions within this distance of 0 and 1 are
// those of cells without one, or with a trace.
#pragma once

namespace sluice::ice::mixture {

constexpr double interface_band = 0.01;

}  // namespace sluice::ice::mixture
