#include "framework/run/component/output_facet.hpp"

#include <stdexcept>

namespace sluice {

double OutputFacet::history_value(Label label, const Totals& /*totals*/) const {
  throw std::logic_error("the component has no history " + label.name());
}

Vec3 OutputFacet::history_vector(Label label, const Totals& /*totals*/) const {
  throw std::logic_error("the component has no history " + label.name());
}

}  // namespace sluice
