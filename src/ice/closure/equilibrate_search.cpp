// Which pressure the materials of a cell end at: q with sum V_m'(q) = 1.
//
// Laws p = G (rho e) - gamma pi give V' in closed form, the others their response to pressure at a
// volume v about V'(q):
//   h = p(M/v, (E - q (v - V))/v) - q,   V'(q) = v - h/h_v,   dV'/dq = (1 + p_e (v - V)/M)/h_v.
// q and these volumes are sought together by Newton's iteration, in x = q + pi_min
//   x <- x/(1 + f/(f' x)),   f = sum V' - 1,
// which is exact for one soft material among stiff ones, from where the moduli of the cell say.
// Where that leads nowhere, q is sought in a bracket, with the geometric mean of the bracket where
// the step leaves it, and all V' at each q likewise: slow, but it ends.
#include <cmath>
#include <utility>

#include "framework/base/infinity.hpp"
#include "ice/closure/equilibrate.hpp"

namespace sluice::ice::mixture {
namespace {

constexpr int max_iterations = 100, max_together = 12;
// threshold: pressure, of the one sought, below which a step takes half of the decades in place
//   of half of the volume; unit: 1; test: EquilibrationOfVapour.GoesWhereTheLiquidClosesItsCavity
constexpr double thin = 0x1p-80;
// threshold: relative step of Newton's iteration after which the search ends: the remaining error
//   is its square, round-off; unit: 1; test: Equilibration.FindsOnePressureForAnyPair
constexpr double newton_ends = 1e-9;
// threshold: relative step of bisection after which the search ends: the round-off of a volume;
//   unit: 1; test: EquilibrationOfWater.EndsWhereAVolumeIsWithinAnUlp
constexpr double bisection_ends = 2e-16;
// threshold: difference between the sum of the volumes and the cell, relative to the cell, at which
//   the search ends: round-off; unit: 1; test:
//   Equilibration.LiquidsThatAreAboutToOpenFindTheirPressure
constexpr double volume_tolerance = 4e-16;
// threshold: relative step of the pressure at which the search ends: round-off; unit: 1; test:
//   none
constexpr double pressure_tolerance = 1e-15;
// threshold: error, relative to the modulus or the volume of the cell, above which the result is
//   not a solution; unit: 1; test: none
constexpr double largest_gap = 1e-10;
// coefficient: where the search for a pressure begins, of the pressures at hand; unit: 1
constexpr double first_share = 1e-3;
// coefficient: where it begins if these are 0; unit: Pa
constexpr double lowest_start = 1e-300;

using Cell = Equilibration::Cell;

// A law may fall again at densities far above its own, where it has no meaning: no step of a volume
// may leap there.
double not_below_half(double volume, double before) {
  return std::fmax(volume, 0.5 * before);
}

struct Response {
  double pressure, excess, slope;  // p, h (Pa), h_v
  double volume, dV_dq;            // of V'(q)
};

// Of material m to pressure q at volume v.
template <class Law>
Response response(const Law& law, int m, const Cell& cell, double q, double v) {
  const double M = cell.M[m], V = cell.V[m], E = cell.E[m];
  const double rho = M / v, rho_e = (E - q * (v - V)) / v;
  const double p = law.pressure(rho, rho_e), excess = p - q, dp_de = law.dp_de(rho, rho_e);
  const double slope = -(rho * law.dp_drho(rho, rho_e) + dp_de * q / rho) / v;
  return {p, excess, slope, v - excess / slope, (1.0 + dp_de * (v - V) / M) / slope};
}
Response response(const Fluid& fluid, int m, const Cell& cell, double q, double v) {
  return std::visit([&](const auto& law) { return response(law, m, cell, q, v); }, fluid.law);
}

// V'(q) in a bracket, from `start`: h falls with v, h_v = -K/v at the solution. Vapour of a cavity,
// whose pressure grows with its density alone, comes from far: each step takes half of the decades.
Response solve(const Fluid& fluid, int m, const Cell& cell, double q, double start) {
  return std::visit(
      [&](const auto& law) {
        const double V = cell.V[m];
        double low = cell.M[m] / law.highest_density(), high = infinity;
        double v = start > low ? start : V > low ? V : 2.0 * low;
        Response r{};
        for (int n = 0; n < max_iterations; ++n) {
          r = response(law, m, cell, q, v);
          (r.excess > 0.0 ? low : high) = v;
          const bool far = r.pressure > 0.0 && r.pressure < thin * q;
          double next = far ? v * std::sqrt(r.pressure / q) : not_below_half(r.volume, v);
          if (r.slope < 0.0 && next == v) break;  // what is left is below an ulp of the volume
          const bool newton = r.slope < 0.0 && next > low && next < high;
          if (!newton)
            next = high < infinity ? (low > 0.0 ? std::sqrt(low) * std::sqrt(high) : 0.5 * high)
                                   : 2.0 * v;
          const double step = std::fabs(next - v);
          if (r.excess != 0.0) v = next;
          if (r.excess == 0.0 || step <= (newton ? newton_ends : bisection_ends) * v) break;
        }
        r.volume = v;
        return r;
      },
      fluid.law);
}

// V'(q), from `start`; infinity where a law has none there, or its volume leaps.
double volume_at(const Fluid& fluid, int m, const Cell& cell, double q, double start) {
  const double v = solve(fluid, m, cell, q, start).volume;
  const Response r = response(fluid, m, cell, q, v);
  return std::fabs(r.excess) <= largest_gap * std::fabs(r.slope) * v ? v : infinity;
}

}  // namespace

// sum a/(x + delta) + sum of the volumes of others = room, in x = q - lo.
struct Equilibration::Balance {
  int linear = 0, others = 0;
  double a[max_materials], delta[max_materials];
  int other[max_materials];
  double room, lo;

