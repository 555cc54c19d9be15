// The shares of the materials in what passes a face, step by step.
#include <algorithm>
#include <cmath>

#include "ice/mixture/face_donors.hpp"
#include "ice/mixture/runs.hpp"

namespace sluice::ice::mixture {
namespace {

constexpr double least_entry = 1e-16;    // of a cell's volume: what enters an empty cell
constexpr double least_rest = 1e-10;     // of a material's volume that may stay behind
constexpr double tiny = 1e-14;           // of a cell's volume: what leaves by one outlet alone
constexpr double least_fill = 0.5;       // of the volume behind it, for a front to move on
constexpr double trace = 1e-10;          // differences of smaller fractions are not trusted
constexpr double interface_band = 0.01;  // distance from 0 and 1 within which there is an interface

// Without a branch, so that rows vectorise.
inline bool both(bool a, bool b) {
  return (int{a} & int{b}) != 0;
}
inline bool either(bool a, bool b) {
  return (int{a} | int{b}) != 0;
}

// Compressive slope: the bound itself.
inline double sharp_slope(double dm, double dp, double B) {
  const double bound = smaller(B * std::fabs(dm), 2.0 * std::fabs(dp));
  return dm * dp > 0.0 ? std::copysign(bound, dm) : 0.0;
}

// One material around the faces: cells from the third below to the third above.
struct Material {
  int index = 0;
  const double* V[6];  // volume fraction of cells -3 .. 2
  const double* M[2];
  Around r, e;  // density and energy per own volume
  Pair energy_L, eps_L, scale, base_V, base_r, base_e;
  double *FV, *FM, *FE;
};

// N: how many materials take part; 0: any number.
template <int N, bool Second, bool Masked>
class FaceShares {
 public:
  FaceShares(const Row& row, const RemapFluxHandles& common, const MaterialHandles& handles,
             Out flux, const SchemeOptions& options, int axis, double l, std::uint64_t set)
      : row_(row),
        h_(handles),
        axis_(axis),
        n_(row.count()),
        l_(l),
        uf_(row(common.face_velocity)) {
    based_ = Second && options.axes.count > 1;
    iJ_ = cells(common.inverse_J);
    N_ = cells(common.courant);
    iN_ = cells(common.inverse_courant);
    J_ = cells(handles.lagrangian, 0);
    outlet_ = cells(handles.lagrangian, 2);
    if (Masked) mask_ = cells(common.mask);
    look_for_pure_cells();
    for_each_of(set, [&](int m) { bind(materials_[count_++], m, flux); });
  }

  void run() {
    for (int k = 0; k < count(); ++k) propose(materials_[k]);
    close_volumes();
    for (int k = 0; k < count(); ++k) keep_traces_together(materials_[k]);
    take_the_rest();
    for (int k = 0; k < count(); ++k) carry(materials_[k]);
  }

 private:
  static constexpr int most = N > 0 ? N : most_materials;
  static constexpr int rows_each = 20;

  int count() const { return N > 0 ? N : count_; }
  Pair cells(In in, int c = 0) const { return pair_of(row_, in, c, axis_); }

  void look_for_pure_cells() {
    for (int shift = -2; shift <= 1; ++shift) {
      const double* key = row_(h_.pure, 0, axis_, shift);
      for (int i = 0; i < n_; ++i) any_pure_ = any_pure_ || key[i] >= 0.0;
    }
  }

