#include "mpm/histories.hpp"

#include <algorithm>
#include <stdexcept>

#include "mpm/step/step_sums.hpp"

namespace sluice::mpm {
namespace {

constexpr const char* side_words[] = {"xminus", "xplus", "yminus", "yplus", "zminus", "zplus"};

// Histories of one side of the domain.
struct SideHistories {
  Label force, traction, area, cell_area;
};

struct Histories {
  Label mass, kinetic, strain, all_strain, heat, volume, count;
  Label momentum, centre, velocity;
  Label reaction, torque, transmitted;
  std::array<SideHistories, 6> sides;
};

Label declare(const std::string& name, ValueType type, const char* unit,
              const std::string& definition) {
  return declare_label({name, type, Centring::reduction, unit, definition});
}

SideHistories declare_side(const std::string& side) {
  const std::string of = "the side " + side + " of the domain";
  return {declare("BndyForce_" + side, ValueType::vector, "N",
                  "Force of " + of + " on the solids, from their stresses."),
          declare("BndyTraction_" + side, ValueType::vector, "Pa",
                  "Force of " + of + " on the solids over the area of contact; 0 without contact."),
          declare("BndyContactArea_" + side, ValueType::real, "m^2",
                  "Area of contact of solids with " + of +
                      ": twice the volume of its nodes over "
                      "the width of a cell."),
          declare("BndyContactCellArea_" + side, ValueType::real, "m^2",
                  "Area of contact of solids with " + of +
                      ": twice the volume of its nodes over "
                      "the width of a cell.")};
}

Histories declare_all() {
  using enum ValueType;
  Histories h;
  h.mass = declare("TotalMass", real, "kg", "Mass in the domain.");
  h.kinetic = declare("KineticEnergy", real, "J", "Kinetic energy in the domain.");
  h.strain = declare("StrainEnergy", real, "J",
                     "Work of deformation of the solids: stored, and converted into heat.");
  h.all_strain = declare("AccStrainEnergy", real, "J",
                         "Work of deformation of the solids since the start: the same as "
                         "StrainEnergy, which is also counted from the start.");
  h.heat = declare("ThermalEnergy", real, "J",
                   "Sum of mass times specific heat times temperature of the particles.");
  h.volume = declare("TotalVolumeDeformed", real, "m^3", "Volume of all particles.");
  h.count = declare("particleCount", real, "1", "Number of particles.");
  h.momentum = declare("TotalMomentum", vector, "kg m/s", "Momentum in the domain.");
  h.centre = declare("CenterOfMassPosition", vector, "kg m",
                     "Sum of mass times position of the particles, not divided by the mass.");
  h.velocity = declare("CenterOfMassVelocity", vector, "m/s", "Momentum over mass.");
  h.reaction =
      declare("RigidReactionForce", vector, "N",
              "Force of the other solids on the masters of specified contacts, and of the fluid "
              "(minus that of the reference pressure) on rigid solids; mean over a step.");
  h.torque = declare("RigidReactionTorque", vector, "N m",
                     "Torque of the other solids on masters about the origin of their motion.");
  h.transmitted = declare("SumTransmittedForce", vector, "N", "The same as RigidReactionForce.");
  for (std::size_t s = 0; s < 6; ++s) h.sides[s] = declare_side(side_words[s]);
  return h;
}

const Histories& histories() {
  static const Histories h = declare_all();
  return h;
}

double sum_at(const Totals& totals, int place) {
  return totals.amounts[place].sum.value();
}
Vec3 vector_at(const Totals& totals, int place) {
  return {sum_at(totals, place), sum_at(totals, place + 1), sum_at(totals, place + 2)};
}

// Of the last step; before the first there is none.
Vec3 step_sum(const Totals& totals, StepSums::Index first) {
  Vec3 v;
  for (int d = 0; d < 3; ++d) {
    const std::size_t n = first + d;
    v[d] = n < totals.sweep_sums.size() ? totals.sweep_sums[n] : 0;
  }
  return v;
}

double total_mass(const Totals& totals) {
  ExactSum all;
  for (const ConservedTotal& m : totals.mass) all.merge(m.sum);
  return all.value();
}

Vec3 momentum_of(const Totals& totals) {
  return {totals.momentum[0].sum.value(), totals.momentum[1].sum.value(),
          totals.momentum[2].sum.value()};
}

}  // namespace

void declare_histories() {
  histories();
}

void need_sums(const Scene& scene, HistorySums& sums) {
  const Histories& h = histories();
  const auto saved = [&](Label label) {
    return std::any_of(scene.output.saves.begin(), scene.output.saves.end(),
                       [&](const SaveRequest& s) { return s.label == label.name(); });
  };
  if (saved(h.heat)) sums.need(HistorySum::heat);
  if (saved(h.volume)) sums.need(HistorySum::volume);
  if (saved(h.count)) sums.need(HistorySum::count);
  if (saved(h.centre)) sums.need(HistorySum::centre_of_mass);
  for (const Side side : all_sides) {
    const SideHistories& s = h.sides[index_of(side)];
    if (saved(s.force) || saved(s.traction)) sums.need(HistorySum::face_force, side);
    if (saved(s.traction) || saved(s.area) || saved(s.cell_area))
      sums.need(HistorySum::face_area, side);
  }
}

bool is_history(Label label) {
  const Histories& h = histories();
  for (const Label own : {h.mass, h.kinetic, h.strain, h.all_strain, h.heat, h.volume, h.count,
                          h.momentum, h.centre, h.velocity, h.reaction, h.torque, h.transmitted})
    if (label == own) return true;
  for (const SideHistories& s : h.sides)
    if (label == s.force || label == s.traction || label == s.area || label == s.cell_area)
      return true;
  return false;
}

double history_of(Label label, const Totals& totals, const HistorySums& sums) {
  const Histories& h = histories();
  if (label == h.mass) return total_mass(totals);
  if (label == h.kinetic) return totals.kinetic_energy.sum.value();
  if (label == h.strain || label == h.all_strain) return totals.internal_energy.sum.value();
  if (label == h.heat) return sum_at(totals, sums.place(HistorySum::heat));
  if (label == h.volume) return sum_at(totals, sums.place(HistorySum::volume));
  if (label == h.count) return sum_at(totals, sums.place(HistorySum::count));
  for (const Side side : all_sides) {
    const SideHistories& s = h.sides[index_of(side)];
    if (label == s.area || label == s.cell_area)
      return sum_at(totals, sums.place(HistorySum::face_area, side));
  }
  throw std::logic_error("solids have no history " + label.name());
}

Vec3 vector_history_of(Label label, const Totals& totals, const HistorySums& sums) {
  const Histories& h = histories();
  if (label == h.momentum) return momentum_of(totals);
  if (label == h.centre) return vector_at(totals, sums.place(HistorySum::centre_of_mass));
  if (label == h.velocity) {
    const double mass = total_mass(totals);
    return mass > 0 ? (1 / mass) * momentum_of(totals) : Vec3{};
  }
  if (label == h.reaction || label == h.transmitted) return step_sum(totals, StepSums::reaction_x);
  if (label == h.torque) return step_sum(totals, StepSums::torque_x);
  for (const Side side : all_sides) {
    const SideHistories& s = h.sides[index_of(side)];
    if (label != s.force && label != s.traction) continue;
    const Vec3 force = vector_at(totals, sums.place(HistorySum::face_force, side));
    if (label == s.force) return force;
    const double area = sum_at(totals, sums.place(HistorySum::face_area, side));
    return area > 0 ? (1 / area) * force : Vec3{};
  }
  throw std::logic_error("solids have no history " + label.name());
}

}  // namespace sluice::mpm
