// The shares of the materials in what passes a face, step by step.
#include <algorithm>
#include <cmath>

#include "ice/closure/interface_band.hpp"
#include "ice/closure/whole_masses.hpp"
#include "ice/mixture/face_donors.hpp"
#include "ice/mixture/trace_rules.hpp"
#include "ice/step/material_runs.hpp"
#include "ice/step/remap_bounds.hpp"

namespace sluice::ice::mixture {
namespace {

// threshold: smallest inflow into a cell without the material, as a share of the largest volume
//   fraction around, where that is less than min_entry; unit: 1; test:
//   CompactSupport.FragmentsStayTogether
constexpr double min_of_most = 1e-2;
// threshold: lower limit of these bounds, as a share of the cell's volume: less would leave an open
//   side in ever smaller shares; unit: 1; test: none
constexpr double min_of_all = 1e-32;
// threshold: share of the volume fraction downstream below which the trailing end of a material
//   leaves its cell with the volume fraction found downstream; unit: 1; test:
//   CompactSupport.FragmentsStayTogether
constexpr double thinned = 0.1;

// Without a branch, so that rows vectorise.
inline bool both(bool a, bool b) {
  return (int{a} & int{b}) != 0;
}
inline bool either(bool a, bool b) {
  return (int{a} | int{b}) != 0;
}

inline double largest(double a, double b, double c) {
  return larger(larger(a, b), c);
}

// Q3 (limiters.hpp), or the bound itself where the slope shall be `sharp`.
inline double slope_of_share(double dm, double dp, double nu, double B, bool sharp) {
  const double s = ((2.0 - nu) * dp + (1.0 + nu) * dm) * (1.0 / 3.0);
  const double bound = smaller(B * std::fabs(dm), 2.0 * std::fabs(dp));
  const double size = sharp ? bound : smaller(std::fabs(s), bound);
  return dm * dp > 0.0 ? std::copysign(size, dm) : 0.0;
}

}  // namespace

// At most `max_faces` faces of a row, material by material in plain loops. Lanes: so many faces
// exactly, known when loops are compiled; 0: any number. At an interface there are a few faces a
// row, and loops around one vector would cost more than what they do. Blend: all cells around are
// blends of these materials, so that rules of fronts and traces choose nothing. Strained: materials
// relax before the remap, so that each has a strain r_m and an inverse 1/(J r_m) of its own.
// Slopes and differences are taken along the flow: from the cell behind the donor to that ahead.
template <bool Second, bool Masked, int Lanes, bool Blend, bool Strained>
class FaceShares {
 public:
  FaceShares(const MaterialFaces& faces, int first, int count, std::uint64_t set)
      : faces_(faces), n_(count), first_(first) {
    for_each_of(set, [&](int m) { bind(materials_[count_++], m); });
  }

  // False: a face takes all that is left of a material, for which blends have no loop.
  [[gnu::noinline]] bool run() {
    prepare();
    for (int k = 0; k < count_; ++k) {
      if (faces_.based_)
        propose<true>(materials_[k]);
      else
        propose<false>(materials_[k]);
    }
    close_volumes();
    for (int k = 0; k < count_; ++k) keep_traces_together(materials_[k], k);
    if (Blend && takes_all_ != 0) return false;
    for (int k = 0; k < count_; ++k) {
      if (faces_.based_)
        takes_all_ != 0 ? carry<true, true>(k) : carry<true, false>(k);
      else
        takes_all_ != 0 ? carry<false, true>(k) : carry<false, false>(k);
    }
    return true;
  }

 private:
  static constexpr int rows_each = 8;

  int size() const {
    if constexpr (Lanes > 0) return Lanes;
    return n_;
  }

  // One material around the faces. Left without values when declared: there are many.
  struct Material {
    const double* V[6];  // volume fraction of cells -3 .. 2
    const double* M[2];
    Pair r, e;          // density and energy per own volume
    Pair r_far, e_far;  // of cells -2 and 1
    Pair energy_L, eps_L, scale, base_V, base_r, base_e;
    Pair alike;       // of a mixed gas, else null
    Pair strain, iJ;  // if Strained
    double *FV, *FM, *FE;
  };

  static double strain_of(const Material& k, int i, bool left) {
    return Strained ? k.strain.at(i, left) : 1.0;
  }
  Pair cells(const Pair& row) const { return row.from(first_); }

  Pair two(const double* const* q) const { return {q[0] + first_, q[1] + first_}; }

  // Density and energy per own volume of the cell `s` - 2.
  void divide(const MaterialFaceRows& x, int s, const double*& density, const double*& energy) {
    const double* __restrict V = x.V[s + 1] + first_;
    const double* __restrict M = x.M[s] + first_;
    const double* __restrict E = x.E[s] + first_;
    double* __restrict r = work_[used_++];
    double* __restrict e = work_[used_++];
    const int n = size();
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double inverse = per_own_volume(V[i]);
      r[i] = M[i] * inverse;
      e[i] = E[i] * inverse;
    }
    density = r;
    energy = e;
  }

