#include "framework/run/component/particle_method.hpp"

#include "framework/archive/particle_table.hpp"

namespace sluice {

std::size_t ParticleKind::columns() const {
  std::size_t n = 0;
  for (const ParticleAttribute& a : attributes) n += a.columns();
  return n;
}

std::vector<std::size_t> ParticleKind::advanced_columns() const {
  std::vector<std::size_t> all;
  std::size_t column = 0;
  for (const ParticleAttribute& a : attributes)
    for (int c = 0; c < a.columns(); ++c, ++column)
      if (a.advanced) all.push_back(column);
  return all;
}

const ParticleLabels& particle_labels() {
  static const ParticleLabels labels = {
      declare_label({particle_position_name, ValueType::vector, Centring::particle, "m",
                     "Position of a particle."}),
      declare_label({particle_id_name, ValueType::long_integer, Centring::particle, "1",
                     "Number of a particle, unique in its material."})};
  return labels;
}

}  // namespace sluice
