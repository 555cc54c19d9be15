// ArenaSoil: soil of grains, water and air (Banerjee and Brannon 2017; the chapters on Arena of
// Vaango's manuals). Elasticity, crush curve and pore pressure are those of wet_soil.hpp, the yield
// surface of the stress that grains bear is that of cap_surface.hpp.
//
// In the body's own axes a step is taken in parts. Each is a trial by K and G in the middle of the
// part (found by a first attempt with those of its start), then the nearest point of the surface
// that is there after the plastic strain: cap and pore pressure are functions of its volume e_v.
//   d e_v = (tr sigma_tr - tr sigma)/(3 K),   d e^p = (s_tr - s)/(2 G)
// Damage: the coherence C multiplies K and G and blends the sound limit curve with the failed one.
#include "mpm/material/geologic/arena.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/material/base/duvaut_lions.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/plastic_root.hpp"
#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {

LimitNumbers blended(const LimitNumbers& first, const LimitNumbers& second, double c) {
  const auto mix = [c](double x, double y) { return c * x + (1 - c) * y; };
  return {mix(first.PEAKI1, second.PEAKI1), mix(first.FSLOPE, second.FSLOPE),
          mix(first.STREN, second.STREN), mix(first.YSLOPE, second.YSLOPE)};
}

namespace {

// What a particle has become, in its own axes.
struct State {
  Symmetric sigma;
  double e_v = 0, e_q = 0;  // plastic change of volume, equivalent plastic strain
  double grown = 0, C = 1;  // time of plastic flow, s; coherence
};

// Columns of the history. All but the volume, the equivalent strain, the time, the coherence and
// the stress in rest follow from these, and are there to be saved.
enum Column {
  volume_column,
  elastic_column,
  strain_column,
  cumulative_column,
  cap_column,
  pressure_column,
  porosity_column,
  saturation_column,
  time_column,
  coherence_column,
  peak_column,
  quiet_column = 14
};
constexpr const char* column_names[] = {"p.plasticVolStrain",
                                        "p.elasticVolStrain",
                                        "p.plasticStrain",
                                        "p.plasticCumEqStrain",
                                        "p.capX",
                                        "p.porePressure",
                                        "p.porosity",
                                        "p.saturation",
                                        "p.TGROW",
                                        "p.COHER",
                                        "p.ArenaPEAKI1",
                                        "p.ArenaFSLOPE",
                                        "p.ArenaSTREN",
                                        "p.ArenaYSLOPE"};

constexpr double min_coherence = 1e-9;  // what has failed keeps a stiffness that is a number

class Arena final : public Material {
 public:
  explicit Arena(const ArenaConstants& constants) : c_(constants) {
    for (const char* name : column_names) history_.push_back({history_label(name), 1});
    history_.push_back({history_label("p.stressQS"), 6});
    const WetSoil::Moduli rest = c_.soil.moduli(0, c_.soil.pores(0));
    K_ = rest.K;
    G_ = rest.G;
  }

  std::span<const HistoryColumn> history() const override { return history_; }

  // Grains bear nothing: fluid and body begin at one pressure.
  void start(const Batch& b) const override {
    State rest;
    const double pressure = c_.soil.pore_pressure(0);
    for (std::size_t k = 0; k < 6; ++k) rest.sigma[k] = k < 3 ? -pressure : 0;
    for (int i = 0; i < b.count; ++i) {
      for (std::size_t k = 0; k < 6; ++k) b.stress[k][i] = rest.sigma[k];
      remember(b, i, rest, rest.sigma, 0);
      b.energy[i] = 0;
      b.wave_speed[i] = wave_speed({K_, G_}, determinant(at(b.F, i)));
    }
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    if (const auto fault = fault_of_volume(b)) return fault;
    for (int i = 0; i < b.count; ++i)
      if (!update(b, i))
        return BatchFault{i, "compressed beyond the range of the moduli of ArenaSoil: det F",
                          determinant(at(b.F, i))};
    return std::nullopt;
  }
  double bulk_modulus() const override { return K_; }
  double shear_modulus() const override { return G_; }

 private:
  double wave_speed(const WetSoil::Moduli& m, double J) const {
    return std::sqrt((m.K + 4.0 / 3 * m.G) * J / c_.density);
  }
  LimitNumbers limit(double C) const {
    return c_.damage ? blended(c_.sound, c_.failed, C) : c_.sound;
  }
  CapSurface surface(const LimitCurve& limit, double e_v) const {
    const double X = -c_.soil.strength(e_v);
    return {limit, X, limit.peak - c_.cap_share * (limit.peak - X)};
  }
  LimitCurve curve(double C) const {
    const LimitNumbers n = limit(C);
    return limit_curve(n.PEAKI1, n.FSLOPE, n.STREN, n.YSLOPE).value_or(LimitCurve{});
  }

