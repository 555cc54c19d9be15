#include "mpm/histories.hpp"

#include <stdexcept>

namespace sluice::mpm {
namespace {

struct Histories {
  Label mass, kinetic, strain, momentum;
};

const Histories& histories() {
  const auto declare = [](const char* name, ValueType type, const char* unit,
                          const char* definition) {
    return declare_label({name, type, Centring::reduction, unit, definition});
  };
  static const Histories h = {
      declare("TotalMass", ValueType::real, "kg", "Mass in the domain."),
      declare("KineticEnergy", ValueType::real, "J", "Kinetic energy in the domain."),
      declare("StrainEnergy", ValueType::real, "J",
              "Work that deforming the solids has taken: stored, and turned into heat."),
      declare("TotalMomentum", ValueType::vector, "kg m/s", "Momentum in the domain.")};
  return h;
}

}  // namespace

void declare_histories() {
  histories();
}

double history_of(Label label, const Totals& totals) {
  const Histories& h = histories();
  if (label == h.mass) {
    ExactSum all;
    for (const ConservedTotal& m : totals.mass) all.merge(m.sum);
    return all.value();
  }
  if (label == h.kinetic) return totals.kinetic_energy.sum.value();
  if (label == h.strain) return totals.internal_energy.sum.value();
  throw std::logic_error("solids have no history " + label.name());
}

Vec3 vector_history_of(Label label, const Totals& totals) {
  if (label != histories().momentum)
    throw std::logic_error("solids have no history " + label.name());
  return {totals.momentum[0].sum.value(), totals.momentum[1].sum.value(),
          totals.momentum[2].sum.value()};
}

}  // namespace sluice::mpm
