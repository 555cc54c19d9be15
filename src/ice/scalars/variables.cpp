// Declaring the variables of scalars.
#include "ice/scalars/variables.hpp"

#include <algorithm>
#include <string>

#include "models/gases/mixed_gas.hpp"

namespace sluice::ice::scalars {

void declare_variables(TaskList& list, const SchemeOptions& o, SchemeVariables& v,
                       const Masses& masses) {
  ScalarVariables& s = v.scalars;
  std::vector<int> carriers;  // materials that carry any
  for (std::size_t n = 0; n < o.materials.scalars.size(); ++n) {
    const models::TransportedScalar& scalar = o.materials.scalars[n];
    if (!o.materials.mixture && scalar.material != o.materials.index) continue;
    const std::size_t m = o.materials.mixture ? scalar.material : 0;
    ScalarVariables::Each e;
    e.index = static_cast<int>(n);
    e.old = list.old_state(scalar.state(), scalar.material, 1);
    e.now = list.new_state(scalar.state(), scalar.material, 1);
    if (o.materials.mixed != nullptr && scalar.name == o.materials.mixed->fractions.front())
      s.fraction = e.now;
    if (o.materials.releases_heat && scalar.plain_name) {
      s.released_new = e.now;
      s.released = e.now = list.temporary("heat of mixing before this step's");
    }
    if (o.materials.releases_heat && scalar.of_species) {
      e.after_reactions = e.now;
      e.now = list.temporary(scalar.name + " before reactions");
    }
    e.mass = masses.old[m];
    e.mass_new = masses.now[m];
    if (o.materials.mixture) e.volume = masses.volume[m];
    auto found = std::find(carriers.begin(), carriers.end(), scalar.material);
    e.carrier = static_cast<int>(found - carriers.begin());
    if (found == carriers.end()) carriers.push_back(scalar.material);
    s.diffusive = s.diffusive || scalar.diffusivity > 0 || scalar.spreads_by_law;
    s.each.push_back(e);
  }
  if (s.each.empty()) return;
  const int count = static_cast<int>(s.each.size());
  s.materials = carriers;
  if (o.scheme.second_order)
    s.base = list.temporary("scalar bases", count * (offered + o.grid.axes.count));
  if (o.transport.spreads_species) s.diffusivity = list.temporary("diffusivity of species", count);
  if (o.scheme.second_order && s.diffusive)
    s.half = list.temporary("scalars at half the step", count);
  for (int a = 0; a < o.grid.axes.count; ++a) {
    const int d = o.grid.axes.direction[a];
    const std::string name = " of axis " + std::to_string(a);
    s.carrier[a] = o.materials.mixture ? list.temporary("mass with scalars" + name,
                                                        static_cast<int>(carriers.size()), d)
                                       : v.flux[a];
    s.face[a] = list.temporary("scalars on faces" + name, count, d);
    if (s.diffusive) s.spread[a] = list.temporary("scalar diffusion" + name, count, d);
  }
}

double diffusion_rate(const SchemeOptions& o, Vec3 spacing) {
  double most = 0;
  for (const models::TransportedScalar& s : o.materials.scalars)
    most = std::max(most, s.diffusivity);
  return diffusion_rate_of(most, o, spacing);
}

double diffusion_rate_of(double D, const SchemeOptions& o, Vec3 spacing) {
  double inverse_dx2 = 0;
  for (int a = 0; a < o.grid.axes.count; ++a) {
    const double dx = spacing[o.grid.axes.direction[a]];
    inverse_dx2 += 1.0 / (dx * dx);
  }
  // threshold: factor that makes of the 0.7 of explicit diffusion (budgets/step_limit.cpp) the
  //   0.5 that keeps scalars between the values around; unit: 1; test:
  //   ScalarFlow.SpreadingKeepsBoundsAndTheAmount
  constexpr double scalar_margin = 1.4;
  return scalar_margin * 2.0 * D * inverse_dx2;
}

}  // namespace sluice::ice::scalars
