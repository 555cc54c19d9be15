// Mass, momentum, energy and volume of a material in a cell: weights of averages.
#include "ice/outputs/quantity_list.hpp"
#include "ice/step/cell_sums.hpp"

namespace sluice::ice {
namespace {

// q = rho V, or rho u V component by component; `rho`: any amount per volume of the cell.
void declare_amount(QuantityList& q, VariableId rho, VariableId u, Label label, int material) {
  const int components = component_count(label.info().type);
  const VariableId amount = q.fresh(label, material);
  TaskBuilder t = q.task(label, material);
  const In density = t.read(rho), velocity = t.read(u);
  const Out out = t.write(amount);
  t.kernel([=](const Row& row) {
    const double volume = cell_volume(row);
    const int n = row.count();
    const double* __restrict r = row(density);
    for (int c = 0; c < components; ++c) {
      double* __restrict to = row(out, c);
      const double* __restrict v = components == 1 ? nullptr : row(velocity, c);
      for (int i = 0; i < n; ++i) to[i] = r[i] * volume * (v == nullptr ? 1.0 : v[i]);
    }
  });
}

}  // namespace

void declare_amounts(QuantityList& quantities) {
  const std::vector<DiagnosticQuantity> given = quantities.so_far();
  for (const DiagnosticQuantity& rho : given)
    for (const DiagnosticQuantity& u : given) {
      if (rho.label != labels().rho || u.label != labels().velocity || rho.material != u.material)
        continue;
      declare_amount(quantities, rho.variable, u.variable, labels().mass_of_cell, rho.material);
      declare_amount(quantities, rho.variable, u.variable, labels().momentum_of_cell, rho.material);
      const VariableId energy = quantities.list().old_state(labels().energy, rho.material, 1);
      declare_amount(quantities, energy, u.variable, labels().energy_of_cell, rho.material);
    }
  for (const DiagnosticQuantity& share : given)
    if (share.label == labels().volume_fraction)
      declare_amount(quantities, share.variable, share.variable, labels().volume_of_cell,
                     share.material);
}

}  // namespace sluice::ice
