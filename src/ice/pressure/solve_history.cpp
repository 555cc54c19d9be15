#include "ice/pressure/solve_history.hpp"

#include "ice/fluid/labels.hpp"

namespace sluice::ice::pressure {

std::optional<double> SolveHistory::value(Label label) const {
  const Labels& l = labels();
  if (label == l.pressure_passes) return passes;
  if (label == l.pressure_iterations) return iterations;
  if (label == l.pressure_residual) return residual;
  if (label == l.largest_volume_error) return volume_error;
  return {};
}

}  // namespace sluice::ice::pressure
