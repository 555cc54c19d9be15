// One state of one material, whatever its law.
#include "ice/fluid/fluid.hpp"

#include <type_traits>

namespace sluice::ice {
namespace {

// coefficient: relative distance of the two temperatures whose difference quotient is a heat
//   capacity; unit: 1
constexpr double temperature_step = 1e-4;

// f(law, heat) with the specific heat of the deck, or f(law) with the law's own.
template <class WithHeat, class Plain>
double with_heat(const Fluid& fluid, WithHeat with, Plain plain) {
  return std::visit(
      [&](const auto& law) {
        using T = std::decay_t<decltype(law)>;
        if constexpr (eos::TakesAnyHeat<T>) {
          if (fluid.heat)
            return std::visit([&](const auto& heat) { return with(law, heat); }, *fluid.heat);
        }
        return plain(law);
      },
      fluid.law);
}

}  // namespace

bool Fluid::depends_on_energy() const {
  return std::visit([](const auto& l) { return std::decay_t<decltype(l)>::depends_on_energy; },
                    law);
}

double Fluid::pressure(double rho, double rho_e) const {
  return std::visit([&](const auto& l) { return l.pressure(rho, rho_e); }, law);
}

double Fluid::temperature(double rho, double rho_e) const {
  return with_heat(
      *this,
      [&](const auto& l, const auto& heat_of) { return eos::temperature(l, heat_of, rho, rho_e); },
      [&](const auto& l) { return l.temperature(rho, rho_e); });
}

double Fluid::bulk_modulus(double rho, double p) const {
  return std::visit([&](const auto& l) { return l.bulk_modulus(rho, p); }, law);
}

double Fluid::modulus_of_state(double rho, double rho_e) const {
  return std::visit(
      [&](const auto& l) { return eos::modulus_of_state(l, rho, rho_e, l.pressure(rho, rho_e)); },
      law);
}

double Fluid::sound_speed(double rho, double p) const {
  return std::visit([&](const auto& l) { return l.sound_speed(rho, p); }, law);
}

double Fluid::energy_from_temperature(double rho, double T) const {
  return with_heat(
      *this,
      [&](const auto& l, const auto& heat_of) {
        return eos::energy_from_temperature(l, heat_of, rho, T);
      },
      [&](const auto& l) { return l.energy_from_temperature(rho, T); });
}

double Fluid::energy_from_pressure(double rho, double p, double T) const {
  return std::visit(
      [&](const auto& l) {
        using L = std::decay_t<decltype(l)>;
        if constexpr (eos::TwoTemperatures<L>)
          return l.energy_from_pressure(rho, p, T);
        else if constexpr (L::depends_on_energy)
          return l.energy_from_pressure(rho, p);
        else
          return energy_from_temperature(rho, T);
      },
      law);
}

double Fluid::density(double p, double T) const {
  return with_heat(
      *this, [&](const auto& l, const auto& heat_of) { return eos::density(l, heat_of, p, T); },
      [&](const auto& l) { return l.density(p, T); });
}

// Most laws say it; of the others energies a ten-thousandth of the temperature apart do.
double Fluid::heat_capacity(double rho, double rho_e) const {
  return with_heat(
      *this,
      [&](const auto& l, const auto& heat_of) {
        return heat_of.specific_heat(eos::temperature(l, heat_of, rho, rho_e));
      },
      [&](const auto& l) {
        if constexpr (requires { double{l.specific_heat}; }) {
          return l.specific_heat;
        } else {
          const double T = l.temperature(rho, rho_e), step = temperature_step * T;
          return (l.energy_from_temperature(rho, T + step) -
                  l.energy_from_temperature(rho, T - step)) /
                 (2.0 * step * rho);
        }
      });
}

double Fluid::heat_capacity_ratio(double rho, double rho_e) const {
  return std::visit(
      [&](const auto& l) {
        return l.heat_capacity_ratio(rho, rho_e, temperature(rho, rho_e),
                                     heat_capacity(rho, rho_e));
      },
      law);
}

std::optional<double> Fluid::constant_heat_capacity_ratio() const {
  return std::visit(
      [](const auto& l) -> std::optional<double> {
        if constexpr (requires { l.constant_heat_capacity_ratio(); })
          return l.constant_heat_capacity_ratio();
        else
          return std::nullopt;
      },
      law);
}

double Fluid::shock_slope() const {
  return std::visit([](const auto& l) { return l.shock_slope(); }, law);
}

double Fluid::lowest_pressure() const {
  return std::visit([](const auto& l) { return l.lowest_pressure(); }, law);
}

bool Fluid::admissible(double rho, double rho_e) const {
  return std::visit([&](const auto& l) { return l.admissible(rho, rho_e); }, law);
}

Fluid ideal_gas(double gamma, double specific_heat) {
  return {eos::IdealGas{gamma, specific_heat}, std::nullopt, gamma, specific_heat};
}

}  // namespace sluice::ice
