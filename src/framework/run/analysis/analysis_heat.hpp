// flatPlate_heatFlux: heat that is conducted through rectangles along the axes.
//
//   total_heatRate    a history: W, positive along the axis, through all rectangles of the deck,
//                     mean over the step
// A rectangle is the surface of a flat control volume: what passes is what the scheme has passed,
// in every substep of every level, summed exactly.
#pragma once
#include <optional>
#include <vector>

#include "framework/field/label.hpp"
#include "framework/refine/volume_faces.hpp"

namespace sluice {

// Does a module take heat.
bool takes_heat(const AnalysisModule& module);
// The history, declared on the first call.
Label total_heat_rate();

class HeatThroughPlanes {
 public:
  // `slots`: where the sums of a step hold what volumes exchange; nothing: planes cannot be added.
  explicit HeatThroughPlanes(std::optional<VolumeSums> slots) : slots_(slots) {}

  // A rectangle that is a volume of the hierarchy, by its number there.
  void add(int volume, const ControlVolume& plane);
  bool any() const { return !places_.empty(); }
  // A step of length dt (s) was accepted, with these sums over all ranks.
  void record(double dt, const std::vector<double>& sums);
  double rate() const { return rate_; }  // W

 private:
  std::optional<VolumeSums> slots_;
  std::vector<int> places_;  // among the sums
  double rate_ = 0;
};

}  // namespace sluice
