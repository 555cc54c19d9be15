#include "mpm/declare_labels.hpp"

#include "mpm/histories.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/outputs/mean_pressure.hpp"
#include "mpm/outputs/node_fields.hpp"
#include "mpm/step/labels.hpp"

namespace sluice::mpm {

// Each function declares its labels when it is called first.
void declare_labels() {
  solid_labels();
  declare_history_labels();
  mean_pressure_of({}, 0);
  node_labels();
  declare_histories();
}

}  // namespace sluice::mpm
