// Pressure relaxation of one cell.
#include "ice/mixture/equilibrate.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "ice/mixture/runs.hpp"

namespace sluice::ice::mixture {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_iterations = 100;
constexpr double same_pressure = 4e-15;  // of the modulus: round-off of p = G (rho e) + F
constexpr double newton_ends = 1e-9;     // a step: what is left of it is round-off
constexpr double volume_tolerance = 4e-16, pressure_tolerance = 1e-15;
constexpr double trace = 1e-8;                   // volume fraction
constexpr double least_cavity_pressure = 1e-12;  // of the stiffest pi
constexpr double next_to_nothing = 1e-9;         // of the heaviest's mass

}  // namespace

Equilibration::Equilibration(const std::vector<Fluid>& fluids) : fluids_(fluids) {
  for (const Fluid& fluid : fluids) {
    Linear l;
    if (const auto* gas = std::get_if<eos::IdealGas>(&fluid.law)) {
      l = {true, gas->gamma - 1.0, 0.0, 0.0, 0.0};
    } else if (const auto* stiff = std::get_if<eos::StiffenedGas>(&fluid.law)) {
      l = {true, stiff->gamma - 1.0, stiff->gamma * stiff->pinf, stiff->pinf, stiff->q};
    } else {
      l.pi = -fluid.lowest_pressure();
    }
    linear_.push_back(l);
  }
}

Equilibration::Branch Equilibration::branch(int m, double q, double M, double V, double E,
                                            double start) const {
  const auto k = static_cast<std::size_t>(m);
  const Linear& l = linear_[k];
  if (!l.is) return general_branch(fluids_[k], q, M, V, E, start);
  const double inverse = 1.0 / (q + l.gamma_pi + l.G * q);
  const double volume = l.G * ((E - l.q * M) + q * V) * inverse;
  return {volume, (l.G * V - volume * (1.0 + l.G)) * inverse};
}

// p(M/V', (E - q (V' - V))/V') falls with V': dp/dV' = -K/V' at the solution.
Equilibration::Branch Equilibration::general_branch(const Fluid& fluid, double q, double M,
                                                    double V, double E, double start) const {
  return std::visit(
      [&](const auto& law) -> Branch {
        double low = M / law.highest_density(), high = infinity;
        double v = start > low ? start : V > low ? V : 2.0 * low;
        double slope = 0;
        for (int n = 0; n < most_iterations; ++n) {
          const double rho = M / v, rho_e = (E - q * (v - V)) / v;
          const double p = law.pressure(rho, rho_e);
          // dp/dv along the path on which energy goes as -q dv
          const double dp = -(rho * law.dp_drho(rho, rho_e) + law.dp_de(rho, rho_e) * q / rho) / v;
          const double h = p - q;
          if (h > 0.0)
            low = v;
          else
            high = v;
          double next = dp < 0.0 ? v - h / dp : std::numeric_limits<double>::quiet_NaN();
          const bool newton = next > low && next < high;
          if (!newton)
            next = high < infinity ? (low > 0.0 ? std::sqrt(low * high) : 0.5 * high) : 2.0 * v;
          slope = (1.0 + law.dp_de(rho, rho_e) * (v - V) / M) / dp;
          const double step = std::fabs(next - v);
          if (h != 0.0) v = next;
          if (h == 0.0 || step <= (newton ? newton_ends : 2e-16) * v) break;
        }
        return {v, slope};
      },
      fluid.law);
}

