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

}  // namespace

// At most `most_faces` faces of a row, material by material in plain loops.
template <bool Second, bool Masked>
class FaceShares {
 public:
  FaceShares(const MaterialFaces& faces, int first, int count, std::uint64_t set)
      : faces_(faces), axis_(faces.axis_), n_(count), first_(first), l_(faces.l_) {
    uf_ = faces.uf_ + first;
    iJ_ = faces.iJ_.from(first);
    N_ = faces.N_.from(first);
    iN_ = faces.iN_.from(first);
    J_ = faces.J_.from(first);
    outlet_ = faces.outlet_.from(first);
    if (Masked) mask_ = faces.mask_.from(first);
    for (int s = 0; s < 4; ++s) {
      pure_[s] = faces.pure_[s] + first;
      int pure = 0;
      for (int i = 0; i < n_; ++i) pure |= int{pure_[s][i] >= 0.0};
      any_pure_ = any_pure_ || pure != 0;
    }
    for_each_of(set, [&](int m) { bind(materials_[count_++], m); });
  }

  void run() {
    prepare();
    for (int k = 0; k < count_; ++k) {
      if (faces_.based_)
        propose<true>(materials_[k]);
      else
        propose<false>(materials_[k]);
    }
    close_volumes();
    for (int k = 0; k < count_; ++k) keep_traces_together(materials_[k], k);
    for (int k = 0; k < count_; ++k) take_the_rest(materials_[k], k);
    for (int k = 0; k < count_; ++k) {
      if (faces_.based_)
        carry<true>(materials_[k]);
      else
        carry<false>(materials_[k]);
    }
  }

 private:
  static constexpr int rows_each = 20;

  // One material around the faces.
  struct Material {
    const double* V[6];  // volume fraction of cells -3 .. 2
    const double* M[2];
    Around r, e;  // density and energy per own volume
    Pair energy_L, eps_L, scale, base_V, base_r, base_e;
    double *FV, *FM, *FE;
  };

  // The row of a material beside the face, cell `shift` + 2 of four; where the neighbourhood is
  // pure that of the mixture, or nothing.
  const double* pick(Sought q, int m, int shift) {
    if (!any_pure_) return q.own + first_;
    double* to = work_[used_++];
    pick_row(n_, pure_[shift + 2], m, q.own + first_, q.mixture + first_, to);
    return to;
  }
  Pair two(const Sought* q, int m) { return {pick(q[0], m, -1), pick(q[1], m, 0)}; }
  Around four(const Sought* q, int m) {
    if (!Second) return {nullptr, pick(q[1], m, -1), pick(q[2], m, 0), nullptr};
    return {pick(q[0], m, -2), pick(q[1], m, -1), pick(q[2], m, 0), pick(q[3], m, 1)};
  }

  void bind(Material& k, int m) {
    const MaterialFaceRows& x = faces_.rows_[m];
    for (int s = 0; s < 6; ++s) k.V[s] = x.V[s] + first_;
    for (int s = 0; s < 2; ++s) k.M[s] = x.M[s] + first_;
    k.r = four(x.r, m);
    k.e = four(x.e, m);
    k.energy_L = two(x.energy_L, m);
    k.eps_L = two(x.eps_L, m);
    k.scale = two(x.scale, m);
    if (faces_.based_) {
      k.base_V = two(x.base_V, m);
      k.base_r = two(x.base_r, m);
      k.base_e = two(x.base_e, m);
    }
    k.FV = x.FV + first_;
    k.FM = x.FM + first_;
    k.FE = x.FE + first_;
  }

