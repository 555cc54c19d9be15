#include "framework/run/component/component.hpp"

namespace sluice {

const BlockFacet& Component::blocks() const {
  static const BlockFacet one_kind;
  return one_kind;
}

const LevelFacet& Component::levels() const {
  static const LevelFacet one_level;
  return one_level;
}

const BudgetFacet& Component::budgets() const {
  static const BudgetFacet none;
  return none;
}

const OutputFacet& Component::outputs() const {
  static const OutputFacet none;
  return none;
}

}  // namespace sluice
