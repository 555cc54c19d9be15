#include "mpm/outputs/mean_pressure.hpp"

namespace sluice::mpm {

DerivedAttribute mean_pressure_of(const Columns& columns, double reference) {
  const Label label =
      declare_label({"p.pressure", ValueType::real, Centring::particle, "Pa",
                     "Pressure of the particle: the reference pressure minus its mean stress."});
  return {label, [stress = columns.stress, reference](const ParticleSet& set,
                                                      std::vector<std::vector<double>>& to) {
            const auto s = read_columns<6>(set, stress);
            for (std::size_t p = 0; p < set.size(); ++p)
              to[0][p] = reference - (s[0][p] + s[1][p] + s[2][p]) / 3;
          }};
}

}  // namespace sluice::mpm
