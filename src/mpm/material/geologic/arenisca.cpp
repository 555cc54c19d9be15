// Arenisca, Arenisca3, Arenisca4: rock and soil whose pores are crushed under a cap and fill with
// fluid; after Homel, Guilkey and Brannon 2015 (Acta Mechanica 227), Homel and Brannon 2015
// (Int. J. Fracture 194), Fossum and Brannon 2004 (SAND2004-3226).
//
// In the body's own axes: trial by K (at the middle of the strain) and G, then the nearest point of
// the yield surface (cap_surface.hpp). Its cap X, back stress zeta (porous_rock.hpp), isotropic and
// kinematic hardening (Arenisca alone) are those of the plastic strain after the step:
//   J2^(1/2) of s - xi <= F_f F_c + H e_q,   d xi = c d e^p,   e_q = int (2/3 de^p : de^p)^(1/2)
//   d e_v^p = (tr sigma_tr - tr sigma)/(3 K),   d e^p = (s_tr - s)/(2 G)
// Rate dependence of Duvaut and Lions, tau = T1 |D|^T2: the stress trails what it would be in rest.
#include "mpm/material/geologic/arenisca.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/material/base/duvaut_lions.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/plastic_root.hpp"
#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {
namespace {

// What a particle has become, in its own axes.
struct State {
  Symmetric sigma, xi{};
  double e_v = 0, e_q = 0;  // plastic change of volume, equivalent plastic strain
};

// Columns of the history.
constexpr int volume_column = 0, elastic_column = 1, kappa_column = 2, strain_column = 3,
              first_optional = 4;

class Arenisca final : public Material {
 public:
  explicit Arenisca(const AreniscaConstants& constants) : c_(constants) {
    history_ = {{history_label("p.evp"), 1},
                {history_label("p.eve"), 1},
                {history_label("p.Kappa"), 1},
                {plastic_strain_label(), 1}};
    if (c_.kinematic != 0) history_.push_back({history_label("p.BackStress"), 6});
    if (c_.T1 > 0) history_.push_back({history_label("p.stressQS"), 6});
    quiet_column_ = first_optional + (c_.kinematic != 0 ? 6 : 0);
  }

  std::span<const HistoryColumn> history() const override { return history_; }

  // Fluid and body begin at one pressure.
  void start(const Batch& b) const override {
    const double mean = c_.rock.back_stress(0) / 3;
    for (int i = 0; i < b.count; ++i) {
      for (std::size_t k = 0; k < b.history.size(); ++k) b.history[k][i] = 0;
      for (int k = 0; k < 6; ++k) {
        b.stress[k][i] = k < 3 ? mean : 0;
        if (c_.T1 > 0) b.history[quiet_column_ + k][i] = k < 3 ? mean : 0;
      }
      b.history[kappa_column][i] = surface(0, 0).kappa;
      b.energy[i] = 0;
      b.wave_speed[i] = wave_speed(c_.rock.modulus(0, 0), determinant(at(b.F, i)));
    }
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    if (const auto fault = fault_of_volume(b)) return fault;
    for (int i = 0; i < b.count; ++i) update(b, i);
    return std::nullopt;
  }
  double bulk_modulus() const override { return c_.rock.modulus(0, 0); }
  double shear_modulus() const override { return c_.G; }

 private:
  double wave_speed(double K, double J) const {
    return std::sqrt((K + 4.0 / 3 * c_.G) * J / c_.density);
  }

  CapSurface surface(double e_v, double e_q) const {
    CapSurface s{c_.limit, c_.rock.crush(e_v), 0};
    if (c_.hardening != 0) {  // of the linear curve alone
      s.limit.a1 += c_.hardening * e_q;
      s.limit.peak = s.limit.a1 / s.limit.a4;
    }
    s.kappa = std::max(s.X, s.limit.peak - c_.cap_share * (s.limit.peak - s.X));
    return s;
  }

  void update(const Batch& b, int i) const {
    const Matrix F_0 = at(b.old_F, i), F_1 = at(b.F, i);
    const double J_0 = determinant(F_0), J_1 = determinant(F_1);
    const Polar old_turn = polar(F_0), turn = polar(F_1);
    const Symmetric strain = strain_between(old_turn.U, turn.U);
    const Matrix back = transposed(old_turn.R);
    const Symmetric old = pushed(at(b.old_stress, i), back);

    State now{old, {}, b.old_history[volume_column][i], b.old_history[strain_column][i]};
    if (c_.T1 > 0) now.sigma = pushed(six(b.old_history, quiet_column_, i), back);
    if (c_.kinematic != 0) now.xi = pushed(six(b.old_history, first_optional, i), back);
    const Symmetric quiet_0 = now.sigma;
    const Symmetric elastic = advance(now, strain);
    Symmetric sigma = now.sigma;
    if (c_.T1 > 0) {
      const double rate = std::sqrt(double_dot(strain, strain)) / b.dt;
      const double tau = c_.T1 * std::pow(rate, c_.T2);
      sigma = trailed(old, quiet_0, now.sigma, elastic, b.dt, tau);
    }

    b.history[volume_column][i] = now.e_v;
    b.history[elastic_column][i] = std::log(J_1) - now.e_v;
    b.history[kappa_column][i] = surface(now.e_v, now.e_q).kappa;
    b.history[strain_column][i] = now.e_q;
    if (c_.T1 > 0) put(b.history, quiet_column_, i, pushed(now.sigma, turn.R));
    if (c_.kinematic != 0) put(b.history, first_optional, i, pushed(now.xi, turn.R));
    b.energy[i] =
        b.old_energy[i] +
        0.5 * b.volume_0[i] * (J_0 * double_dot(old, strain) + J_1 * double_dot(sigma, strain));
    const double I = trace(now.sigma) - c_.rock.back_stress(now.e_v);
    b.wave_speed[i] = wave_speed(c_.rock.modulus(I, now.e_v), J_1);
    const Symmetric turned = pushed(sigma, turn.R);
    for (std::size_t k = 0; k < 6; ++k) b.stress[k][i] = turned[k];
  }