  // False where a modulus or the stress is no number.
  bool update(const Batch& b, int i) const {
    const Matrix F_0 = at(b.old_F, i), F_1 = at(b.F, i);
    const double J_0 = determinant(F_0), J_1 = determinant(F_1);
    const Polar old_turn = polar(F_0), turn = polar(F_1);
    const Symmetric strain = strain_between(old_turn.U, turn.U);
    const Matrix back = transposed(old_turn.R);
    const Symmetric old = pushed(at(b.old_stress, i), back);

    State now;
    now.e_v = b.old_history[volume_column][i];
    now.e_q = b.old_history[strain_column][i];
    now.grown = b.old_history[time_column][i];
    now.C = b.old_history[coherence_column][i];
    for (std::size_t k = 0; k < 6; ++k) now.sigma[k] = b.old_history[quiet_column + k][i];
    now.sigma = pushed(now.sigma, back);
    const Symmetric quiet_0 = now.sigma;
    Symmetric elastic{};
    if (!advance(now, strain, b.dt, elastic)) return false;
    Symmetric sigma = now.sigma;
    if (c_.T1 > 0 && c_.T2 > 0) {
      const double rate = std::sqrt(double_dot(strain, strain)) / b.dt;
      const double tau = rate > 0 ? c_.T1 * std::pow(rate, -c_.T2) : 0;
      sigma = trailed(old, quiet_0, now.sigma, elastic, b.dt, tau);
    }

    remember(b, i, now, pushed(now.sigma, turn.R), std::log(J_1) - now.e_v);
    b.energy[i] =
        b.old_energy[i] +
        0.5 * b.volume_0[i] * (J_0 * double_dot(old, strain) + J_1 * double_dot(sigma, strain));
    b.wave_speed[i] = wave_speed(moduli(now), J_1);
    const Symmetric turned = pushed(sigma, turn.R);
    for (std::size_t k = 0; k < 6; ++k) b.stress[k][i] = turned[k];
    return std::isfinite(b.energy[i]) && std::isfinite(b.wave_speed[i]);
  }

  void remember(const Batch& b, int i, const State& s, const Symmetric& quiet, double e_e) const {
    const WetSoil::Pores pores = c_.soil.pores(s.e_v);
    const LimitNumbers n = limit(s.C);
    const double values[] = {s.e_v,
                             e_e,
                             s.e_q,
                             s.e_q,
                             -c_.soil.strength(s.e_v) - 3 * pores.pressure,  // of the whole stress
                             pores.pressure,
                             pores.share,
                             pores.saturation,
                             s.grown,
                             s.C,
                             n.PEAKI1,
                             n.FSLOPE,
                             n.STREN,
                             n.YSLOPE};
    for (std::size_t k = 0; k < std::size(values); ++k) b.history[k][i] = values[k];
    for (std::size_t k = 0; k < 6; ++k) b.history[quiet_column + k][i] = quiet[k];
  }

  WetSoil::Moduli moduli(double I, double e_v, double C) const {
    const WetSoil::Pores pores = c_.soil.pores(e_v);
    WetSoil::Moduli m = c_.soil.moduli(I + 3 * pores.pressure, pores);
    m.K *= C;
    m.G *= C;
    return m;
  }
  WetSoil::Moduli moduli(const State& s) const { return moduli(trace(s.sigma), s.e_v, s.C); }

  static Symmetric elastic_change(const WetSoil::Moduli& m, const Symmetric& strain) {
    Symmetric change = combined(2 * m.G, strain, 0, strain);
    const double volume = (m.K - 2.0 / 3 * m.G) * trace(strain);
    for (std::size_t k = 0; k < 3; ++k) change[k] += volume;
    return change;
  }

