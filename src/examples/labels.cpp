#include "examples/labels.hpp"

#include "examples/burger.hpp"
#include "examples/linear_solve.hpp"
#include "examples/poisson.hpp"
#include "examples/wave.hpp"

namespace sluice::examples {

void declare_labels() {
  claim_poisson_labels();
  claim_wave_labels();
  claim_solver_test_labels();
  Burger::label();
}

}  // namespace sluice::examples