  void bind(Material& k, int m) {
    const MaterialFaceRows& x = faces_.rows_[m];
    for (int s = 0; s < 6; ++s) k.V[s] = x.V[s] + first_;
    for (int s = 0; s < 2; ++s) k.M[s] = x.M[s + 1] + first_;
    Around r{}, e{};  // the far cells: of second order only
    if constexpr (Blend) {
      r = x.r.from(first_);
      e = x.e.from(first_);
    } else {
      divide(x, 1, r.m, e.m);
      divide(x, 2, r.p, e.p);
      if constexpr (Second) {
        divide(x, 0, r.mm, e.mm);
        divide(x, 3, r.pp, e.pp);
      }
    }
    k.r = {r.m, r.p};
    k.e = {e.m, e.p};
    k.r_far = {r.mm, r.pp};
    k.e_far = {e.mm, e.pp};
    k.energy_L = two(x.energy_L);
    k.eps_L = two(x.eps_L);
    k.scale = two(x.scale);
    if (faces_.based_) {
      k.base_V = two(x.base_V);
      k.base_r = two(x.base_r);
      k.base_e = two(x.base_e);
    }
    k.alike = x.alike[0] != nullptr ? two(x.alike) : Pair{nullptr, nullptr};
    if constexpr (Strained) {
      k.strain = two(x.strain);
      k.iJ = two(x.iJ);
    }
    k.FV = x.FV + first_;
    k.FM = x.FM + first_;
    k.FE = x.FE + first_;
  }