  // So many equal parts that an elastic one changes the moduli by a tenth and the stress by
  // <yield_surface_radius_scaling_factor> sizes of the surface.
  int parts(const State& s, const Symmetric& strain) const {
    const CapSurface now = surface(curve(s.C), s.e_v);
    const double size = std::max(0.5 * (now.limit.peak - now.X), now.strength(now.kappa));
    const WetSoil::Moduli m = moduli(s);
    const Symmetric change = elastic_change(m, strain);
    const double stiffer = moduli(trace(s.sigma) + trace(change), s.e_v, s.C).K / m.K - 1;
    const double wanted = std::ceil(std::max(
        10 * std::abs(stiffer), std::sqrt(double_dot(change, change)) / (c_.part_size * size)));
    return wanted < c_.max_parts ? std::max(static_cast<int>(wanted), 1) : c_.max_parts;
  }

  // Through a strain; `elastic` becomes the change of stress of a body that does not yield.
  bool advance(State& s, const Symmetric& strain, double dt, Symmetric& elastic) const {
    const int n = parts(s, strain);
    const Symmetric part = combined(1.0 / n, strain, 0, strain);
    for (int k = 0; k < n; ++k) {
      const State before = s;
      const LimitCurve limit = curve(before.C);
      WetSoil::Moduli m = moduli(before);
      Flow flow;
      for (const bool last : {false, true}) {
        if (!std::isfinite(m.K + m.G)) return false;
        const Symmetric change = elastic_change(m, part);
        s.sigma = combined(1, before.sigma, 1, change);
        s.e_v = before.e_v;
        flow = come_back(s, m, limit);
        if (last)
          elastic = combined(1, elastic, 1, change);
        else  // the middle of the part
          m = moduli(0.5 * (trace(before.sigma) + trace(s.sigma)), 0.5 * (before.e_v + s.e_v),
                     before.C);
      }
      s.e_q += std::sqrt(2.0 / 3) * flow.shear;
      if (c_.damage) grow(s, flow, part, dt / n);
    }
    return true;
  }

  // Plastic strain of a part: of volume, and |d e^p|.
  struct Flow {
    double volume = 0, shear = 0;
  };

  // Time of plastic flow, of which a part counts by its share of plastic strain:
  //   C = x/(1 + x),  x = exp(-fspeed (t/t_fail - 1)),  which never rises
  void grow(State& s, const Flow& flow, const Symmetric& part, double dt) const {
    const double all = std::sqrt(double_dot(part, part));
    const double plastic = std::sqrt(flow.shear * flow.shear + flow.volume * flow.volume / 3);
    if (!(plastic > 0) || !(all > 0)) return;
    s.grown += dt * std::min(plastic / all, 1.0);
    const double C = 1 / (1 + std::exp(c_.fspeed * (s.grown / c_.t_fail - 1)));
    s.C = std::max(std::min(s.C, C), min_coherence);
  }

  // From a trial stress to the surface that is there after the plastic strain.
  Flow come_back(State& s, const WetSoil::Moduli& m, const LimitCurve& limit) const {
    const double I_trial = trace(s.sigma);
    const Symmetric away = deviator(s.sigma);
    const double size = std::sqrt(double_dot(away, away));
    // The plane in which the nearest point is the associated return (beta = 1).
    const double scale = c_.beta * std::sqrt(1.5 * m.K / m.G);
    struct Met {
      Meridian at;
      double zeta = 0, volume = 0;
    };
    // With cap and pores of a plastic change of volume y of this part.
    const auto meet = [&](double y) {
      Met met;
      met.zeta = c_.soil.pore_pressure(s.e_v + y);
      const Meridian trial{I_trial + 3 * met.zeta, size * std::sqrt(0.5)};
      const CapSurface now = surface(limit, s.e_v + y);
      met.at = now.contains(trial) ? trial : now.nearest(trial, scale);
      met.volume = (trial.I - met.at.I) / (3 * m.K);
      return met;
    };
    Met met = meet(0);
    const double shear = size - std::sqrt(2.0) * met.at.q;
    if (met.volume == 0 && !(shear > 1e-15 * size)) return {};
    const double y = settled_volume(meet, met.volume);
    if (y != 0) met = meet(y);
    const double kept = size > 0 ? std::sqrt(2.0) * met.at.q / size : 0;
    s.sigma = combined(kept, away, 0, away);
    for (std::size_t k = 0; k < 3; ++k) s.sigma[k] += met.at.I / 3 - met.zeta;
    s.e_v += y;
    return {y, std::max(1 - kept, 0.0) * size / (2 * m.G)};
  }

  ArenaConstants c_;
  double K_ = 0, G_ = 0;
  std::vector<HistoryColumn> history_;
};

}  // namespace

std::shared_ptr<const Material> make_arena(const ArenaConstants& constants) {
  return std::make_shared<Arena>(constants);
}

}  // namespace sluice::mpm
