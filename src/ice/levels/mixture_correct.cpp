// Adding differences of fluxes to cells of several materials, as far as they can bear it.
//
//   M' = M + dM,  P' = P + dP,  W = V + dV,  V' = W/S with S = sum W,
//   E' = E + dE + p (W - V') + r M'/rho'
// with p the cell's pressure (what a volume given or taken at the face works) and r what makes the
// total energy right: by mass, as the dissipation of a step. A material of which nothing is left
// leaves its energy to r; one that V + dV would press tenfold keeps its density. With velocities of
// their own, dP_m what passes with the material, u the mixture's velocity, w_m = S_m/M_m and a cell
// that had the material,
//   w_m' = w_m + (dP_m - (u + w_m) dM_m)/max(M_m', M_m/2)
//   S_m' = M_m' (w_m' - sum M_n' w_n'/rho')
// what is left of a material takes no velocity from what went. One that comes new brings its own,
// up to its sound speed; traces move with the mixture (drag.hpp). The kinetic energy of slip is
// part of the total energy.
#include <cmath>

#include "ice/closure/drag.hpp"
#include "ice/closure/traces.hpp"
#include "ice/fluid/laws_in_box.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/levels/correction.hpp"
#include "ice/levels/mixture_transfer.hpp"

namespace sluice::ice {
namespace {

// threshold: volume fraction up to which what is left of a material is the round-off of volumes
//   around 1; unit: 1; test: MixtureCorrection.AMaterialThatIsGoneLeavesExactZeros
constexpr double round_off = 4e-16;

struct Part {
  double M, E, V;
  double S[3] = {0, 0, 0};  // slip; of a change, momentum that passes with the material
};

class MixtureCorrector {
 public:
  MixtureCorrector(const MixtureLayout& layout, const LawsInBox& laws)
      : layout_(layout),
        laws_(laws),
        fluids_(laws.fluids),
        components_(static_cast<int>(layout.components)),
        part_(layout.materials),
        change_(layout.materials),
        now_(layout.materials) {}

  double run(const StateViews& state, const ConservedChange& change, std::size_t n) {
    const IntVec3 cell = change.cells[n];
    read(state, change, n);
    if (const int m = sole_material(); m >= 0) {
      mixture_.E = part_[m].E;
      const double share = correct_gas(mixture_, total_, components_, false, fluids_[m]);
      part_[m].M = mixture_.rho;
      part_[m].E = mixture_.E;
      write(state, cell);
      return share;
    }
    find_pressure(cell);
    for (const double share : correction_shares) {
      if (!try_share(share)) continue;
      part_ = now_;
      for (std::size_t c = 0; c < layout_.components; ++c) mixture_.m[c] += share * total_.m[c];
      write(state, cell);
      return share;
    }
    return 0.0;
  }

 private:
  void read(const StateViews& state, const ConservedChange& change, std::size_t n) {
    const IntVec3 cell = change.cells[n];
    mixture_ = {};
    total_ = {};
    for (std::size_t m = 0; m < part_.size(); ++m) {
      part_[m] = {state[layout_.mass(m)](cell), state[layout_.energy(m)](cell),
                  state[layout_.volume(m)](cell)};
      change_[m] = {change.amount[layout_.mass(m)][n], change.amount[layout_.energy(m)][n],
                    change.amount[layout_.volume(m)][n]};
      for (std::size_t c = 0; c < layout_.components && layout_.multi_velocity; ++c) {
        part_[m].S[c] = state[layout_.slip(m, c)](cell);
        change_[m].S[c] = change.amount[layout_.material_momentum(m, c)][n];
      }
      mixture_.rho += part_[m].M;
      total_.rho += change_[m].M;
    }
    for (std::size_t c = 0; c < layout_.components; ++c) {
      mixture_.m[c] = state[layout_.momentum(c)](cell);
      total_.m[c] = change.amount[layout_.momentum(c)][n];
    }
    total_.E = change.amount[layout_.total_energy()][n];
  }
  void write(const StateViews& state, IntVec3 cell) const {
    for (std::size_t m = 0; m < part_.size(); ++m) {
      state[layout_.mass(m)](cell) = part_[m].M;
      state[layout_.energy(m)](cell) = part_[m].E;
      state[layout_.volume(m)](cell) = part_[m].V;
      for (std::size_t c = 0; c < layout_.components && layout_.multi_velocity; ++c)
        state[layout_.slip(m, c)](cell) = part_[m].S[c];
    }
    for (std::size_t c = 0; c < layout_.components; ++c)
      state[layout_.momentum(c)](cell) = mixture_.m[c];
  }

