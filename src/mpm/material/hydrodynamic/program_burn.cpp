// program_burn: an explosive that burns when a detonation of a given speed arrives (programmed
// burn, Wilkins 1964), from Murnaghan's solid to products of JWL.
//
//   t_b = T0 + s/D   s: distance of the particle at the start from the point or plane of ignition
//   f   = (t - t_b) D/(1.5 h) between 0 and 1, 1 from .96 on;   h = V_0^(1/3), length of a particle
//   p   = (1 - f) p_M + f p_J of v = rho0/rho   (explosive_mixture.hpp);   sigma = -p I
// The front belongs to the body: t_b is found once, at the start, so that a particle that moves on
// is lit when the detonation through the explosive at rest would have come to it.
#include <algorithm>
#include <cmath>

#include "models/burn/detonation_front.hpp"
#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/material_model.hpp"
#include "mpm/material/hydrodynamic/explosive_mixture.hpp"

namespace sluice::mpm {
namespace {

using Front = models::DetonationFront;

struct BurnConstants {
  ExplosiveMixture of;
  double J0 = 1;       // rho0 over the density of the material
  double density = 0;  // of the material
  double speed = 0, start_time = 0;
  Front front;
};

class ProgramBurn final : public Material {
 public:
  explicit ProgramBurn(const BurnConstants& constants) : c_(constants) {
    history_ = {{history_label("p.progressF"), 1}, {history_label("p.lightTime"), 1}};
  }
  std::span<const HistoryColumn> history() const override { return history_; }

  void start(const Batch& b) const override {
    for (int i = 0; i < b.count; ++i) {
      const Vec3 place = {b.position[0][i], b.position[1][i], b.position[2][i]};
      b.history[1][i] = c_.start_time + c_.front.distance(place) / c_.speed;
      b.history[0][i] = 0;
      b.energy[i] = 0;
      set_stress(b, i, determinant(at(b.F, i)), 0);
    }
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    if (const auto fault = fault_of_volume(b)) return fault;
    for (int i = 0; i < b.count; ++i) {
      const double J_0 = determinant(at(b.old_F, i)), J = determinant(at(b.F, i));
      const double t_b = b.old_history[1][i], width = Front::width * std::cbrt(b.volume_0[i]);
      double f = std::max((b.time + b.dt - t_b) * c_.speed / width, 0.0);
      f = std::max(f > Front::all ? 1 : f, b.old_history[0][i]);
      b.history[0][i] = f;
      b.history[1][i] = t_b;
      set_stress(b, i, J, f);
      b.energy[i] =
          b.old_energy[i] + 0.5 * b.volume_0[i] * (b.old_stress[0][i] + b.stress[0][i]) * (J - J_0);
    }
    return std::nullopt;
  }
  double bulk_modulus() const override { return 1 / c_.of.K; }

 private:
  void set_stress(const Batch& b, int i, double J_F, double f) const {
    const double v = J_F * c_.J0, p = c_.of.pressure(v, f);
    for (int k = 0; k < 6; ++k) b.stress[k][i] = k < 3 ? -p : 0;
    const double modulus = std::max(c_.of.modulus(v, f), 1e-3 / c_.of.K);
    b.wave_speed[i] = std::sqrt(modulus * J_F / c_.density);
  }

  BurnConstants c_;
  std::vector<HistoryColumn> history_;
};

std::shared_ptr<const Material> make(const Parameters& p) {
  BurnConstants c;
  c.of = {p.real("K"), p.real("n"),  p.real("A"),  p.real("B"),
          p.real("C"), p.real("R1"), p.real("R2"), p.real("om")};
  c.density = p.constants().density;
  if (p.has("rho0")) c.J0 = p.real("rho0") / c.density;
  c.speed = p.real("D");
  c.start_time = p.real("T0");
  c.front = models::detonation_front(p.vector("starting_location"), p.vector("direction_if_plane"));
  return std::make_shared<ProgramBurn>(c);
}

}  // namespace

MaterialModel program_burn_model() {
  return {
      "program_burn",
      {},
      "explosive that burns when a detonation of a given speed arrives",
      {positive("K", "compressibility of the solid, 1/Pa"),
       positive("n", "derivative of its bulk modulus by pressure"),
       tag("A", "pressure of the first exponential of JWL, Pa").once().real().at_least(0),
       number("B", "pressure of the second exponential, Pa"),
       number("C", "pressure of the power of density, Pa"), positive("R1", "first exponent"),
       positive("R2", "second exponent"), positive("om", "Grueneisen coefficient"),
       tag("rho0", "density of the solid without pressure, kg/m^3; absent: that of the material")
           .real()
           .above(0),
       positive("D", "speed of the detonation, m/s"), number("T0", "time of ignition, s", 0),
       tag("starting_location", "point where the detonation starts, or a point of the plane")
           .once()
           .vector(),
       tag("direction_if_plane",
           "normal of the plane where it starts; [0, 0, 0]: it starts at the point")
           .vector()
           .by_default("[0, 0, 0]"),
       number("P0", "accepted without effect: reference pressure with a fluid, Pa", 0)},
      make};
}

}  // namespace sluice::mpm
