// What can be saved of fluid and solids.
#pragma once
#include "framework/run/component/output_facet.hpp"

namespace sluice::mpmice {

class MpmIce;

class MpmIceOutputs final : public OutputFacet {
 public:
  explicit MpmIceOutputs(const MpmIce& both) : both_(&both) {}

  void declare_diagnostics(TaskList& list, int level) const override;
  double history_value(Label label, const Totals& totals) const override;
  Vec3 history_vector(Label label, const Totals& totals) const override;
  std::vector<OutputSwitch> switches() const override;
  bool passes_switch(std::size_t n, const std::vector<double>& sums) const override;

 private:
  Totals fluid_totals(const Totals& all) const;

  const MpmIce* both_;
};

}  // namespace sluice::mpmice
