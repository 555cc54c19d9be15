// MohrCoulomb: soil and rock that slide where shear passes cohesion and friction; perfectly
// plastic, after de Souza Neto, Peric and Owen 2008, chapter 8.
//
//   (sigma_1 - sigma_3) + (sigma_1 + sigma_3) sin phi <= 2 c cos phi,   the greatest first
// The trial stress of linear elasticity in the body's own axes returns to the plane, to one of its
// two edges, or to the apex c cot phi, with the dilatancy psi in place of phi for the flow.
#include <algorithm>
#include <cmath>

#include "framework/deck/faults.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/material_model.hpp"
#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {
namespace {

using Three = std::array<double, 3>;  // principal values, greatest first

class MohrCoulomb final : public Material {
 public:
  MohrCoulomb(double K, double G, double cohesion, double phi, double psi, double density)
      : K_(K), G_(G), cohesion_(cohesion), density_(density) {
    sin_phi_ = std::sin(phi);
    cos_phi_ = std::cos(phi);
    sin_psi_ = std::sin(psi);
    history_ = {{plastic_strain_label(), 1}};
  }
  std::span<const HistoryColumn> history() const override { return history_; }

  void start(const Batch& b) const override {
    for (int i = 0; i < b.count; ++i) {
      for (double* column : b.stress) column[i] = 0;
      b.history[0][i] = b.energy[i] = 0;
      b.wave_speed[i] = wave_speed(determinant(at(b.F, i)));
    }
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    if (const auto fault = fault_of_volume(b)) return fault;
    for (int i = 0; i < b.count; ++i) {
      const Matrix F_0 = at(b.old_F, i), F_1 = at(b.F, i);
      const double J_0 = determinant(F_0), J_1 = determinant(F_1);
      const Polar old_turn = polar(F_0), turn = polar(F_1);
      const Symmetric strain = strain_between(old_turn.U, turn.U);
      const Symmetric old = pushed(at(b.old_stress, i), transposed(old_turn.R));
      Symmetric trial = combined(1, old, 2 * G_, strain);
      const double volume = (K_ - 2.0 / 3 * G_) * trace(strain);
      for (std::size_t k = 0; k < 3; ++k) trial[k] += volume;
      const Symmetric now = returned(trial);
      // Equivalent plastic strain of the difference: |dev(trial - now)|/(2 G) (2/3)^(1/2).
      const Symmetric lost = deviator(combined(1, trial, -1, now));
      b.history[0][i] =
          b.old_history[0][i] + std::sqrt(2.0 / 3 * double_dot(lost, lost)) / (2 * G_);
      b.energy[i] =
          b.old_energy[i] +
          0.5 * b.volume_0[i] * (J_0 * double_dot(old, strain) + J_1 * double_dot(now, strain));
      b.wave_speed[i] = wave_speed(J_1);
      const Symmetric sigma = pushed(now, turn.R);
      for (std::size_t k = 0; k < 6; ++k) b.stress[k][i] = sigma[k];
    }
    return std::nullopt;
  }
  double bulk_modulus() const override { return K_; }
  double shear_modulus() const override { return G_; }

 private:
  double wave_speed(double J) const { return std::sqrt((K_ + 4.0 / 3 * G_) * J / density_); }

  double beyond(double high, double low) const {
    return (high - low) + (high + low) * sin_phi_ - 2 * cohesion_ * cos_phi_;
  }

  Symmetric returned(const Symmetric& trial) const {
    const Principal p = principal(trial);
    const Three s = {p.values[2], p.values[1], p.values[0]};
    if (!(beyond(s[0], s[2]) > 0)) return trial;
    const Three r = returned(s);
    Symmetric now{};
    for (int m = 0; m < 3; ++m) {
      const double* n = &p.vectors[3 * (2 - m)];
      const double v = r[m];
      now[0] += v * n[0] * n[0];
      now[1] += v * n[1] * n[1];
      now[2] += v * n[2] * n[2];
      now[3] += v * n[1] * n[2];
      now[4] += v * n[0] * n[2];
      now[5] += v * n[0] * n[1];
    }
    return now;
  }

  // What a unit of the multiplier of the plane (high, low) takes from the principal stresses.
  Three flow(int high, int low) const {
    const double volume = 2 * sin_psi_ * (K_ - 2.0 / 3 * G_);
    Three taken = {volume, volume, volume};
    taken[high] += 2 * G_ * (1 + sin_psi_);
    taken[low] -= 2 * G_ * (1 - sin_psi_);
    return taken;
  }
  double slope(const Three& taken, int high, int low) const {
    const double a = taken[high], b = taken[low];
    return (a - b) + (a + b) * sin_phi_;
  }