  void prepare() {
    const int n = n_;
    const double l = l_;
    const double* const uf = uf_;
    const Pair outlet = outlet_;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      main_outlet_[i] = outlet.at(i, l * uf[i] < 0.0);
      sum_[i] = room_[i] = largest_[i] = others_[i] = largest_of_[i] = 0.0;
    }
  }

  // Step 1: FV holds the share, FE how much more the cell could give, FM the receiving mass. Where a
  // cell has none of a material, it waits until the donor is filled compared with the cell behind,
  // if the others can make up the outflow: else the foot of a front would run ahead, a cell a step,
  // and flows that spread would carry it away. Tiny amounts pass the main outlet only: through
  // several they would leave to a share, never all.
  template <bool Based>
  void propose(const Material& k) {
    const int n = n_;
    const double l = l_;
    const double* const uf = uf_;
    const double *mmm = k.V[0], *mm = k.V[1], *a = k.V[2], *b = k.V[3], *pp = k.V[4], *ppp = k.V[5];
    const Pair base = k.base_V, iJ = iJ_, N = N_, iN = iN_, mask_of = mask_;
    const Pair masses{k.M[0], k.M[1]};
    double *share = k.FV, *more = k.FE, *receiver = k.FM, *sum = sum_, *room = room_;
    const double* main = main_outlet_;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double H = l * uf[i];
      const bool left = H < 0.0;
      const double V = left ? b[i] : a[i];
      double value = Based ? base.at(i, left) : V;
      if constexpr (Second) {
        const double nu = std::fabs(H) * iJ.at(i, left), B = 2.0 * iN.at(i, left);
        const double low = a[i] - mm[i], dp = b[i] - a[i], high = pp[i] - b[i];
        const double dm = left ? high : low;
        // Of the five cells around the donor.
        const double far = left ? ppp[i] : mmm[i];
        const double least = smaller(smaller(smaller(mm[i], a[i]), smaller(b[i], pp[i])), far);
        const double greatest = larger(larger(larger(mm[i], a[i]), larger(b[i], pp[i])), far);
        const double sharp = sharp_slope(dm, dp, B), smooth = upwind_slope(dm, dp, nu, B);
        const bool interface = either(least<interface_band, greatest> 1.0 - interface_band);
        const double mask = Masked ? mask_of.at(i, left) : 1.0;
        value += (left ? -0.5 : 0.5) * (1.0 - nu) * mask * (interface ? sharp : smooth);
      }
      const double N_out = larger(N.at(i, left), 1e-12), behind = left ? pp[i] : mm[i];
      const double received = masses.at(i, !left);
      const bool unfilled = V < least_fill * behind;
      const bool aside = both(V < tiny, both(main[i]<0.0, -main[i]> std::fabs(H)));
      const bool waits = either(both(received == 0.0, unfilled), aside);
      const double may = both(waits, 1.0 - V >= N_out) ? 0.0 : 1.0;
      const double cap = may * smaller(1.0, V / N_out), now = smaller(larger(value, 0.0), cap);
      share[i] = now;
      more[i] = cap - now;
      receiver[i] = received;
      sum[i] += now;
      room[i] += cap - now;
    }
  }

  // Step 2. The sum is one up to round-off after one pass: the caps sum to one or more.
  void close_volumes() {
    const int n = n_;
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
    const int n = n_;
    const double l = l_;
    const double* const uf = uf_;
    const Pair cells{k.V[2], k.V[3]};
    const double *shrink = sum_, *fill = room_, *more = k.FE;
    const double* main = main_outlet_;
    const Pair J = J_;
    double *share = k.FV, *FM = k.FM;
    double *largest = largest_, *others = others_, *largest_of = largest_of_;
    const double which = number;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double flow = std::fabs(l * uf[i]);
      const bool left = l * uf[i] < 0.0;
      const double V = cells.at(i, left), receiver = FM[i];
      const double wanted = share[i] * shrink[i] + fill[i] * more[i];
      const bool shared = both(V != 1.0, V != 0.0);  // else the donor has one material
      const bool stays = both(shared, both(receiver == 0.0, flow * wanted < least_entry));
      const double V_L = V * J.at(i, left);
      const double rest = V_L - flow * wanted;
      const bool leaves = either(rest <= least_entry, rest <= least_rest * V_L);
      const bool only_outlet = either(main[i] == flow, both(V < tiny, main[i] == -flow));
      const bool all = both(both(both(shared, !stays), wanted > 0.0),
                            both(both(flow > 0.0, only_outlet), leaves));
      const double kept = stays ? 0.0 : wanted;
      const double now = all ? V_L / flow : kept;
      share[i] = now;
      FM[i] = all ? 1.0 : 0.0;
      const double before = largest[i];
      others[i] += smaller(now, before);
      largest_of[i] = now > before ? which : largest_of[i];
      largest[i] = larger(now, before);
    }
  }

  // The largest share takes what round-off and the rules left.
  void take_the_rest(const Material& k, int number) {
    const int n = n_;
    const double *others = others_, *largest_of = largest_of_;
    double* share = k.FV;
    const double which = number;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) share[i] = largest_of[i] == which ? 1.0 - others[i] : share[i];
  }

  // Steps 4 and 5.
  template <bool Based>
  void carry(const Material& k) {
    const int n = n_;
    const double l = l_;
    const double* const uf = uf_;
    const double *mm = k.V[1], *a = k.V[2], *b = k.V[3], *pp = k.V[4];
    const Pair masses{k.M[0], k.M[1]};
    const Pair iJ_of = iJ_, N_of = N_, iN_of = iN_, J_of = J_, mask_of = mask_;
    const Around r = k.r, e = k.e;
    const Pair rho{r.m, r.p}, eps_L = k.eps_L, scale = k.scale, energy_L = k.energy_L;
    const Pair base_r = k.base_r, base_e = k.base_e;
    double *FV = k.FV, *FM = k.FM, *FE = k.FE;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double H = l * uf[i];
      const bool left = H < 0.0;
      const double low = a[i], high = b[i], here = left ? high : low, share = FV[i];
      const double iJ = iJ_of.at(i, left), N_out = N_of.at(i, left), iN = iN_of.at(i, left);
      const double rho_L = rho.at(i, left) * iJ, e_L = eps_L.at(i, left);
      const double sc = scale.at(i, left);
      double rho_s = Based ? base_r.at(i, left) : rho_L;
      double eps_s = Based ? base_e.at(i, left) : e_L;
      if constexpr (Second) {
        const double nu = std::fabs(H) * iJ;
        const double beyond = left ? pp[i] : mm[i];
        const bool full = smaller(smaller(a[i], b[i]), beyond) > trace;
        const double mask = Masked ? mask_of.at(i, left) : 1.0;
        const double weight = (left ? -0.5 : 0.5) * (1.0 - nu) * iJ * mask;
        const double slope_r = donor_slope(r, i, left, nu, 2.0 * iN);
        const double slope_e = donor_slope(e, i, left, nu, 2.0);
        rho_s += full ? weight * slope_r : 0.0;
        eps_s += full ? weight * slope_e : 0.0;
      }
      // Bounds of a donor with one material, and of a share: (1 - phi)/max(phi, .05).
      const double gone = N_out * share;
      const double q = smaller(0.9, 0.5 * larger(0.0, here - gone) / larger(gone, 0.05 * here));
      const bool one = here == 1.0;
      const double least_r = one ? 0.1 : 1.0 - q,
                   most_r = one ? (0.95 + 0.05 * N_out) * iN : 1.0 + q;
      const double least_e = one ? 0.9 : q, most_e = one ? (0.75 + 0.25 * N_out) * iN - 1.0 : q;
      rho_s = smaller(larger(rho_s, rho_L * least_r), rho_L * most_r);
      eps_s = smaller(larger(eps_s, e_L - least_e * sc), e_L + most_e * sc);
      const bool all = FM[i] != 0.0, none = share == 0.0;
      const double sign = left ? -1.0 : 1.0;
      const double volume = none ? 0.0 : H * share;
      FV[i] = all ? sign * (here * J_of.at(i, left)) : volume;
      FM[i] = all ? sign * masses.at(i, left) : none ? 0.0 : volume * rho_s;
      FE[i] = all ? sign * energy_L.at(i, left) : none ? 0.0 : volume * eps_s;
    }
  }

  const MaterialFaces& faces_;
  int axis_, n_, first_, count_ = 0, used_ = 0;
  bool any_pure_ = false;
  double l_;
  const double* uf_;
  const double* pure_[4];
  Pair iJ_, N_, iN_, mask_, J_, outlet_;
  Material materials_[most_materials];
  using Work = double[MaterialFaces::most_faces];
  Work sum_, room_;  // then by how much shares shrink, and which part of what is left they take
  Work largest_, others_, largest_of_;
  Work main_outlet_;  // of the donor
  Work work_[most_materials * rows_each];
};

std::uint64_t MaterialFaces::carry(int first, int count) {
  const std::uint64_t set = materials_around(first, count);
  for (int m = 0; m < materials_; ++m) {
    bind(m);
    if ((set >> m & 1) == 0) nothing_passes(m, first, count);
  }
  if (!options_.second_order)
    FaceShares<false, false>(*this, first, count, set).run();
  else if (options_.masked)
    FaceShares<true, true>(*this, first, count, set).run();
  else
    FaceShares<true, false>(*this, first, count, set).run();
  return set;
}

}  // namespace sluice::ice::mixture