  // The row of a material; where the neighbourhood is pure that of the mixture, or nothing.
  const double* pick(In own, int c, In mixture, int mixture_c, int m, int shift) {
    const double* mine = row_(own, c, axis_, shift);
    if (!any_pure_) return mine;
    double* to = work_[used_++];
    pick_row(n_, row_(h_.pure, 0, axis_, shift), m, mine, row_(mixture, mixture_c, axis_, shift),
             to);
    return to;
  }
  const double* pick_base_of_volume(int m, int shift) {
    const double* __restrict mine = row_(h_.base, component(m, of_volume), axis_, shift);
    if (!any_pure_) return mine;
    const double* __restrict key = row_(h_.pure, 0, axis_, shift);
    double* __restrict to = work_[used_++];
    const double material = m;
    for (int i = 0; i < n_; ++i) {
      const double alone = key[i] == material ? 1.0 : 0.0;
      to[i] = key[i] < 0.0 ? mine[i] : alone;
    }
    return to;
  }
  void bind(Material& k, int m, Out flux) {
    k.index = m;
    const auto at = static_cast<std::size_t>(m);
    for (int s = 0; s < 6; ++s) k.V[s] = row_(h_.volume[at], 0, axis_, s - 3);
    for (int s = 0; s < 2; ++s) k.M[s] = row_(h_.mass[at], 0, axis_, s - 1);
    const auto four = [&](In own, In mixture) {
      const auto row = [&](int shift) { return pick(own, m, mixture, 0, m, shift); };
      return Second ? Around{row(-2), row(-1), row(0), row(1)}
                    : Around{nullptr, row(-1), row(0), nullptr};
    };
    const auto two = [&](In own, int c, In mixture, int mixture_c) {
      return Pair{pick(own, c, mixture, mixture_c, m, -1), pick(own, c, mixture, mixture_c, m, 0)};
    };
    k.r = four(h_.density, h_.mixture_density);
    k.e = four(h_.specific_energy, h_.mixture_energy);
    k.energy_L = two(h_.energy_L, m, h_.mixture_energy_star, 0);
    k.eps_L = two(h_.specific_energy_L, m, h_.mixture_energy_L, 0);
    k.scale = two(h_.scale, m, h_.mixture_scale, 0);
    if (based_) {
      k.base_V = {pick_base_of_volume(m, -1), pick_base_of_volume(m, 0)};
      k.base_r = two(h_.base, component(m, of_mass), h_.mixture_base, 0);
      k.base_e = two(h_.base, component(m, of_energy), h_.mixture_base, 1);
    }
    k.FV = row_(flux, component(m, of_volume));
    k.FM = row_(flux, component(m, of_mass));
    k.FE = row_(flux, component(m, of_energy));
  }

  // Step 1; FM tells whether the material may pass. Where a cell has none of it, it waits until the
  // donor is filled compared with the cell behind, if the others can make up the outflow: else the
  // foot of a front would run ahead, a cell a step, and flows that spread would carry it away. Tiny
  // amounts pass the main outlet only: through several they would leave to a share, never all.
  void propose(const Material& k) {
    const double *mmm = k.V[0], *mm = k.V[1], *a = k.V[2], *b = k.V[3], *pp = k.V[4], *ppp = k.V[5];
    double* __restrict share = k.FV;
    double* __restrict passes = k.FM;
    const double *Ma = k.M[0], *Mb = k.M[1];
    const Pair base = based_ ? k.base_V : Pair{a, b};
#pragma GCC ivdep
    for (int i = 0; i < n_; ++i) {
      const double H = l_ * uf_[i];
      const bool left = H < 0.0;
      const double V = left ? b[i] : a[i];
      double value = base.at(i, left);
      if constexpr (Second) {
        const double nu = std::fabs(H) * iJ_.at(i, left), B = 2.0 * iN_.at(i, left);
        const double low = a[i] - mm[i], dp = b[i] - a[i], high = pp[i] - b[i];
        const double dm = left ? high : low;
        // Of the five cells around the donor.
        const double far = left ? ppp[i] : mmm[i];
        const double least = smaller(smaller(smaller(mm[i], a[i]), smaller(b[i], pp[i])), far);
        const double greatest = larger(larger(larger(mm[i], a[i]), larger(b[i], pp[i])), far);
        const double sharp = sharp_slope(dm, dp, B), smooth = upwind_slope(dm, dp, nu, B);
        const bool interface = either(least<interface_band, greatest> 1.0 - interface_band);
        const double mask = Masked ? mask_.at(i, left) : 1.0;
        value += (left ? -0.5 : 0.5) * (1.0 - nu) * mask * (interface ? sharp : smooth);
      }
      const double N_out = larger(N_.at(i, left), 1e-12);
      const bool enters = (left ? Ma[i] : Mb[i]) == 0.0;
      const bool unfilled = V < least_fill * (left ? pp[i] : mm[i]);
      const double main = outlet_.at(i, left);
      const bool aside = both(V < tiny, both(main<0.0, -main> std::fabs(H)));
      const bool waits = either(both(enters, unfilled), aside);
      const double may = both(waits, 1.0 - V >= N_out) ? 0.0 : 1.0;
      share[i] = may * smaller(larger(value, 0.0), smaller(1.0, V / N_out));
      passes[i] = may;
    }
  }

