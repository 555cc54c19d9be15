// program_burn: an explosive that burns when a detonation of a given speed arrives (programmed
// burn, Wilkins 1964), from Murnaghan's solid to products of JWL.
//
//   t_b = T0 + s/D   s: distance of the particle at the start from the point or plane of ignition
//   f   = (t - t_b) D/(1.5 h) between 0 and 1, 1 from .96 on;   h = V_0^(1/3), length of a particle
//   p   = (1 - f) p_M + f p_J of v = rho0/rho   (explosive.hpp)
// The front belongs to the body: t_b is found once, at the start, so that a particle that moves on
// is lit when the detonation through the explosive at rest would have come to it.
#include <algorithm>
#include <cmath>

#include "models/burn/detonation_front.hpp"
#include "mpm/material/base/material_model.hpp"
#include "mpm/material/hydrodynamic/explosive.hpp"

namespace sluice::mpm {
namespace {

using Front = models::DetonationFront;

struct Detonation {
  double speed = 0, start_time = 0;
  Front front;
};

class ProgramBurn final : public Explosive {
 public:
  ProgramBurn(const ExplosiveMixture& mixture, double J0, double density, const Detonation& by)
      : Explosive(mixture, J0, density, "p.lightTime"), by_(by) {}

  void start(const Batch& b) const override {
    Explosive::start(b);
    for (int i = 0; i < b.count; ++i) {
      const Vec3 place = {b.position[0][i], b.position[1][i], b.position[2][i]};
      b.history[1][i] = by_.start_time + by_.front.distance(place) / by_.speed;
    }
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    if (const auto fault = fault_of_volume(b)) return fault;
    for (int i = 0; i < b.count; ++i) {
      const double t_b = b.old_history[1][i], width = Front::width * std::cbrt(b.volume_0[i]);
      const double f = std::max((b.time + b.dt - t_b) * by_.speed / width, 0.0);
      b.history[1][i] = t_b;
      set_burnt(b, i, std::max(f > Front::all ? 1 : f, b.old_history[0][i]));
    }
    return std::nullopt;
  }

 private:
  Detonation by_;
};

std::shared_ptr<const Material> make(const Parameters& p) {
  const ExplosiveMixture mixture = {p.real("K"), p.real("n"),  p.real("A"),  p.real("B"),
                                    p.real("C"), p.real("R1"), p.real("R2"), p.real("om")};
  const double density = p.constants().density;
  const double J0 = p.has("rho0") ? p.real("rho0") / density : 1;
  const Detonation by = {
      p.real("D"), p.real("T0"),
      models::detonation_front(p.vector("starting_location"), p.vector("direction_if_plane"))};
  return std::make_shared<ProgramBurn>(mixture, J0, density, by);
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
