#include "peridynamics/points/columns.hpp"

#include <fmt/format.h>

namespace sluice::peridynamics {
namespace {

Label declare(const char* name, ValueType type, const char* unit, const char* definition) {
  return declare_label({name, type, Centring::particle, unit, definition});
}

PointLabels declare_all() {
  using enum ValueType;
  PointLabels l;
  l.volume = declare("p.volume", real, "m^3", "Volume of a particle.");
  l.mass = declare("p.mass", real, "kg", "Mass of a particle.");
  l.displacement =
      declare("p.displacement", vector, "m", "Way of a particle from where it was at the start.");
  l.velocity = declare("p.velocity", vector, "m/s", "Velocity of a particle.");
  l.acceleration = declare("p.acceleration", vector, "m/s^2", "Acceleration of a particle.");
  l.reference = declare("p.referencePlace", vector, "m", "Place of a particle at the start.");
  l.internal_force =
      declare("p.internalforce", vector, "N", "Force of its bonds on a peridynamic point.");
  l.horizon = declare("p.horizon", real, "m", "Horizon of a peridynamic point.");
  l.dilatation = declare("p.dilatation", real, "1",
                         "Dilatation theta of a peridynamic point, of its intact bonds.");
  l.neighbours =
      declare("p.neighborcount", real, "1", "Number of intact bonds of a peridynamic point.");
  l.energy_density = declare("p.strainEnergyDensity", real, "J/m^3",
                             "Elastic energy of a peridynamic point over its volume.");
  l.weighted_volume = declare("p.weightedVolume", real, "m^5",
                              "Sum over the bonds of a peridynamic point, as they were at the "
                              "start, of weight, squared length and volume.");
  l.damage = declare("p.damage", real, "1",
                     "Damage of a particle, 0 to 1; of a peridynamic point the share of its "
                     "family's volume to which it has lost its bonds.");
  l.stress = declare("p.stress", tensor, "Pa", "Cauchy stress of a particle, tension positive.");
  return l;
}

}  // namespace

const PointLabels& point_labels() {
  static const PointLabels labels = declare_all();
  return labels;
}

Label broken_label(int column) {
  return declare_label({fmt::format("p.brokenBonds{}", column + 1), ValueType::real,
                        Centring::particle, "1",
                        "Which bonds of a peridynamic point are broken: 52 bits as one number."});
}

Carried carried_by(const PeriScene& scene, int family) {
  const PointLabels& l = point_labels();
  Carried c;
  c.attributes = {{l.volume}, {l.mass}, {l.displacement, true}, {l.velocity, true}};
  if (!scene.breaks()) return c;
  c.columns.broken = 8;
  c.columns.broken_count = (family + bits_of_column - 1) / bits_of_column;
  for (int n = 0; n < c.columns.broken_count; ++n) c.attributes.push_back({broken_label(n), true});
  return c;
}

}  // namespace sluice::peridynamics
