// Wave curve of any law: shocks by a search for their density, rarefactions by integration. Units
// as in wave_curve.hpp.
#pragma once
#include <cmath>

#include "eos/bracketed_root.hpp"
#include "exact/riemann/isentrope.hpp"
#include "exact/riemann/wave_curve.hpp"

namespace sluice::exact {

template <eos::Law Law>
class GeneralCurve final : public WaveCurve {
 public:
  GeneralCurve(const Law& law, const eos::EquationOfState& any, const FluidState& ahead)
      : WaveCurve(any, ahead), own_(law), isentrope_(law, ahead) {}

  Point behind(double pressure) override {
    if (pressure > ahead_.pressure) return shocked(pressure);
    if (!(pressure > own_.lowest_pressure())) refuse(pressure, "no state has such a low pressure");
    auto state = isentrope_.at_pressure(pressure);
    if (!state) refuse(pressure, "the isentrope ends before this pressure (void or tension)");
    state->pressure = pressure;  // to the bit, as on the other side of a contact
    return {*state, 1 / (state->density * sound_speed(law_, *state))};
  }
  FluidState in_fan(double speed) const override { return isentrope_.at_wave_speed(speed); }
  double lowest_pressure() const override { return own_.lowest_pressure(); }

 private:
  // Energy on the Hugoniot curve of the shock to `pressure`, at a density.
  double hugoniot_energy(double pressure, double rho) const {
    return ahead_.energy + 0.5 * (pressure + ahead_.pressure) * specific_volume_lost(rho);
  }
  double specific_volume_lost(double rho) const {
    return (rho - ahead_.density) / (rho * ahead_.density);
  }

  Point shocked(double pressure) const {
    const auto excess = [&](double rho) {
      const double rho_e = rho * hugoniot_energy(pressure, rho);
      const double along = 0.5 * (pressure + ahead_.pressure) / (rho * rho);  // de/drho
      return eos::ValueAndSlope{own_.pressure(rho, rho_e) - pressure,
                                own_.dp_drho(rho, rho_e) + own_.dp_de(rho, rho_e) * along};
    };
    const double rho = eos::bracketed_root(excess, ahead_.density, reach(excess, pressure), 0.0);
    const double e = hugoniot_energy(pressure, rho), lost = specific_volume_lost(rho);
    const double jump = pressure - ahead_.pressure;
    const double velocity = std::sqrt(std::max(jump * lost, 0.0));
    return {{rho, velocity, pressure, e}, slope(pressure, rho, e, velocity)};
  }

  // A density where the pressure is too high.
  template <class Excess>
  double reach(const Excess& excess, double pressure) const {
    const double top = own_.highest_density();
    double high = ahead_.density;
    for (double growth = 1e-3; growth > 1e-6 && std::isfinite(high);) {
      const double next = std::min((1 + growth) * high, high + 0.5 * (top - high));
      const double value = excess(next).value;
      if (value >= 0) return next;
      if (!(next > high)) break;
      if (value < 0) high = next;  // else the law ends before: go on in smaller steps
      growth *= value < 0 ? 1.5 : 0.25;
    }
    refuse(pressure, "no shock is that strong");
  }

  // From (u - u0)^2 = (p - p0)(v0 - v), with dv/dp by differentiating the Hugoniot relation.
  double slope(double pressure, double rho, double e, double velocity) const {
    const double rho_e = rho * e, p_e = own_.dp_de(rho, rho_e);
    const double lost = specific_volume_lost(rho), jump = pressure - ahead_.pressure;
    const double acoustic = 1 / (ahead_.density * sound_speed_);
    if (!(velocity > 1e-8 * sound_speed_)) return acoustic;
    const double p_rho =
        own_.dp_drho(rho, rho_e) + 0.5 * p_e * (pressure + ahead_.pressure) / (rho * rho);
    const double lost_slope = (1 - 0.5 * p_e * lost) / (p_rho * rho * rho);
    return 0.5 * (lost + jump * lost_slope) / velocity;
  }

  Law own_;
  Isentrope<Law> isentrope_;
};

}  // namespace sluice::exact
