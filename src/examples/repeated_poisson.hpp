// poisson2 and poisson3: Laplace's equation, the sweep of poisson1 repeated within a step until its
// residual is below <maxresidual>. Inner nodes start at 1. poisson3 does it on levels.
//
// A step of several stages: what is repeated is declared once (declare_stages), and the run loop
// fills ghost nodes between the sweeps and asks after each whether it was the last.
//
// On levels each node is swept on the finest one that owns it; beyond a finer level its neighbours
// lie between nodes of the coarser one. Nodes below it take its values at the end of each step, so
// that the levels agree after several steps: Schwarz's alternating method.
//
// Limits: where levels meet those of NodeTransfer; values of Phi as for poisson1; levels as the
// deck's <Grid> has them, in lockstep. A run ends with a message where 100 n^2 sweeps on n cells do
// not reach the residual.
// H. A. Schwarz, Vierteljahrsschrift Naturf. Ges. Zuerich 15 (1870) 272-286.
#pragma once
#include <memory>

#include "examples/node_transfer.hpp"
#include "examples/poisson.hpp"

namespace sluice::examples {

class RepeatedPoisson : public Poisson {
 public:
  using Poisson::Poisson;

  void initialise(Warehouse& state) const override;
  void declare_stages(StepShape& shape) const override;
  const TransferOperators& transfer() const override { return transfer_; }

 private:
  NodeTransfer transfer_;
};

std::unique_ptr<Component> make_repeated_poisson(const Deck& deck, const Scene& scene,
                                                 std::vector<Fault>& faults);
std::unique_ptr<Component> make_poisson_on_levels(const Deck& deck, const Scene& scene,
                                                  std::vector<Fault>& faults);

}  // namespace sluice::examples
