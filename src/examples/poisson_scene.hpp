// <Poisson> and the values of phi, which has no unit, on the sides of the domain.
#pragma once
#include <array>
#include <vector>

#include "framework/deck/schema.hpp"
#include "framework/scene/scene.hpp"

namespace sluice::examples {

struct PoissonScene {
  double dt = 0;                       // <delt>, s
  double max_residual = 0;             // <maxresidual>, without unit
  std::array<double, 6> side_value{};  // of phi, by Side; periodic sides have none
};

void add_poisson_tags(Schema& schema);
PoissonScene read_poisson(const Deck& deck, const Scene& scene, std::vector<Fault>& faults);

}  // namespace sluice::examples