  static Symmetric six(std::span<const double* const> columns, int first, int i) {
    Symmetric s;
    for (std::size_t k = 0; k < 6; ++k) s[k] = columns[first + k][i];
    return s;
  }
  static void put(std::span<double* const> columns, int first, int i, const Symmetric& s) {
    for (std::size_t k = 0; k < 6; ++k) columns[first + k][i] = s[k];
  }

  // K where the stress is after half of this strain, as elastic.
  double middle_modulus(const State& s, double volume) const {
    const double I = trace(s.sigma) - c_.rock.back_stress(s.e_v);
    return c_.rock.modulus(I + 1.5 * c_.rock.modulus(I, s.e_v) * volume, s.e_v);
  }
  Symmetric elastic_change(double K, const Symmetric& strain) const {
    Symmetric change = combined(2 * c_.G, strain, 0, strain);
    const double volume = (K - 2.0 / 3 * c_.G) * trace(strain);
    for (std::size_t k = 0; k < 3; ++k) change[k] += volume;
    return change;
  }

  // So many equal parts that a part's stress is a tenth of the surface's size.
  int parts(const State& s, const Symmetric& strain) const {
    const CapSurface now = surface(s.e_v, s.e_q);
    const double size = std::min(0.5 * (now.limit.peak - now.X), now.strength(now.kappa));
    const Symmetric change = elastic_change(middle_modulus(s, trace(strain)), strain);
    const double wanted = std::ceil(10 * std::sqrt(double_dot(change, change)) / size);
    return wanted < c_.max_parts ? std::max(static_cast<int>(wanted), 1) : c_.max_parts;
  }

  // Through a strain; the change of stress of a body that does not yield comes back.
  Symmetric advance(State& s, const Symmetric& strain) const {
    const int n = parts(s, strain);
    const Symmetric part = combined(1.0 / n, strain, 0, strain);
    Symmetric all{};
    for (int k = 0; k < n; ++k) {
      const double K = middle_modulus(s, trace(part));
      const Symmetric change = elastic_change(K, part);
      all = combined(1, all, 1, change);
      s.sigma = combined(1, s.sigma, 1, change);
      come_back(s, K);
    }
    return all;
  }

  // From a trial stress to the surface that is there after the plastic strain.
  void come_back(State& s, double K) const {
    const double I_trial = trace(s.sigma);
    const Symmetric away = combined(1, deviator(s.sigma), -1, s.xi);
    const double size = std::sqrt(double_dot(away, away));
    const double scale = c_.beta * std::sqrt(1.5 * K / c_.G);
    struct Met {
      Meridian at;
      double zeta = 0, volume = 0, shear = 0;  // shear: |d e^p|
    };
    // With the surface of a plastic change of volume y and a plastic shear h of this step.
    const auto meet = [&](double y, double h) {
      Met m;
      m.zeta = c_.rock.back_stress(s.e_v + y);
      const Meridian trial{I_trial - m.zeta,
                           std::max(size - c_.kinematic * h, 0.0) * std::sqrt(0.5)};
      const CapSurface now = surface(s.e_v + y, s.e_q + std::sqrt(2.0 / 3) * h);
      m.at = now.contains(trial) ? trial : now.nearest(trial, scale);
      m.volume = (trial.I - m.at.I) / (3 * K);
      m.shear = std::sqrt(2.0) * (trial.q - m.at.q) / (2 * c_.G);
      return m;
    };
    // Hardening in shear makes the plastic shear less.
    const bool hardens = c_.hardening != 0 || c_.kinematic != 0;
    const auto settled = [&](double y) {
      Met m = meet(y, 0);
      if (!hardens || m.shear == 0) return m;
      const auto over = [&](double h) { return meet(y, h).shear - h; };
      return meet(y, falling_root(over, m.shear, m.shear, 0, 1e-14 * m.shear));
    };
    Met m = settled(0);
    if (m.volume == 0 && m.shear == 0) return;
    const double y = settled_volume(settled, m.volume);
    if (y != 0) m = settled(y);
    const double per = size > 0 ? 1 / size : 0;
    const double kept = std::sqrt(2.0) * m.at.q * per, moved = c_.kinematic * m.shear * per;
    s.xi = combined(1, s.xi, moved, away);
    s.sigma = combined(1, s.xi, kept, away);
    for (std::size_t k = 0; k < 3; ++k) s.sigma[k] += (m.at.I + m.zeta) / 3;
    s.e_v += y;
    s.e_q += std::sqrt(2.0 / 3) * m.shear;
  }

  AreniscaConstants c_;
  int quiet_column_ = 0;
  std::vector<HistoryColumn> history_;
};

}  // namespace

std::shared_ptr<const Material> make_arenisca(const AreniscaConstants& constants) {
  return std::make_shared<Arenisca>(constants);
}

}  // namespace sluice::mpm