  Three returned(const Three& s) const {
    const Three plane = flow(0, 2);
    const double x = beyond(s[0], s[2]) / slope(plane, 0, 2);
    Three r = {s[0] - x * plane[0], s[1] - x * plane[1], s[2] - x * plane[2]};
    const double size = std::abs(s[0]) + std::abs(s[2]);
    if (r[0] >= r[1] - 1e-14 * size && r[1] >= r[2] - 1e-14 * size) return r;
    // The edge with sigma_1 = sigma_2, where (1, 2) slides too, or that with sigma_2 = sigma_3.
    const bool upper = r[1] > r[0];
    const int high = upper ? 1 : 0, low = upper ? 2 : 1;
    const Three second = flow(high, low);
    const double f_1 = beyond(s[0], s[2]);
    const double f_2 = beyond(s[high], s[low]);
    const double a11 = slope(plane, 0, 2), a12 = slope(second, 0, 2);
    const double a21 = slope(plane, high, low), a22 = slope(second, high, low);
    const double det = a11 * a22 - a12 * a21;
    const double x1 = (f_1 * a22 - f_2 * a12) / det, x2 = (f_2 * a11 - f_1 * a21) / det;
    for (std::size_t k = 0; k < 3; ++k) r[k] = s[k] - x1 * plane[k] - x2 * second[k];
    if (sin_phi_ > 0) {
      const double apex = cohesion_ * cos_phi_ / sin_phi_;
      if (r[0] > apex || r[2] > r[0]) return {apex, apex, apex};
    }
    return r;
  }

  double K_, G_, cohesion_, density_, sin_phi_ = 0, cos_phi_ = 1, sin_psi_ = 0;
  std::vector<HistoryColumn> history_;
};

// Extensions of the format that the decks which we know do not use but for a few.
const std::vector<std::string> extensions = {"Usetransition", "Usemodul",    "Use_softening",
                                             "Use_linear",    "Use_regular", "UseWaterRetention"};

std::shared_ptr<const Material> make(const Parameters& p) {
  bool good = true;
  for (const std::string& name : extensions)
    if (p.real(name) != 0) {
      add_not_built(p.faults(), p.block(name)->where, "MohrCoulomb: <" + name + ">");
      good = false;
    }
  const double phi = p.real("Phi"), psi = p.real("Psi");
  if (psi > phi) {
    p.error("Psi", "<Psi> must not be greater than <Phi>: sliding would create energy");
    good = false;
  }
  if (phi == 0 && p.real("c") == 0) {
    p.error("c", "a body without cohesion <c> and friction <Phi> sustains no shear");
    good = false;
  }
  if (!good) return nullptr;
  constexpr double degree = 3.14159265358979323846 / 180;
  return std::make_shared<MohrCoulomb>(p.real("K"), p.real("G"), p.real("c"), phi * degree,
                                       psi * degree, p.constants().density);
}

}  // namespace

MaterialModel MohrCoulomb_model() {
  Tags tags = {positive("K", "bulk modulus, Pa"),
               positive("G", "shear modulus, Pa"),
               tag("c", "cohesion, Pa").once().real().at_least(0),
               tag("Phi", "angle of friction, degrees").once().real().at_least(0).at_most(89),
               number("Psi", "angle of dilatancy, degrees", 0).at_least(0).at_most(89),
               number("Version", "accepted without effect: there is one return algorithm", 11)};
  for (const std::string& name : extensions) tags.push_back(number(name, "must be 0", 0));
  for (const char* name : {"A1",         "B1",           "W",          "beta",      "beta_rate",
                           "strain_ref", "St",           "strain_95",  "m_modul",   "nuy",
                           "a",          "y_ref",        "y",          "n",         "tFE",
                           "tShear",     "n_nonlocalMC", "l_nonlocal", "PhiB",      "suction",
                           "SpecVol",    "WR_Param1",    "WR_Param2",  "WR_Param3", "WR_Param4"})
    tags.push_back(number(name, "parameter of an extension that is not supported", 0));
  return {"MohrCoulomb",
          {"MohrColoumb", "mohr_coulomb"},
          "soil and rock with cohesion and friction, perfectly plastic",
          tags,
          make};
}

}  // namespace sluice::mpm
