#include "kinetics/hydrogen_burke.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "kinetics/atoms.hpp"
#include "kinetics/rate_units.hpp"

namespace sluice::kinetics {
namespace {

#include "kinetics/hydrogen_burke_fits.inc"

constexpr std::array<const char*, 3> element_names = {"H", "O", "N"};

struct SpeciesRow {
  const char* name;
  std::array<int, 3> atoms;
  double T_low, T_high;
  std::array<double, 7> low, high;  // below and above 1000 K
};

const std::array<SpeciesRow, 9> species_rows = {{
    {"H",
     {1, 0, 0},
     200,
     3500,
     {2.5, 7.05332819e-13, -1.99591964e-15, 2.30081632e-18, -9.27732332e-22, 25473.6599,
      -0.446682853},
     {2.50000001, -2.30842973e-11, 1.61561948e-14, -4.73515235e-18, 4.98197357e-22, 25473.6599,
      -0.446682914}},
    {"H2",
     {2, 0, 0},
     200,
     3500,
     {2.34433112, 0.00798052075, -1.9478151e-5, 2.01572094e-8, -7.37611761e-12, -917.935173,
      0.683010238},
     {3.3372792, -4.94024731e-5, 4.99456778e-7, -1.79566394e-10, 2.00255376e-14, -950.158922,
      -3.20502331}},
    {"O",
     {0, 1, 0},
     200,
     3500,
     {3.1682671, -0.00327931884, 6.64306396e-6, -6.12806624e-9, 2.11265971e-12, 29122.2592,
      2.05193346},
     {2.56942078, -8.59741137e-5, 4.19484589e-8, -1.00177799e-11, 1.22833691e-15, 29217.5791,
      4.78433864}},
    {"OH",
     {1, 1, 0},
     200,
     3500,
     {3.99201543, -0.00240131752, 4.61793841e-6, -3.88113333e-9, 1.3641147e-12, 3372.27356,
      -0.103925458},
     {3.09288767, 5.48429716e-4, 1.26505228e-7, -8.79461556e-11, 1.17412376e-14, 3615.85,
      4.4766961}},
    {"H2O",
     {2, 1, 0},
     200,
     3500,
     {4.19864056, -0.0020364341, 6.52040211e-6, -5.48797062e-9, 1.77197817e-12, -30293.7267,
      -0.849032208},
     {3.03399249, 0.00217691804, -1.64072518e-7, -9.7041987e-11, 1.68200992e-14, -30004.2971,
      4.9667701}},
    {"O2",
     {0, 2, 0},
     200,
     3500,
     {3.78245636, -0.00299673416, 9.84730201e-6, -9.68129509e-9, 3.24372837e-12, -1063.94356,
      3.65767573},
     {3.28253784, 0.00148308754, -7.57966669e-7, 2.09470555e-10, -2.16717794e-14, -1088.45772,
      5.45323129}},
    {"HO2",
     {1, 2, 0},
     200,
     5000,
     {4.30179807, -0.00474912097, 2.11582905e-5, -2.42763914e-8, 9.29225225e-12, 264.018485,
      3.7166622},
     {4.17228741, 0.00188117627, -3.46277286e-7, 1.94657549e-11, 1.76256905e-16, 31.0206839,
      2.95767672}},
    {"H2O2",
     {2, 2, 0},
     200,
     3500,
     {4.27611269, -5.42822417e-4, 1.67335701e-5, -2.15770813e-8, 8.62454363e-12, -17702.5821,
      3.43505074},
     {4.16500285, 0.00490831694, -1.90139225e-6, 3.71185986e-10, -2.87908305e-14, -17861.7877,
      2.91615662}},
    {"N2",
     {0, 0, 2},
     300,
     5000,
     {3.298677, 0.0014082404, -3.963222e-6, 5.641515e-9, -2.444854e-12, -1020.8999, 3.950372},
     {2.92664, 0.0014879768, -5.68476e-7, 1.0097038e-10, -6.753351e-15, -922.7977, 5.980528}},
}};

// Units of the table: cm, mol, s, cal. A falloff reaction has Troe's form with one constant centre.
struct ReactionRow {
  const char* equation;
  Arrhenius rate;
  Arrhenius low = {};
  double centre = 0;
  std::vector<std::pair<const char*, double>> efficiency = {};  // 1 of the others
};

const std::array<ReactionRow, 23>& reaction_rows() {
  static const std::array<ReactionRow, 23> rows = {{
      {"H + O2 <=> O + OH", {1.04e14, 0, 15286}},
      {"O + H2 <=> H + OH", {3.818e12, 0, 7948}},
      {"O + H2 <=> H + OH", {8.792e14, 0, 19170}},
      {"H2 + OH <=> H2O + H", {2.16e8, 1.51, 3430}},
      {"OH + OH <=> O + H2O", {33400, 2.42, -1930}},
      {"H2 + M <=> H + H + M", {4.577e19, -1.4, 104380}, {}, 0, {{"H2", 2.5}, {"H2O", 12}}},
      {"O + O + M <=> O2 + M", {6.165e15, -0.5, 0}, {}, 0, {{"H2", 2.5}, {"H2O", 12}}},
      {"O + H + M <=> OH + M", {4.714e18, -1, 0}, {}, 0, {{"H2", 2.5}, {"H2O", 12}}},
      {"H2O + M <=> H + OH + M",
       {6.064e27, -3.322, 120790},
       {},
       0,
       {{"H2", 3}, {"N2", 2}, {"O2", 1.5}, {"H2O", 0}}},
      {"H2O + H2O <=> H + OH + H2O", {1.006e26, -2.44, 120180}},
      {"H + O2 (+ M) <=> HO2 (+ M)",
       {4.65084e12, 0.44, 0},
       {6.366e20, -1.72, 524.8},
       0.5,
       {{"H2", 2}, {"O2", 0.78}, {"H2O", 14}}},
      {"HO2 + H <=> H2 + O2", {2.75e6, 2.09, -1451}},
      {"HO2 + H <=> OH + OH", {7.079e13, 0, 295}},
      {"HO2 + O <=> O2 + OH", {2.85e10, 1, -723.93}},
      {"HO2 + OH <=> H2O + O2", {2.89e13, 0, -497}},
      {"HO2 + HO2 <=> H2O2 + O2", {4.2e14, 0, 11982}},
      {"HO2 + HO2 <=> H2O2 + O2", {1.3e11, 0, -1629.3}},
      {"H2O2 (+ M) <=> OH + OH (+ M)",
       {2e12, 0.9, 48749},
       {2.49e24, -2.3, 48749},
       0.43,
       {{"N2", 1.5}, {"H2", 3.7}, {"O2", 1.2}, {"H2O", 7.5}, {"H2O2", 7.7}}},
      {"H2O2 + H <=> H2O + OH", {2.41e13, 0, 3970}},
      {"H2O2 + H <=> HO2 + H2", {4.82e13, 0, 7950}},
      {"H2O2 + O <=> OH + HO2", {9.55e6, 2, 3970}},
      {"H2O2 + OH <=> HO2 + H2O", {1.74e12, 0, 318}},
      {"H2O2 + OH <=> HO2 + H2O", {7.59e13, 0, 7270}},
  }};
  return rows;
}

constexpr double always = 1e-30, never = 1e30;  // T*** and T* of a constant centre, K

Species species_of(const SpeciesRow& row, std::size_t k) {
  Species species;
  species.name = row.name;
  species.atoms.assign(row.atoms.begin(), row.atoms.end());
  for (std::size_t e = 0; e < element_names.size(); ++e)
    species.molar_mass += row.atoms[e] * *atomic_mass(element_names[e]);
  species.thermo = {row.T_low, 1000, row.T_high, row.low, row.high};
  species.viscosity = species_fits[2 * k];
  species.conductivity = species_fits[2 * k + 1];
  return species;
}

std::size_t row_of(const std::string& name) {
  const auto found = std::find_if(species_rows.begin(), species_rows.end(),
                                  [&](const SpeciesRow& row) { return name == row.name; });
  return found - species_rows.begin();
}

Arrhenius in_si(const Arrhenius& row, int order) {
  return {frequency_factor(row.A, order, 1e-6), row.b, row.E * calorie};
}

// What the equation says: "H + O2 (+ M) <=> HO2 (+ M)". The number of molecules on its left side.
int read_equation(const char* equation, Reaction& reaction) {
  reaction.equation = equation;
  std::istringstream words(reaction.equation);
  std::vector<Participant>* side = &reaction.reactants;
  int reactants = 0;
  for (std::string word; words >> word;) {
    if (word == "+") continue;
    if (word == "<=>") {
      side = &reaction.products;
    } else if (word == "M") {
      reaction.third_body = true;
    } else if (word == "(+") {
      reaction.falloff.emplace();
      words >> word;  // "M)"
    } else {
      const std::size_t k = row_of(word);
      if (!side->empty() && side->back().species == k)
        ++side->back().count;
      else
        side->push_back({k, 1});
      if (side == &reaction.reactants) ++reactants;
    }
  }
  return reactants;
}

Reaction reaction_of(const ReactionRow& row) {
  Reaction reaction;
  const int order = read_equation(row.equation, reaction);
  reaction.rate = in_si(row.rate, order + (reaction.third_body ? 1 : 0));
  if (reaction.falloff) {
    Falloff& falloff = *reaction.falloff;
    falloff.low = in_si(row.low, order + 1);
    falloff.troe = true;
    falloff.a = row.centre;
    falloff.T3 = always;
    falloff.T1 = never;
  }
  if (!reaction.third_body && !reaction.falloff) return reaction;
  reaction.efficiency.assign(species_rows.size(), 1.0);
  for (const auto& [name, value] : row.efficiency) reaction.efficiency[row_of(name)] = value;
  return reaction;
}

Mechanism assembled() {
  Mechanism mechanism;
  mechanism.name = "Burke2012";
  mechanism.elements.assign(element_names.begin(), element_names.end());
  const std::size_t count = species_rows.size();
  for (std::size_t k = 0; k < count; ++k)
    mechanism.species.push_back(species_of(species_rows[k], k));
  for (const ReactionRow& row : reaction_rows()) mechanism.reactions.push_back(reaction_of(row));
  mechanism.diffusion.resize(count * count);
  std::size_t pair = 0;
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t k = j; k < count; ++k, ++pair)
      mechanism.diffusion[j * count + k] = mechanism.diffusion[k * count + j] = pair_fits[pair];
  return mechanism;
}

}  // namespace

const Mechanism& burke_hydrogen() {
  static const Mechanism mechanism = assembled();
  return mechanism;
}

}  // namespace sluice::kinetics