  // Step 2. The sum is one up to round-off after one pass: the caps sum to one or more.
  void close_volumes() {
    for (int i = 0; i < n_; ++i) {
      const bool left = l_ * uf_[i] < 0.0;
      const double inverse = 1.0 / larger(N_.at(i, left), 1e-12);
      double sum = 0, room = 0, free[most];
      for (int k = 0; k < count(); ++k) {
        const Material& x = materials_[k];
        free[k] = x.FM[i] * smaller(1.0, (left ? x.V[3][i] : x.V[2][i]) * inverse) - x.FV[i];
        sum += x.FV[i];
        room += free[k];
      }
      const double fill = sum < 1.0 && room > 0.0 ? (1.0 - sum) / room : 0.0;
      const double shrink = sum > 1.0 ? 1.0 / sum : 1.0;
      for (int k = 0; k < count(); ++k)
        materials_[k].FV[i] = materials_[k].FV[i] * shrink + fill * free[k];
    }
  }

  // Step 3; FM tells whether the face takes all.
  void keep_traces_together(const Material& k) {
    const double *a = k.V[2], *b = k.V[3], *Ma = k.M[0], *Mb = k.M[1];
    double* __restrict share = k.FV;
    double* __restrict takes_all = k.FM;
#pragma GCC ivdep
    for (int i = 0; i < n_; ++i) {
      const double flow = std::fabs(l_ * uf_[i]);
      const bool left = l_ * uf_[i] < 0.0;
      const double V = left ? b[i] : a[i], receiver = left ? Ma[i] : Mb[i];
      const bool shared = both(V != 1.0, V != 0.0);  // else the donor has one material
      const bool stays = both(shared, both(receiver == 0.0, flow * share[i] < least_entry));
      const double now = stays ? 0.0 : share[i];
      const double V_L = V * J_.at(i, left);
      const bool leaves = V_L - flow * now <= larger(least_entry, least_rest * V_L);
      const double main = outlet_.at(i, left);
      const bool only_outlet = either(main == flow, both(V < tiny, main == -flow));
      const bool all = both(both(shared, now > 0.0), both(both(flow > 0.0, only_outlet), leaves));
      share[i] = all ? V_L / flow : now;
      takes_all[i] = all ? 1.0 : 0.0;
    }
  }

  // The largest share takes what round-off and the rules left.
  void take_the_rest() {
    for (int i = 0; i < n_; ++i) {
      int largest = 0;
      for (int k = 1; k < count(); ++k)
        if (materials_[k].FV[i] > materials_[largest].FV[i]) largest = k;
      double others = 0;
      for (int k = 0; k < count(); ++k) others += k == largest ? 0.0 : materials_[k].FV[i];
      materials_[largest].FV[i] = 1.0 - others;
    }
  }

  // Steps 4 and 5.
  void carry(const Material& k) {
    const double *mm = k.V[1], *a = k.V[2], *b = k.V[3], *pp = k.V[4];
    double* __restrict FV = k.FV, * __restrict FM = k.FM, * __restrict FE = k.FE;
    const Pair rho{k.r.m, k.r.p};
#pragma GCC ivdep
    for (int i = 0; i < n_; ++i) {
      const double H = l_ * uf_[i];
      const bool left = H < 0.0;
      const double here = left ? b[i] : a[i], share = FV[i];
      const double iJ = iJ_.at(i, left), N_out = N_.at(i, left), iN = iN_.at(i, left);
      const double rho_L = rho.at(i, left) * iJ, e_L = k.eps_L.at(i, left);
      const double sc = k.scale.at(i, left);
      double rho_s = based_ ? k.base_r.at(i, left) : rho_L;
      double eps_s = based_ ? k.base_e.at(i, left) : e_L;
      if constexpr (Second) {
        const double nu = std::fabs(H) * iJ;
        const double beyond = left ? pp[i] : mm[i];
        const bool full = both(a[i] > trace, both(b[i] > trace, beyond > trace));
        const double mask = Masked ? mask_.at(i, left) : 1.0;
        const double weight = (left ? -0.5 : 0.5) * (1.0 - nu) * iJ * mask;
        const double slope_r = donor_slope(k.r, i, left, nu, 2.0 * iN);
        const double slope_e = donor_slope(k.e, i, left, nu, 2.0);
        rho_s += full ? weight * slope_r : 0.0;
        eps_s += full ? weight * slope_e : 0.0;
      }
      // Bounds of a donor with one material, and of a share.
      const double phi = N_out * share / here;
      const double q = smaller(0.9, 0.5 * larger(0.0, 1.0 - phi) / larger(phi, 0.05));
      const bool one = here == 1.0;
      const double least_r = one ? 0.1 : 1.0 - q,
                   most_r = one ? (0.95 + 0.05 * N_out) * iN : 1.0 + q;
      const double least_e = one ? 0.9 : q, most_e = one ? (0.75 + 0.25 * N_out) * iN - 1.0 : q;
      rho_s = smaller(larger(rho_s, rho_L * least_r), rho_L * most_r);
      eps_s = smaller(larger(eps_s, e_L - least_e * sc), e_L + most_e * sc);
      const bool all = FM[i] != 0.0, none = share == 0.0;
      const double sign = left ? -1.0 : 1.0;
      const double volume = none ? 0.0 : H * share;
      FV[i] = all ? sign * (here * J_.at(i, left)) : volume;
      FM[i] = all ? sign * (left ? k.M[1][i] : k.M[0][i]) : none ? 0.0 : volume * rho_s;
      FE[i] = all ? sign * k.energy_L.at(i, left) : none ? 0.0 : volume * eps_s;
    }
  }

