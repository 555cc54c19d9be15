#include "mpm/mpm_outputs.hpp"

#include "mpm/histories.hpp"
#include "mpm/mpm.hpp"

namespace sluice::mpm {

double MpmOutputs::history_value(Label label, const Totals& totals) const {
  return history_of(label, totals, mpm_->history_sums());
}

Vec3 MpmOutputs::history_vector(Label label, const Totals& totals) const {
  return vector_history_of(label, totals, mpm_->history_sums());
}

}  // namespace sluice::mpm
