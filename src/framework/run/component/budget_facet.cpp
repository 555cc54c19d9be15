#include "framework/run/component/budget_facet.hpp"

#include <algorithm>

namespace sluice {

// Nothing is conserved: the mass of "material" 0 stays 0.
void BudgetFacet::add_totals(const Warehouse& /*state*/, const LevelCoverage& /*coverage*/,
                             Totals& totals) const {
  totals.mass.resize(1);
}

StepBalance BudgetFacet::balance(const std::vector<double>& /*sums*/, const StepStart* /*start*/,
                                 double /*dt*/) const {
  StepBalance b;
  b.mass = {0.0};
  return b;
}

}  // namespace sluice