  // What all materials need of the donor.
  void prepare() {
    const int n = size();
    const double l = faces_.l_;
    const double* const uf = faces_.uf_ + first_;
    const Pair iJ = cells(faces_.iJ_), N_of = cells(faces_.N_), iN = cells(faces_.iN_);
    const Pair J = cells(faces_.J_), outlet = cells(faces_.outlet_);
    const Pair mask_of = Masked ? cells(faces_.mask_) : Pair{};
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double H = l * uf[i], flow = std::fabs(H);
      const bool left = H < 0.0;
      const double inverse = iJ.at(i, left), nu = flow * inverse, N = N_of.at(i, left);
      const double mask = Masked ? mask_of.at(i, left) : 1.0;
      H_[i] = H;
      iJ_[i] = inverse;
      nu_[i] = nu;
      N_[i] = N;
      iN_[i] = iN.at(i, left);
      J_[i] = J.at(i, left);
      main_outlet_[i] = outlet.at(i, left);
      weight_[i] = 0.5 * (1.0 - nu) * mask;
      per_N_[i] = 1.0 / larger(N, no_outflow);
      if constexpr (!Blend) per_flow_[i] = 1.0 / flow;
      sum_[i] = room_[i] = largest_[i] = others_[i] = largest_of_[i] = 0.0;
    }
  }

  // Step 1: FV holds the share, FE how much more the cell could give, FM the receiving mass. Where
  // a cell has none of a material, it waits until the donor is filled as against the cell behind,
  // if the others can make up the outflow: else the foot of a front would run ahead, a cell a step,
  // and flows that spread would carry it away. The thinned last cell of a trail lies against what
  // goes ahead of it and leaves as densely: else flows that spread would draw the trail out. Tiny
  // amounts pass the main outlet only: through several they would leave to a share, never all.
  template <bool Based>
  void propose(const Material& k) {
    const int n = size();
    const double *mmm = k.V[0], *mm = k.V[1], *a = k.V[2], *b = k.V[3], *pp = k.V[4], *ppp = k.V[5];
    const Pair base = k.base_V, masses{k.M[0], k.M[1]};
    double *share = k.FV, *more = k.FE, *receiver = k.FM;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double H = H_[i];
      const bool left = H < 0.0;
      const double V = chosen(left, b[i], a[i]), behind = chosen(left, pp[i], mm[i]);
      double value = Based ? base.at(i, left) : V;
      if constexpr (Second) {
        const double ahead = chosen(left, a[i], b[i]);
        // Of the five cells around the donor.
        const double far = chosen(left, ppp[i], mmm[i]);
        const double least = smaller(smaller(smaller(mm[i], a[i]), smaller(b[i], pp[i])), far);
        const double greatest = larger(larger(larger(mm[i], a[i]), larger(b[i], pp[i])), far);
        const bool interface = either(least<interface_band, greatest> 1.0 - interface_band);
        value +=
            weight_[i] * slope_of_share(V - behind, ahead - V, nu_[i], 2.0 * iN_[i], interface);
      }
      const double r = strain_of(k, i, left);
      value *= r;
      double may = 1.0;
      if constexpr (!Blend) {
        const double received = masses.at(i, !left), main = main_outlet_[i];
        const double most = left ? largest(a[i], mm[i], mmm[i]) : largest(b[i], pp[i], ppp[i]);
        const bool last = both(behind == 0.0, V < thinned * most);
        value = both(last, std::fabs(main) == std::fabs(H)) ? larger(value, most) : value;
        const bool unfilled = V < min_fill * behind;
        const bool aside = both(V < tiny, both(main<0.0, -main> std::fabs(H)));
        const bool waits = either(both(received == 0.0, unfilled), aside);
        may = both(waits, 1.0 - V >= larger(N_[i], no_outflow)) ? 0.0 : 1.0;
        receiver[i] = received;
      }
      const double cap = may * smaller(1.0, V * r * per_N_[i]),
                   now = smaller(larger(value, 0.0), cap);
      share[i] = now;
      more[i] = cap - now;
      sum_[i] += now;
      room_[i] += cap - now;
    }
  }

  // Step 2. The sum is one up to round-off after one pass: the caps sum to one or more.
  void close_volumes() {
    const int n = size();
    double *shrink = sum_, *fill = room_;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double sum = shrink[i], room = fill[i];
      const bool too_few = sum < 1.0;
      const double ratio = (too_few ? 1.0 - sum : 1.0) / (too_few ? room : sum);
      fill[i] = both(too_few, room > 0.0) ? ratio : 0.0;
      shrink[i] = sum > 1.0 ? ratio : 1.0;
    }
  }

  // Step 3; FM tells whether the face takes all.
  void keep_traces_together(const Material& k, int number) {
    const int n = size();
    const Pair fraction{k.V[2], k.V[3]};
    const double *V0 = k.V[0], *V1 = k.V[1], *V2 = k.V[2], *V3 = k.V[3], *V4 = k.V[4], *V5 = k.V[5];
    const double *shrink = sum_, *fill = room_, *more = k.FE;
    double *share = k.FV, *FM = k.FM;
    const double which = number;
    int takes_all = 0;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double H = H_[i], flow = std::fabs(H), main = main_outlet_[i];
      const double V = fraction.at(i, H < 0.0);
      const double wanted = share[i] * shrink[i] + fill[i] * more[i];
      const double V_L = V * J_[i] * strain_of(k, i, H < 0.0), rest = V_L - flow * wanted;
      bool shared = true;  // else the donor has one material
      bool stays = false, only_outlet = main == flow;
      double little = min_entry;
      if constexpr (!Blend) {
        shared = both(V != 1.0, V != 0.0);
        const double most = larger(largest(V0[i], V1[i], V2[i]), largest(V3[i], V4[i], V5[i]));
        little = smaller(little, larger(min_of_all, min_of_most * most));
        stays = both(shared, both(FM[i] == 0.0, flow * wanted < little));
        only_outlet = either(only_outlet, both(V < tiny, main == -flow));
      }
      const bool leaves = either(rest <= little, rest <= min_rest * V_L);
      const bool all = both(both(both(shared, !stays), wanted > 0.0),
                            both(both(flow > 0.0, only_outlet), leaves));
      double now = stays ? 0.0 : wanted;
      if constexpr (!Blend) {
        now = all ? V_L * per_flow_[i] : now;
        FM[i] = all ? 1.0 : 0.0;
      }
      share[i] = now;
      takes_all |= int{all};
      const double before = largest_[i];
      others_[i] += smaller(now, before);
      largest_of_[i] = now > before ? which : largest_of_[i];
      largest_[i] = larger(now, before);
    }
    takes_all_ |= takes_all;
  }

  // Steps 4 and 5; first the largest share takes what round-off and the rules left.
  template <bool Based, bool All>
  void carry(int number) {
    const Material& k = materials_[number];
    k.alike.a == nullptr ? carry<Based, All, false>(k, number) : carry<Based, All, true>(k, number);
  }
  template <bool Based, bool All, bool Mixed>
  void carry(const Material& k, int number) {
    const int n = size();
    const double *mm = k.V[1], *a = k.V[2], *b = k.V[3], *pp = k.V[4];
    const Pair masses{k.M[0], k.M[1]};
    const Pair r = k.r, e = k.e, r_far = k.r_far, e_far = k.e_far;
    const Pair eps_L = k.eps_L, scale = k.scale, energy_L = k.energy_L;
    const Pair base_r = k.base_r, base_e = k.base_e, alike = k.alike;
    double *FV = k.FV, *FM = k.FM, *FE = k.FE;
    const double which = number;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double H = H_[i], iJ = iJ_[i], N_out = N_[i], iN = iN_[i];
      const bool left = H < 0.0;
      const double here = chosen(left, b[i], a[i]) * strain_of(k, i, left);
      const double share = largest_of_[i] == which ? 1.0 - others_[i] : FV[i];
      const double rho = r.at(i, left), iJ_m = Strained ? k.iJ.at(i, left) : iJ;
      const double rho_L = rho * iJ_m, e_L = eps_L.at(i, left);
      const double sc = scale.at(i, left);
      double rho_s = Based ? base_r.at(i, left) : rho_L;
      double eps_s = Based ? base_e.at(i, left) : e_L;
      if constexpr (Second) {
        const double weight = weight_[i] * iJ, nu = nu_[i], E = e.at(i, left);
        bool full = true;
        if constexpr (!Blend)
          full = smaller(smaller(a[i], b[i]), chosen(left, pp[i], mm[i])) > min_sloped;
        const double slope_r =
            upwind_slope(rho - r_far.at(i, left), r.at(i, !left) - rho, nu, 2.0 * iN);
        const double slope_e = upwind_slope(E - e_far.at(i, left), e.at(i, !left) - E, nu, 2.0);
        rho_s += full ? weight_[i] * iJ_m * slope_r : 0.0;
        eps_s += full ? weight * slope_e : 0.0;
      }
      if constexpr (Mixed) {
        const bool same = alike.at(i, left) != 0.0;
        rho_s = same ? rho_s : rho_L;
        eps_s = same ? eps_s : e_L;
      }
      // Bounds of a donor with one material, and of a share: (1 - phi)/max(phi, .05).
      const double gone = N_out * share;
      const double q =
          smaller(face_drop, 0.5 * larger(0.0, here - gone) / larger(gone, min_outflow * here));
      const bool one = both(!Blend, here == 1.0);
      const double least_r = one ? face_floor : 1.0 - q,
                   most_r = one ? (density_gone + density_left * N_out) * iN : 1.0 + q;
      const double least_e = one ? face_drop : q,
                   most_e = one ? (energy_gone + energy_left * N_out) * iN - 1.0 : q;
      rho_s = smaller(larger(rho_s, rho_L * least_r), rho_L * most_r);
      eps_s = smaller(larger(eps_s, e_L - least_e * sc), e_L + most_e * sc);
      const bool none = share == 0.0;
      const double volume = none ? 0.0 : H * share;
      const bool drains = gone > 0.5 * here;
      const double booked = whole_mass(volume * rho_s, masses.a[i], masses.b[i], drains);
      double mass = none ? 0.0 : booked, energy = none ? 0.0 : volume * eps_s;
      if constexpr (All) {
        const bool all = FM[i] != 0.0;
        const double sign = left ? -1.0 : 1.0;
        mass = all ? sign * masses.at(i, left) : mass;
        energy = all ? sign * energy_L.at(i, left) : energy;
        FV[i] = all ? sign * (here * J_[i]) : volume;
      } else {
        FV[i] = volume;
      }
      FM[i] = mass;
      FE[i] = energy;
    }
  }

  const MaterialFaces& faces_;
  int n_, first_, count_ = 0, used_ = 0;
  int takes_all_ = 0;  // some face does
  Material materials_[max_materials];
  using Work = double[Lanes > 0 ? Lanes : MaterialFaces::max_faces];
  Work sum_, room_;  // then by how much shares shrink, and which part of what is left they take
  Work largest_, others_, largest_of_;
  // Of the donor; weight: (1-nu)/2.
  Work H_, iJ_, nu_, N_, iN_, J_, main_outlet_, weight_, per_N_, per_flow_;
  Work work_[Blend ? 1 : max_materials * rows_each];
};