  const Row& row_;
  const MaterialHandles& h_;
  int axis_, n_, count_ = 0, used_ = 0;
  bool based_ = false, any_pure_ = false;
  double l_;
  const double* uf_;
  Pair iJ_, N_, iN_, mask_, J_, outlet_;
  Material materials_[most];
  double work_[most * rows_each][most_faces];
};

// The materials in the six cells around any of the faces.
std::uint64_t materials_around(const Row& row, const MaterialHandles& h, int axis) {
  std::uint64_t set = 0;
  for (int shift = -3; shift <= 2; ++shift) {
    const double* here = row(h.presence, 0, axis, shift);
    for (int i = 0; i < row.count(); ++i) set |= as_set(here[i]);
  }
  return set;
}

}  // namespace

MaterialHandles read_materials(TaskBuilder& task, const Variables& v, const SchemeOptions& o,
                               int axis) {
  const int direction = o.axes.direction[axis];
  const Stencil both = Stencil::along(direction, 1, 0), four = Stencil::along(direction, 2, 1);
  const Stencil six = Stencil::along(direction, 3, 2);
  MaterialHandles h;
  for (const VariableId id : v.mass) h.mass.push_back(task.read(id, both));
  for (const VariableId id : v.volume) h.volume.push_back(task.read(id, six));
  h.presence = task.read(v.presence, six);
  h.pure = task.read(v.pure, four);
  h.density = task.read(v.density, four);
  h.specific_energy = task.read(v.specific_energy, four);
  h.mixture_density = task.read(v.common.rho, four);
  h.mixture_energy = task.read(v.common.energy, four);
  h.energy_L = task.read(v.energy_L, both);
  h.mixture_energy_star = task.read(v.common.energy_star, both);
  h.specific_energy_L = task.read(v.specific_energy_L, both);
  h.mixture_energy_L = task.read(v.common.energy_L, both);
  h.scale = task.read(v.energy_scale, both);
  h.mixture_scale = task.read(v.common.energy_scale, both);
  h.lagrangian = task.read(v.common.lagrangian_mixture, both);
  if (o.second_order && o.axes.count > 1) {
    h.base = task.read(v.base[static_cast<std::size_t>(axis)], both);
    h.mixture_base = task.read(v.common.base[static_cast<std::size_t>(axis)], both);
  }
  return h;
}

namespace {

template <int N>
void carry_some(const Row& row, const RemapFluxHandles& common, const MaterialHandles& h, Out flux,
                const SchemeOptions& o, int axis, double l, std::uint64_t set) {
  if (!o.second_order)
    FaceShares<N, false, false>(row, common, h, flux, o, axis, l, set).run();
  else if (o.masked)
    FaceShares<N, true, true>(row, common, h, flux, o, axis, l, set).run();
  else
    FaceShares<N, true, false>(row, common, h, flux, o, axis, l, set).run();
}

}  // namespace

void carry_materials(const Row& row, const RemapFluxHandles& common, const MaterialHandles& h,
                     Out flux, const SchemeOptions& o, int axis, double l) {
  const std::uint64_t set = materials_around(row, h, axis);
  for (int m = 0; m < static_cast<int>(h.volume.size()); ++m) {
    if ((set >> m & 1) != 0) continue;
    for (const Carried q : {of_volume, of_mass, of_energy}) {
      double* nothing = row(flux, component(m, q));
      std::fill(nothing, nothing + row.count(), 0.0);
    }
  }
  switch (std::popcount(set)) {
    case 1:
      return carry_some<1>(row, common, h, flux, o, axis, l, set);
    case 2:
      return carry_some<2>(row, common, h, flux, o, axis, l, set);
    case 3:
      return carry_some<3>(row, common, h, flux, o, axis, l, set);
    default:
      return carry_some<0>(row, common, h, flux, o, axis, l, set);
  }
}

}  // namespace sluice::ice::mixture