  // The one material that the cell holds before and after; -1: there are several.
  int sole_material() const {
    int sole = -1;
    for (std::size_t m = 0; m < part_.size(); ++m) {
      const Part& d = change_[m];
      if (part_[m].M == 0.0 && d.M == 0.0 && d.V == 0.0 && d.E == 0.0) continue;
      if (sole >= 0) return -1;
      sole = static_cast<int>(m);
    }
    return sole;
  }

  void find_pressure(IntVec3 cell) {
    double work = 0, volume = 0;
    Fluid room;
    for (std::size_t m = 0; m < part_.size(); ++m) {
      const Part& s = part_[m];
      if (s.M == 0.0) continue;
      work += s.V * laws_.at(cell, m, room).pressure(s.M / s.V, s.E / s.V);
      volume += s.V;
    }
    pressure_ = work / volume;
  }

  // Is what is left of a material nothing but the round-off of what came and went.
  bool nothing_left(std::size_t m) const {
    const Part &s = part_[m], &d = change_[m], &n = now_[m];
    if (n.M == 0.0) return true;
    if (!(std::fabs(n.V) <= round_off)) return false;
    const double density =
        std::fmax(s.V > 0.0 ? s.M / s.V : 0.0, d.V != 0.0 ? std::fabs(d.M / d.V) : 0.0);
    if (!(std::fabs(n.M) <= round_off * density)) return false;
    return std::fabs(n.V) < mixture::min_volume ||
           !(n.M > 0.0 && n.V > 0.0 && fluids_[m].admissible(n.M / n.V, n.E / n.V));
  }

  bool try_share(double share) {
    double rho = 0, volume = 0;
    int present = 0;
    bool moved = false;
    for (std::size_t m = 0; m < part_.size(); ++m) {
      const Part &s = part_[m], &d = change_[m];
      now_[m] = {s.M + share * d.M, s.E + share * d.E, s.V + share * d.V};
      const bool little = now_[m].M < min_kept_by_corrections * s.M;
      if (little && !nothing_left(m)) keep_state(m);
      keep_density(m);
      if (nothing_left(m))
        now_[m] = {};
      else if (!(now_[m].M > 0.0 && now_[m].V > 0.0))
        return false;
      else if (layout_.multi_velocity)
        bring_slip(m, share);
      moved = moved || now_[m].V != s.V;
      rho += now_[m].M;
      volume += now_[m].V;
      present += now_[m].M > 0.0;
    }
    if (!(rho >= min_kept_by_corrections * mixture_.rho && volume >= min_kept_by_corrections))
      return false;
    double gained = 0;
    for (std::size_t m = 0; m < part_.size(); ++m) {
      Part& now = now_[m];
      if (now.M == 0.0) {
        gained -= part_[m].E;
        continue;
      }
      const double whole = present == 1 ? 1.0 : moved ? now.V / volume : now.V;
      now.E += pressure_ * (now.V - whole);
      now.V = whole;
      keep_heat(m, rho);
      gained += now.E - part_[m].E;
    }
    const double rest = share * total_.E - kinetic_change(mixture_, total_, share, components_) -
                        slip_energy_gained(rho, present) - gained;
    for (std::size_t m = 0; m < part_.size(); ++m) {
      Part& now = now_[m];
      if (now.M == 0.0) continue;
      now.E += rest * (now.M / rho);
      if (!fluids_[m].admissible(now.M / now.V, now.E / now.V)) return false;
    }
    return true;
  }

