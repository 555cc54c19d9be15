#include "framework/run/component/step_facet.hpp"

namespace sluice {

const ReductionLayout& StepFacet::reductions() const {
  static const ReductionLayout none;
  return none;
}

Label StepFacet::mask_label() const {
  return declare_label({"state.slope_mask", ValueType::real, Centring::cell, "1",
                        "1 where a repeated step uses slopes; not used by this component"});
}

std::string StepFacet::describe_fault(int /*kind*/) const {
  return "value (must be finite)";
}

}  // namespace sluice