std::uint64_t MaterialFaces::carry(int first, int count) {
  const std::uint64_t blend = blend_around(first, count);
  const std::uint64_t set = blend != 0 ? blend : materials_around(first, count);
  for (int m = 0; m < materials_; ++m) {
    bind(m);
    if ((set >> m & 1) == 0) nothing_passes(m, first, count);
  }
  constexpr int lanes = 8;
  const auto share = [&]<bool Second, bool Masked, bool Strained>() {
    if (count == lanes) {
      FaceShares<Second, Masked, lanes, false, Strained>(*this, first, count, set).run();
      return;
    }
    if (blend != 0 &&
        FaceShares<Second, Masked, 0, Second, Strained>(*this, first, count, set).run())
      return;
    FaceShares<Second, Masked, 0, false, Strained>(*this, first, count, set).run();
  };
  const auto share_by_order = [&]<bool Strained>() {
    if (!options_.scheme.second_order)
      share.template operator()<false, false, Strained>();
    else if (options_.scheme.masked)
      share.template operator()<true, true, Strained>();
    else
      share.template operator()<true, false, Strained>();
  };
  if (relaxes_before_remap(options_))
    share_by_order.template operator()<true>();
  else
    share_by_order.template operator()<false>();
  return set;
}

}  // namespace sluice::ice::mixture