  // Little that is left of a material is as all of it was: differences of what went say nothing of
  // its state.
  void keep_state(std::size_t m) {
    const double share = now_[m].M / part_[m].M;
    now_[m].V = share * part_[m].V;
    now_[m].E = share * part_[m].E;
  }

  // What came as vapour of a cavity and was crushed since has less volume than what goes back:
  // volumes follow masses where their difference would press a material tenfold.
  void keep_density(std::size_t m) {
    if (!(part_[m].M > 0.0 && now_[m].M > 0.0)) return;
    const double whole = part_[m].V * (now_[m].M / part_[m].M);
    if (now_[m].V < min_kept_by_corrections * whole) now_[m].V = whole;
  }

  // Of what is next to nothing the differences of what went, and the work on its volume, may leave
  // an energy that is none of its law's: it keeps its temperature, and r takes the rest.
  void keep_heat(std::size_t m, double rho) {
    Part& now = now_[m];
    const bool light = part_[m].M > 0.0 && now.M < mixture::next_to_nothing * rho;
    if (!light || fluids_[m].admissible(now.M / now.V, now.E / now.V)) return;
    const Part& s = part_[m];
    const double T = fluids_[m].temperature(s.M / s.V, s.E / s.V);
    now.E = now.V * fluids_[m].energy_from_temperature(now.M / now.V, T);
  }

  // Slip in the frame of the mixture before.
  void bring_slip(std::size_t m, double share) {
    const Part &s = part_[m], &d = change_[m];
    Part& now = now_[m];
    const double free = mixture::freedom(now.V), dM = share * d.M;
    const double sound = fluids_[m].sound_speed(now.M / now.V, pressure_);
    const double fastest = sound > 0.0 ? sound : 0.0;  // a gas in tension has none
    for (std::size_t c = 0; c < layout_.components; ++c) {
      const double u = mixture_.m[c] / mixture_.rho, w = s.M > 0.0 ? s.S[c] / s.M : 0.0;
      const double brought = share * d.S[c] - (u + w) * dM;
      double after = w + brought / larger(now.M, 0.5 * s.M);
      if (!(s.M > 0.0)) after = larger(-fastest, smaller(fastest, after));
      now.S[c] = free * now.M * after;
    }
  }

  // Slips of those present sum to zero; what their kinetic energy gains.
  double slip_energy_gained(double rho, int present) {
    double gained = 0;
    for (std::size_t c = 0; c < layout_.components && layout_.multi_velocity; ++c) {
      double sum = 0;
      for (const Part& now : now_) sum += now.S[c];
      for (std::size_t m = 0; m < part_.size(); ++m) {
        Part& now = now_[m];
        now.S[c] = now.M > 0.0 && present > 1 ? now.S[c] - now.M / rho * sum : 0.0;
        if (now.M > 0.0) gained += 0.5 * now.S[c] * now.S[c] / now.M;
        if (part_[m].M > 0.0) gained -= 0.5 * part_[m].S[c] * part_[m].S[c] / part_[m].M;
      }
    }
    return gained;
  }

  const MixtureLayout& layout_;
  const LawsInBox laws_;
  const std::vector<Fluid>& fluids_;  // what bounds the laws in all cells
  int components_;
  std::vector<Part> part_, change_, now_;
  GasCell mixture_{}, total_{};  // all materials together: density, momentum; their change
  double pressure_ = 0;
};

}  // namespace

void MixtureTransfer::correct(const StateViews& state, const ConservedChange& change,
                              std::span<double> share) const {
  LawsInBox laws{fluids_, mixed_.gas};
  if (!laws.all_plain()) laws.fractions = {state[mixed_.fraction]};
  MixtureCorrector corrector(layout_, laws);
  for (std::size_t n = 0; n < change.cells.size(); ++n) share[n] = corrector.run(state, change, n);
}

}  // namespace sluice::ice
