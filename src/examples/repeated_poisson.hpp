// poisson2: Laplace's equation, the sweep of poisson1 repeated within a step until its residual is
// below <maxresidual>. Inner nodes start at 1.
//
// A step of several stages: what is done again and again is declared once (shape_step), and the run
// loop fills ghost nodes between the sweeps and asks after each whether it was the last.
//
// Limits: those of poisson1. A run ends with a message where 100 n^2 sweeps on n cells do not reach
// the residual: it lies below round-off.
#pragma once
#include <memory>

#include "examples/poisson.hpp"

namespace sluice::examples {

class RepeatedPoisson : public Poisson {
 public:
  using Poisson::Poisson;

  void initialise(Warehouse& state) const override;
  void shape_step(StepShape& shape) const override;
};

std::unique_ptr<Component> make_repeated_poisson(const Deck& deck, const Scene& scene,
                                                 std::vector<Fault>& faults);

}  // namespace sluice::examples
