// Heat through planes of a step.
#include "framework/run/analysis/analysis_heat.hpp"

namespace sluice {

bool takes_heat(const AnalysisModule& m) {
  return m.name == "flatPlate_heatFlux";
}

Label total_heat_rate() {
  return declare_label({"total_heatRate", ValueType::real, Centring::reduction, "W",
                        "Heat conducted through the planes of flatPlate_heatFlux."});
}

// It is seen through one of the two sides across it; nothing is summed for the other.
void HeatThroughPlanes::add(int volume, const ControlVolume& plane) {
  for (const int side : {2 * plane.flat, 2 * plane.flat + 1})
    places_.push_back(slots_->heat(volume, side));
}

void HeatThroughPlanes::record(double dt, const std::vector<double>& sums) {
  double passed = 0;
  for (const int place : places_) passed += sums[place];
  rate_ = passed / dt;
}

}  // namespace sluice
