// What peridynamic solids hold, what passes, and the histories that users save.
#include <stdexcept>

#include "framework/run/levels/particle_cloud.hpp"
#include "peridynamics/peridynamics.hpp"

namespace sluice::peridynamics {
namespace {

struct Histories {
  Label kinetic, strain, broken, drag, work, bonds, momentum, centre;
};

Label declare(const char* name, ValueType type, const char* unit, const char* definition) {
  return declare_label({name, type, Centring::reduction, unit, definition});
}

const Histories& own_histories() {
  using enum ValueType;
  static const Histories h = {
      declare("KineticEnergy", real, "J", "Kinetic energy in the domain."),
      declare("StrainEnergy", real, "J",
              "Work of deformation of the solids: stored, and converted into heat."),
      declare("BrokenEnergy", real, "J",
              "Elastic energy that peridynamic solids have lost where bonds broke."),
      declare("DampingEnergy", real, "J", "What the damping of peridynamic points has taken."),
      declare("ExternalWork", real, "J",
              "Work of gravity and loads on peridynamic points since the start."),
      declare("BrokenBonds", real, "1", "Number of bonds that have broken since the start."),
      declare("TotalMomentum", vector, "kg m/s", "Momentum in the domain."),
      declare("CenterOfMassPosition", vector, "kg m",
              "Sum of mass times position of the particles, not divided by the mass.")};
  return h;
}

enum Tracked { broken_energy, drag_energy, work_of_forces, broken_bonds };

}  // namespace

void declare_labels() {
  point_labels();
  broken_label(0);
  own_histories();
}

std::vector<std::string> histories(const DeckNode& /*root*/) {
  const Histories& h = own_histories();
  std::vector<std::string> names;
  for (const Label label :
       {h.kinetic, h.strain, h.broken, h.drag, h.work, h.bonds, h.momentum, h.centre})
    names.push_back(label.name());
  return names;
}

void Peridynamics::add_totals(const Warehouse& /*state*/, const LevelCoverage& /*coverage*/,
                              Totals& totals) const {
  totals.mass.resize(solids_.materials.size());
  totals.amounts.resize(3);
}

void Peridynamics::add_particle_totals(const ParticleCloud& /*cloud*/, Totals& totals) const {
  totals.mass.resize(solids_.materials.size());
  totals.amounts.resize(3);
  const BondedPoints& b = particles_.bonded();
  const Motion& now = b.present();
  for (int entry = 0; entry < b.points().size(); ++entry) {
    if (!b.points().is_own(entry)) continue;
    const std::size_t i = static_cast<std::size_t>(entry);
    const double m = b.mass(entry);
    double v2 = 0;
    totals.mass[static_cast<std::size_t>(b.points().material[i])].add(m);
    for (std::size_t d = 0; d < 3; ++d) {
      totals.momentum[d].add(m * now.v[d][i]);
      totals.amounts[d].add(m * (b.points().X[d][i] + now.u[d][i]));
      v2 += now.v[d][i] * now.v[d][i];
    }
    totals.kinetic_energy.add(0.5 * m * v2);
    totals.internal_energy.add(b.energy()[i] * b.points().V[i]);
  }
}

StepBalance Peridynamics::balance(const std::vector<double>& sums, const StepStart* /*start*/,
                                  double /*dt*/) const {
  StepBalance b;
  b.mass.assign(solids_.materials.size(), 0.0);
  for (int d = 0; d < 3; ++d) {
    b.momentum[d] = sums[static_cast<std::size_t>(StepSums::side_x + d)];
    b.momentum_of_forces[d] = sums[static_cast<std::size_t>(StepSums::force_x + d)];
  }
  b.energy_of_forces = sums[StepSums::work] - sums[StepSums::drag] - sums[StepSums::broken];
  return b;
}

std::vector<std::string> Peridynamics::tracked_names() const {
  return {"energy of broken bonds", "damping", "work of forces", "broken bonds"};
}

std::vector<double> Peridynamics::tracked_totals(const std::vector<double>& sums) const {
  return {sums[StepSums::broken], sums[StepSums::drag], sums[StepSums::work],
          sums[StepSums::bonds]};
}

std::vector<std::pair<std::string, double>> Peridynamics::budget(
    const Conservation& tallies) const {
  std::vector<std::pair<std::string, double>> all;
  if (solids_.breaks()) all.emplace_back("broken bonds", tallies.sources(broken_energy));
  if (solids_.damping > 0) all.emplace_back("damping", tallies.sources(drag_energy));
  return all;
}

double Peridynamics::history_value(Label label, const Totals& totals) const {
  const Histories& h = own_histories();
  const auto tracked = [&](Tracked n) {
    return totals.tracked_totals.empty() ? 0 : totals.tracked_totals[n];
  };
  if (label == h.kinetic) return totals.kinetic_energy.sum.value();
  if (label == h.strain) return totals.internal_energy.sum.value();
  if (label == h.broken) return tracked(broken_energy);
  if (label == h.drag) return tracked(drag_energy);
  if (label == h.work) return tracked(work_of_forces);
  if (label == h.bonds) return tracked(broken_bonds);
  throw std::logic_error("peridynamic solids have no history " + label.name());
}

Vec3 Peridynamics::history_vector(Label label, const Totals& totals) const {
  const Histories& h = own_histories();
  const auto of = [](const auto& t) {
    return Vec3{t[0].sum.value(), t[1].sum.value(), t[2].sum.value()};
  };
  if (label == h.momentum) return of(totals.momentum);
  if (label == h.centre) return of(totals.amounts);
  throw std::logic_error("peridynamic solids have no history " + label.name());
}

}  // namespace sluice::peridynamics
