#include "mpm/outputs/thermal_volume.hpp"

namespace sluice::mpm {

DerivedAttribute thermal_volume_of(const Columns& columns, const MaterialConstants& constants) {
  const Label label = declare_label(
      {"p.JThermal", ValueType::real, Centring::particle, "1",
       "Volume of a particle due to its temperature alone, divided by its reference volume."});
  return {label, [T = static_cast<std::size_t>(columns.temperature),
                  alpha = constants.thermal_expansion, room = constants.room_temperature](
                     const ParticleSet& set, std::vector<std::vector<double>>& to) {
            const double* of = set.column(T);
            for (std::size_t p = 0; p < set.size(); ++p) {
              const double stretch = 1 + alpha * (of[p] - room);
              to[0][p] = stretch * stretch * stretch;
            }
          }};
}

}  // namespace sluice::mpm
