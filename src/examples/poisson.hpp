// poisson1 and benchmark: Laplace's equation by one sweep of Jacobi's method a step, on nodes.
//
//   phi'(i) = sum over d of (phi(i - e_d) + phi(i + e_d)) / dx_d^2  /  sum over d of 2 / dx_d^2
//   residual = sum over inner nodes of (phi' - phi)^2                            (no units)
//
// With equal spacings that is the mean of the six neighbours (four in two dimensions). Nodes on the
// sides of the domain hold the values that the deck gives; inner nodes start at 0.
//
// Limits: one level; every side has one value of Phi or is periodic. An error is multiplied by
// about 1 - pi^2 / (2 n^2) a sweep on n cells: solving takes n^2 sweeps.
// D. M. Young, Iterative Solution of Large Linear Systems (1971), chapter 3.
#pragma once
#include <memory>

#include "examples/poisson_scene.hpp"
#include "framework/run/component/plain_component.hpp"

namespace sluice::examples {

struct PoissonLabels {
  Label phi, residual;
};
PoissonLabels claim_poisson_labels();

class Poisson : public PlainComponent {
 public:
  Poisson(const Scene& scene, const PoissonScene& settings);

  std::vector<SlotInfo> slots() const override;
  void initialise(Warehouse& state) const override;
  void fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                     const ThreadTeam& team) const override;
  void declare(TaskList& list, const StepVariant& variant) const override;
  StepLimit limit(const std::vector<double>& maxima) const override;
  double history_value(Label label, const Totals& totals) const override;

 protected:
  const PoissonScene& settings() const { return settings_; }

 private:
  PoissonScene settings_;
  PoissonLabels labels_ = claim_poisson_labels();
  SumGroup residual_ = add_sums(1);
};

std::unique_ptr<Component> make_poisson(const Deck& deck, const Scene& scene,
                                        std::vector<Fault>& faults);

}  // namespace sluice::examples
