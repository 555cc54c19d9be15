// Pressure relaxation of one cell.
#include "ice/closure/equilibrate.hpp"

#include <cmath>

#include "framework/base/infinity.hpp"
#include "ice/closure/traces.hpp"

namespace sluice::ice::mixture {
namespace {

// threshold: volume fraction below which a material keeps its density where no pressure suits
//   all; unit: 1; test: none
constexpr double min_relaxed = 1e-8;
// threshold: smallest pressure in a cavity, relative to the largest constant pi of the stiffened
//   gases: below it the energy of the gas is round-off; unit: 1; test:
//   Equilibration.TheWeakerLiquidOpensUnderTension
constexpr double min_cavity_pressure = 1e-12;

}  // namespace

Equilibration::Linear Equilibration::linear_of(const Fluid& fluid) {
  Linear l;
  if (const auto stiff = eos::as_stiffened(fluid.law)) {
    const auto& [G, gamma, pinf, q] = *stiff;
    l = {true, G, G / gamma, gamma * pinf, pinf, q};
  } else {
    l.pi = -fluid.lowest_pressure();
  }
  return l;
}

Equilibration::Equilibration(const std::vector<Fluid>& fluids) : fluids_(fluids) {
  for (const Fluid& fluid : fluids) linear_.push_back(linear_of(fluid));
}

void Equilibration::set_law(int m, const Fluid& fluid) {
  fluids_[m] = fluid;
  linear_[m] = linear_of(fluid);
}

bool Equilibration::survey(const Cell& cell, Present& in, Result& result) const {
  for (int m = 0; m < materials(); ++m)
    if (cell.M[m] != 0.0) in.index[in.count++] = m;
  double softness = 0, weighted = 0;
  for (int n = 0; n < in.count; ++n) {
    const int m = in.index[n];
    const Linear& l = linear_[m];
    const Stiffness s = stiffness(m, cell.M[m], cell.V[m], cell.E[m]);
    if (!(cell.M[m] > 0.0 && cell.V[m] > 0.0 && s.modulus > 0.0 && s.modulus < infinity)) {
      result.failed = m;
      return false;
    }
    in.before[m] = s;
    const double soft = cell.V[m] / s.modulus;
    softness += soft;
    weighted += soft * s.pressure;
    in.linear = in.linear && l.is;
    in.ideal = in.ideal && l.is && l.gamma_pi == 0.0 && l.q == 0.0;
    in.stiffest = std::fmax(in.stiffest, l.pi);
    if (in.weakest < 0 || is_weaker(m, in.weakest, cell)) in.weakest = m;
    if (in.largest < 0 || cell.V[m] > cell.V[in.largest]) in.largest = m;
  }
  result.pressure = weighted / softness;
  // The mean has the round-off of the mixture's modulus, 1/softness.
  const double of_mixture = 1.0 / softness;
  bool same = true;
  for (int n = 0; n < in.count; ++n) {
    const Stiffness& s = in.before[in.index[n]];
    const double round_off = same_pressure * (s.modulus + of_mixture);
    same = same && std::fabs(s.pressure - result.pressure) <= round_off;
  }
  return !same;
}

// Which of two is the first to give way under tension; of alike ones the larger.
bool Equilibration::is_weaker(int m, int n, const Cell& cell) const {
  const double a = linear_[m].pi;
  const double b = linear_[n].pi;
  return a < b || (a == b && cell.V[m] > cell.V[n]);
}

bool Equilibration::leave_traces_out(const Cell& cell, Present& in) const {
  const int all = in.count;
  in.count = 0;
  for (int n = 0; n < all; ++n) {
    const int m = in.index[n];
    if (cell.V[m] < min_relaxed)
      in.volume -= cell.V[m];
    else
      in.index[in.count++] = m;
  }
  if (cell.V[in.weakest] < min_relaxed) in.weakest = -1;
  return in.count > 0 && in.count < all;
}

Equilibration::Stiffness Equilibration::stiffness(int m, double M, double V, double E) const {
  const Linear& l = linear_[m];
  const double inverse = 1.0 / V;
  if (l.is) {
    const double p = l.G * ((E - l.q * M) * inverse) - l.gamma_pi;
    return {p, (1.0 + l.G) * (p + l.pi)};
  }
  return std::visit(
      [rho = M * inverse, rho_e = E * inverse](const auto& law) -> Stiffness {
        const double p = law.pressure(rho, rho_e);
        return {p, eos::modulus_of_state(law, rho, rho_e, p)};
      },
      fluids_[m].law);
}

double Equilibration::modulus(int m, double rho, double rho_e, double p) const {
  if (linear_[m].is) return (1.0 + linear_[m].G) * (p + linear_[m].pi);
  return std::visit([&](const auto& law) { return eos::modulus_of_state(law, rho, rho_e, p); },
                    fluids_[m].law);
}

// All but `rest` go to pressure q; their changes of energy, summed.
double Equilibration::relax(const Cell& cell, const Present& in, double q, int rest) const {
  double volume = 0, energy = 0;
  for (int n = 0; n < in.count; ++n) {
    const int m = in.index[n];
    if (m == rest) continue;
    const Linear& l = linear_[m];
    const double now =
        l.is ? l.g * cell.V[m] + l.thermal(cell.M[m], cell.V[m], cell.E[m]) / (q + l.pi)
             : in.relaxed[m];
    const double change = -q * (now - cell.V[m]);
    cell.V[m] = now;
    cell.E[m] += change;
    volume += now;
    energy += change;
  }
  cell.V[rest] = in.volume - volume;
  return energy;
}

// The gas of a cavity (or the weakest liquid, which gives way as a gas does) holds the energy of
// pressure q in what the others leave; the heaviest of them pays.
void Equilibration::fill_cavity(const Cell& cell, const Present& in, double q) const {
  const double before = cell.E[in.weakest];
  const double others = relax(cell, in, q, in.weakest);
  const Linear& l = linear_[in.weakest];
  cell.E[in.weakest] = (q + l.gamma_pi) * cell.V[in.weakest] / l.G + l.q * cell.M[in.weakest];
  int heaviest = -1;
  for (int n = 0; n < in.count; ++n) {
    const int m = in.index[n];
    if (m != in.weakest && (heaviest < 0 || cell.M[m] > cell.M[heaviest])) heaviest = m;
  }
  cell.E[heaviest] -= others + (cell.E[in.weakest] - before);
}

// Of what is next to nothing the differences of large fluxes may leave an energy that is none of
// its law's, and the heaviest pays for another: a linear law takes that of its least pressure, any
// other the pressure and the temperature of the heaviest. False: nothing was mended.
bool Equilibration::mend(const Cell& cell) const {
  int heaviest = 0;
  double stiffest = 0;
  for (int m = 0; m < materials(); ++m) {
    if (cell.M[m] > cell.M[heaviest]) heaviest = m;
    if (cell.M[m] != 0.0) stiffest = std::fmax(stiffest, linear_[m].pi);
  }
  if (!(cell.M[heaviest] > 0.0 && cell.V[heaviest] > 0.0)) return false;
  const double p =
      stiffness(heaviest, cell.M[heaviest], cell.V[heaviest], cell.E[heaviest]).pressure;
  const double least = min_cavity_pressure * std::fmax(stiffest, p);
  if (!(least > 0.0 && least < infinity)) return false;
  bool mended = false;
  for (int m = 0; m < materials(); ++m) {
    const Linear& l = linear_[m];
    const double M = cell.M[m], V = cell.V[m];
    if (!(M > 0.0 && V > 0.0 && M < next_to_nothing * cell.M[heaviest])) continue;
    const Stiffness now = stiffness(m, M, V, cell.E[m]);
    if (l.is ? now.pressure + l.pi > 0.0 : now.modulus > 0.0 && now.modulus < infinity) continue;
    double E;
    if (l.is) {
      E = (least - l.pi + l.gamma_pi) * V / l.G + l.q * M;
    } else {
      const double T = fluid(heaviest).temperature(cell.M[heaviest] / cell.V[heaviest],
                                                   cell.E[heaviest] / cell.V[heaviest]);
      const double rho = fluid(m).density(p, T);
      if (!(rho > 0.0)) continue;  // no such state
      cell.V[m] = M / rho;
      E = cell.V[m] * fluid(m).energy_from_temperature(rho, T);
    }
    cell.E[heaviest] -= E - cell.E[m];
    cell.E[m] = E;
    mended = true;
  }
  return mended;
}

// The pressure that all go to, from their mean; false: there is none. Gas beside a liquid under
// tension keeps a least pressure, or its energy would be lost in round-off; so does a weak liquid
// above the least pressure that it bears, also where its energy above that is round-off already.
bool Equilibration::settle(const Cell& cell, Present& in, Result& result) const {
  double q = result.pressure, least = -infinity;
  if (in.weakest >= 0 && in.count > 1)
    if (const Linear& l = linear_[in.weakest]; l.is)
      least = min_cavity_pressure * in.stiffest - l.pi;
  const bool found = find_pressure(cell, in, q);
  result.is_cavitating = found && q < least;
  if (!found || (result.is_cavitating && !in.linear))
    result.is_cavitating = leaves_room(cell, in, least);
  result.pressure = result.is_cavitating ? least : q;
  return found || result.is_cavitating;
}

Equilibration::Result Equilibration::equilibrate(const Cell& cell) const {
  Present in;
  Result result;
  bool differ = survey(cell, in, result);
  if (result.failed >= 0 && mend(cell)) {
    in = {};
    result = {};
    differ = survey(cell, in, result);
  }
  if (differ) {
    const double mean = result.pressure;
    if (!settle(cell, in, result)) {
      result.pressure = mean;
      if (!leave_traces_out(cell, in) || !settle(cell, in, result)) {
        result.failed = in.largest;
        return result;
      }
    }
    if (result.is_cavitating)
      fill_cavity(cell, in, result.pressure);
    else
      cell.E[in.largest] -= relax(cell, in, result.pressure, in.largest);
  } else if (result.failed < 0) {
    double volume = 0;
    for (int n = 0; n < in.count; ++n)
      if (in.index[n] != in.largest) volume += cell.V[in.index[n]];
    cell.V[in.largest] = 1.0 - volume;
  }
  if (result.failed < 0) find_modulus(cell, in, result);
  return result;
}

Equilibration::Result Equilibration::look(const Cell& cell) const {
  Present in;
  Result result;
  survey(cell, in, result);
  if (result.failed < 0) find_modulus(cell, in, result);
  return result;
}

void Equilibration::find_modulus(const Cell& cell, const Present& in, Result& result) const {
  double compliance = 0;
  for (int n = 0; n < in.count; ++n) {
    const int m = in.index[n];
    const double K = modulus(m, cell.M[m] / cell.V[m], cell.E[m] / cell.V[m], result.pressure);
    if (!(K > 0.0 && cell.V[m] > 0.0)) result.failed = m;
    compliance += cell.V[m] / K;
  }
  result.modulus = 1.0 / compliance;
}

}  // namespace sluice::ice::mixture