bool Equilibration::find_pressure(const Cell& cell, Present& in, double& q, int& iterations) const {
  if (in.ideal) {
    double energy = 0, volume = 0;
    for (int n = 0; n < in.count; ++n) {
      const int m = in.index[n];
      const double G = linear_[static_cast<std::size_t>(m)].G, g = G / (1.0 + G);
      energy += g * cell.E[m];
      volume += g * cell.V[m];
    }
    q = energy / (in.volume - volume);
    iterations = 1;
    return q > 0.0 && q < infinity;
  }
  double lowest = infinity;
  for (int n = 0; n < in.count; ++n)
    lowest = std::fmin(lowest, linear_[static_cast<std::size_t>(in.index[n])].pi);
  const double lo = -lowest;
  Branch branches[most_materials];
  double x = q - lo, below = 0.0, above = infinity;
  bool found = false;
  if (!in.linear)
    for (int n = 0; n < in.count; ++n) in.start[in.index[n]] = cell.V[in.index[n]];
  if (!(x > 0.0)) x = 1e-3 * (std::fabs(q) + std::fabs(lo)) + 1e-300;
  for (iterations = 1; iterations <= most_iterations; ++iterations) {
    double f = -in.volume, slope = 0.0;
    for (int n = 0; n < in.count; ++n) {
      const int m = in.index[n];
      branches[m] = branch(m, x + lo, cell.M[m], cell.V[m], cell.E[m], in.start[m]);
      f += branches[m].volume;
      slope += branches[m].slope;
    }
    if (!(std::fabs(f) < infinity)) return false;
    if (f > 0.0)
      below = x;
    else
      above = x;
    double next = x / (1.0 + f / (slope * x));
    const bool newton = next > below && next < above;
    if (!newton)
      next = above < infinity ? (below > 0.0 ? std::sqrt(below * above) : 1e-3 * above) : 8.0 * x;
    // Laws that are costly are spared the step that only confirms.
    const double last =
        newton && !in.linear ? newton_ends * x : pressure_tolerance * std::fabs(x + lo);
    found = std::fabs(f) < volume_tolerance || std::fabs(next - x) < last;
    if (found && (in.linear || !newton)) break;
    if (!in.linear)  // where the search of each goes on
      for (int n = 0; n < in.count; ++n) {
        const Branch& b = branches[in.index[n]];
        in.start[in.index[n]] = b.volume + b.slope * (next - x);
      }
    x = next;
    if (found) break;
  }
  q = x + lo;
  return found;
}

bool Equilibration::survey(const Cell& cell, Present& in, Result& result) const {
  for (int m = 0; m < materials(); ++m)
    if (cell.M[m] != 0.0) in.index[in.count++] = m;
  double softness = 0, weighted = 0;
  std::array<double, most_materials> p;
  for (int n = 0; n < in.count; ++n) {
    const int m = in.index[n];
    const Linear& l = linear_[static_cast<std::size_t>(m)];
    const double pm = pressure(m, cell.M[m], cell.V[m], cell.E[m]);
    const double K = modulus(m, cell.M[m] / cell.V[m], pm);
    if (!(cell.M[m] > 0.0 && cell.V[m] > 0.0 && K > 0.0 && K < infinity)) {
      result.failed = m;
      return false;
    }
    p[static_cast<std::size_t>(n)] = pm;
    softness += cell.V[m] / K;
    weighted += cell.V[m] / K * pm;
    in.linear = in.linear && l.is;
    in.ideal = in.ideal && l.is && l.gamma_pi == 0.0 && l.q == 0.0;
    in.stiffest = std::fmax(in.stiffest, l.pi);
    if (in.weakest < 0 || is_weaker(m, in.weakest, cell)) in.weakest = m;
    if (in.largest < 0 || cell.V[m] > cell.V[in.largest]) in.largest = m;
  }
  result.pressure = weighted / softness;
  // The mean has the round-off of the mixture's modulus, 1/softness.
  bool same = true;
  for (int n = 0; n < in.count; ++n) {
    const int m = in.index[n];
    const double K = modulus(m, cell.M[m] / cell.V[m], result.pressure);
    const double round_off = same_pressure * (K + 1.0 / softness);
    same = same && std::fabs(p[static_cast<std::size_t>(n)] - result.pressure) <= round_off;
  }
  return !same;
}

// Which of two is the first to give way under tension; of alike ones the larger.
bool Equilibration::is_weaker(int m, int n, const Cell& cell) const {
  const double a = linear_[static_cast<std::size_t>(m)].pi;
  const double b = linear_[static_cast<std::size_t>(n)].pi;
  return a < b || (a == b && cell.V[m] > cell.V[n]);
}

bool Equilibration::leave_traces_out(const Cell& cell, Present& in) const {
  const int all = in.count;
  in.count = 0;
  for (int n = 0; n < all; ++n) {
    const int m = in.index[n];
    if (cell.V[m] < trace)
      in.volume -= cell.V[m];
    else
      in.index[in.count++] = m;
  }
  if (cell.V[in.weakest] < trace) in.weakest = -1;
  return in.count > 0 && in.count < all;
}