  // Volumes of the linear laws without the room, and the slope.
  std::pair<double, double> at(double x) const {
    double f = -room, slope = 0.0;
    for (int n = 0; n < linear; ++n) {
      const double inverse = 1.0 / (x + delta[n]), volume = a[n] * inverse;
      f += volume;
      slope -= volume * inverse;
    }
    return {f, slope};
  }
  // The positive root of room x^2 + (room d - a_0 - a_1) x - a_0 d for two of them, d apart.
  double pair_balance() const {
    const int soft = delta[0] == 0.0 ? 0 : 1;
    const double d = delta[1 - soft], b = room * d - (a[0] + a[1]), c = a[soft] * d;
    const double root = std::sqrt(b * b + 4.0 * room * c);
    return b > 0.0 ? 2.0 * c / (b + root) : (root - b) / (2.0 * room);
  }
};

Equilibration::Balance Equilibration::balance(const Cell& cell, const Present& in) const {
  Balance b;
  double lowest = infinity;
  for (int n = 0; n < in.count; ++n) lowest = std::fmin(lowest, linear_[in.index[n]].pi);
  b.lo = -lowest;
  b.room = in.volume;
  for (int n = 0; n < in.count; ++n) {
    const int m = in.index[n];
    const Linear& l = linear_[m];
    if (!l.is) {
      b.other[b.others++] = m;
      continue;
    }
    b.a[b.linear] = l.thermal(cell.M[m], cell.V[m], cell.E[m]);
    b.delta[b.linear++] = l.pi - lowest;
    b.room -= l.g * cell.V[m];
  }
  return b;
}

bool Equilibration::find_pressure(const Cell& cell, Present& in, double& q) const {
  const Balance b = balance(cell, in);
  double x = q - b.lo;
  if (in.ideal) {
    double energy = 0;
    for (int n = 0; n < b.linear; ++n) energy += b.a[n];
    q = energy / b.room;
    return q > 0.0 && q < infinity;
  }
  if (b.linear == 2 && b.others == 0) x = b.pair_balance();
  if (!(x > 0.0 && x < infinity)) x = first_share * (std::fabs(q) + std::fabs(b.lo)) + lowest_start;
  const double start = x;
  bool found = b.others > 0 && search_together(cell, in, b, x);
  if (!found) {
    x = start;
    found = search_in_bracket(cell, in, b, x);
  }
  q = x + b.lo;
  return found;
}

bool Equilibration::leaves_room(const Cell& cell, Present& in, double q) const {
  const Balance b = balance(cell, in);
  if (!(q > b.lo)) return false;
  double f = b.at(q - b.lo).first, volume[max_materials];
  for (int n = 0; n < b.others; ++n) {
    const int m = b.other[n];
    f += volume[n] = volume_at(fluid(m), m, cell, q, cell.V[m]);
  }
  if (!(f < 0.0)) return false;
  for (int n = 0; n < b.others; ++n) in.relaxed[b.other[n]] = volume[n];
  return true;
}

bool Equilibration::search_together(const Cell& cell, Present& in, const Balance& b,
                                    double& x) const {
  double* v = in.relaxed;
  for (int n = 0; n < b.others; ++n) {  // where the moduli say, never beyond nothing
    const int m = b.other[n];
    const Stiffness& s = in.before[m];
    const double gap = s.pressure - (x + b.lo);
    v[m] = cell.V[m] * (s.modulus + std::fmax(gap, 0.0)) / (s.modulus - std::fmin(gap, 0.0));
  }
  Response responses[max_materials];
  for (int iteration = 0; iteration < max_together; ++iteration) {
    auto [f, slope] = b.at(x);
    for (int n = 0; n < b.others; ++n) {
      const int m = b.other[n];
      const Response& r = responses[n] = response(fluid(m), m, cell, x + b.lo, v[m]);
      if (!(r.slope < 0.0)) return false;
      f += r.volume;
      slope += r.dV_dq;
    }
    const double next = x / (1.0 + f / (slope * x));
    if (!(next > 0.0 && next < infinity && slope < 0.0)) return false;
    const double step = next - x;
    bool settled = std::fabs(step) <= newton_ends * x || std::fabs(f) < volume_tolerance;
    for (int n = 0; n < b.others; ++n) {
      const int m = b.other[n];
      const double volume = responses[n].volume + responses[n].dV_dq * step;
      settled = settled && std::fabs(volume - v[m]) <= newton_ends * v[m];
      v[m] = not_below_half(volume, v[m]);
    }
    x = next;
    if (settled) return true;
  }
  return false;
}

bool Equilibration::search_in_bracket(const Cell& cell, Present& in, const Balance& b,
                                      double& x) const {
  double below = 0.0, above = infinity;
  double highest = 0.0;  // of their pressures: above it only volumes that overfill the cell lead
  for (int n = 0; n < in.count; ++n)
    highest = std::fmax(highest, in.before[in.index[n]].pressure - b.lo);
  Response responses[max_materials];
  double start[max_materials];
  for (int n = 0; n < b.others; ++n) start[n] = cell.V[b.other[n]];
  bool found = false;
  for (int iteration = 0; iteration < max_iterations && !found; ++iteration) {
    auto [f, slope] = b.at(x);
    for (int n = 0; n < b.others; ++n) {
      const int m = b.other[n];
      const Response& r = responses[n] = solve(fluid(m), m, cell, x + b.lo, start[n]);
      f += r.volume;
      slope += r.dV_dq;
    }
    if (!(std::fabs(f) < infinity)) return false;
    found = std::fabs(f) < volume_tolerance;
    if (found) break;
    (f > 0.0 ? below : above) = x;
    double next = x / (1.0 + f / (slope * x));
    if (!(next > below && next < above)) {
      const double inside = below > 0.0 ? std::sqrt(below) * std::sqrt(above) : first_share * above;
      next = above < infinity ? inside : x < highest ? highest : 8.0 * x;
    }
    found = std::fabs(next - x) < pressure_tolerance * std::fabs(x + b.lo);
    for (int n = 0; n < b.others; ++n)  // where the search of each goes on
      start[n] = not_below_half(responses[n].volume + responses[n].dV_dq * (next - x),
                                responses[n].volume);
    x = next;
  }
  double gap = b.at(x).first;
  for (int n = 0; n < b.others; ++n) {
    const int m = b.other[n];
    gap += in.relaxed[m] = volume_at(fluid(m), m, cell, x + b.lo, start[n]);
  }
  return found && std::fabs(gap) <= largest_gap;
}

}  // namespace sluice::ice::mixture
