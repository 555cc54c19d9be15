// New intervals of outputs and checkpoints from a moment on that a run itself comes to.
#pragma once

namespace sluice {

struct OutputSwitch {
  double output_interval = 0, checkpoint_interval = 0;  // time, s
  int remaining_steps = 0;  // that the run takes from then on; 0: as many as it would
};

}  // namespace sluice