double Equilibration::modulus(int m, double rho, double p) const {
  const auto k = static_cast<std::size_t>(m);
  return linear_[k].is ? (1.0 + linear_[k].G) * (p + linear_[k].pi)
                       : fluids_[k].bulk_modulus(rho, p);
}

// All but `rest` go to pressure q; their changes of energy, summed.
double Equilibration::relax(const Cell& cell, const Present& in, double q, int rest) const {
  double volume = 0, energy = 0;
  for (int n = 0; n < in.count; ++n) {
    const int m = in.index[n];
    if (m == rest) continue;
    const double now = branch(m, q, cell.M[m], cell.V[m], cell.E[m], in.start[m]).volume;
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
  const Linear& l = linear_[static_cast<std::size_t>(in.weakest)];
  cell.E[in.weakest] = (q + l.gamma_pi) * cell.V[in.weakest] / l.G + l.q * cell.M[in.weakest];
  int heaviest = -1;
  for (int n = 0; n < in.count; ++n) {
    const int m = in.index[n];
    if (m != in.weakest && (heaviest < 0 || cell.M[m] > cell.M[heaviest])) heaviest = m;
  }
  cell.E[heaviest] -= others + (cell.E[in.weakest] - before);
}

double Equilibration::pressure(int m, double M, double V, double E) const {
  const auto k = static_cast<std::size_t>(m);
  const Linear& l = linear_[k];
  const double rho = M / V, rho_e = E / V;
  return l.is ? l.G * (rho_e - l.q * rho) - l.gamma_pi : fluids_[k].pressure(rho, rho_e);
}

// Of what is next to nothing the differences of large fluxes may leave an energy that is none of
// its law's: it takes that of its least pressure, and the heaviest pays. False: nothing was mended.
bool Equilibration::mend(const Cell& cell) const {
  int heaviest = 0;
  double stiffest = 0;
  for (int m = 0; m < materials(); ++m) {
    if (cell.M[m] > cell.M[heaviest]) heaviest = m;
    if (cell.M[m] != 0.0) stiffest = std::fmax(stiffest, linear_[static_cast<std::size_t>(m)].pi);
  }
  if (!(cell.M[heaviest] > 0.0 && cell.V[heaviest] > 0.0)) return false;
  const double p = pressure(heaviest, cell.M[heaviest], cell.V[heaviest], cell.E[heaviest]);
  const double least = least_cavity_pressure * std::fmax(stiffest, p);
  if (!(least > 0.0 && least < infinity)) return false;
  bool mended = false;
  for (int m = 0; m < materials(); ++m) {
    const Linear& l = linear_[static_cast<std::size_t>(m)];
    const double M = cell.M[m], V = cell.V[m];
    const bool light = M > 0.0 && V > 0.0 && M < next_to_nothing * cell.M[heaviest];
    if (!light || !l.is || pressure(m, M, V, cell.E[m]) + l.pi > 0.0) continue;
    const double E = (least - l.pi + l.gamma_pi) * V / l.G + l.q * M;
    cell.E[heaviest] -= E - cell.E[m];
    cell.E[m] = E;
    mended = true;
  }
  return mended;
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
    double q = result.pressure;
    if (!find_pressure(cell, in, q, result.iterations)) {
      q = result.pressure;
      if (!leave_traces_out(cell, in) || !find_pressure(cell, in, q, result.iterations)) {
        result.failed = in.largest;
        return result;
      }
    }
    // Gas beside a liquid under tension keeps a least pressure, or its energy would be lost in
    // round-off; so does a weak liquid above the least pressure that it bears.
    const bool may_open = in.linear && in.weakest >= 0 && in.count > 1;
    const double least = may_open ? least_cavity_pressure * in.stiffest -
                                        linear_[static_cast<std::size_t>(in.weakest)].pi
                                  : -infinity;
    if (q < least) {
      q = least;
      result.torn = true;
      fill_cavity(cell, in, q);
    } else {
      cell.E[in.largest] -= relax(cell, in, q, in.largest);
    }
    result.pressure = q;
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
    const double K = modulus(m, cell.M[m] / cell.V[m], result.pressure);
    if (!(K > 0.0 && cell.V[m] > 0.0)) result.failed = m;
    compliance += cell.V[m] / K;
  }
  result.modulus = 1.0 / compliance;
}

}  // namespace sluice::ice::mixture
