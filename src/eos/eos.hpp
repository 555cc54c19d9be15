// The closed set of equations of state, to be visited outside loops over cells.
//
// Every law gives the functions of the concept below; `visit` hands its concrete type to a row
// loop, where they are inlined. Temperature with a specific heat that is not constant: the law
// gives the energy above its cold curve, the heat turns it into a temperature (free functions
// below).
#pragma once
#include <concepts>
#include <optional>
#include <string_view>
#include <type_traits>
#include <variant>

#include "eos/birch_murnaghan.hpp"
#include "eos/constant_heat.hpp"
#include "eos/debye_heat.hpp"
#include "eos/hard_sphere_gas.hpp"
#include "eos/ideal_gas.hpp"
#include "eos/jwl.hpp"
#include "eos/jwlc.hpp"
#include "eos/knauss_sea_water.hpp"
#include "eos/linear_gruneisen.hpp"
#include "eos/mie_gruneisen.hpp"
#include "eos/murnaghan.hpp"
#include "eos/nasa7_heat.hpp"
#include "eos/noble_abel_stiffened_gas.hpp"
#include "eos/perfect_gas.hpp"
#include "eos/polynomial_heat.hpp"
#include "eos/stiffened_gas.hpp"
#include "eos/thomsen_hartka_water.hpp"
#include "eos/tillotson.hpp"
#include "eos/tst.hpp"

namespace sluice::eos {

// SI units: rho density, kg/m^3; x internal energy per volume, J/m^3, pressure, Pa, temperature, K,
// or specific heat, J/(kg K), as the function says. The slope of the shock speed over the particle
// speed (shock_slope), Grueneisen coefficients and ratios of specific heats have no unit.
template <class T>
concept Law = std::regular_invocable<decltype(&T::admissible), const T&, double, double> &&
              requires(const T& law, double rho, double x) {
                { law.pressure(rho, x) } -> std::same_as<double>;
                { law.dp_drho(rho, x) } -> std::same_as<double>;
                { law.dp_de(rho, x) } -> std::same_as<double>;
                { law.sound_speed_squared(rho, x) } -> std::same_as<double>;
                { law.bulk_modulus(rho, x) } -> std::same_as<double>;
                { law.sound_speed(rho, x) } -> std::same_as<double>;
                { law.temperature(rho, x) } -> std::same_as<double>;
                { law.energy_from_temperature(rho, x) } -> std::same_as<double>;
                { law.density(x, x) } -> std::same_as<double>;
                { law.shock_slope() } -> std::same_as<double>;
                { law.lowest_pressure() } -> std::same_as<double>;
                { law.highest_density() } -> std::same_as<double>;
                { law.admissible(rho, x) } -> std::same_as<bool>;
                { law.heat_capacity_ratio(rho, x, x, x) } -> std::same_as<double>;
                { T::name } -> std::convertible_to<std::string_view>;
                T::parameters().size();
                { T::depends_on_energy } -> std::convertible_to<bool>;
                { T::takes_any_heat } -> std::convertible_to<bool>;
              };

// Laws of which two temperatures may have one density and pressure: they may be told which side.
template <class T>
concept TwoTemperatures = requires(const T& law, double x) {
  { law.energy_from_pressure(x, x, x) } -> std::same_as<double>;
};

// rho c^2 (Pa) of a state with energy rho_e and pressure p.
template <Law T>
double modulus_of_state(const T& law, double rho, [[maybe_unused]] double rho_e,
                        [[maybe_unused]] double p) {
  if constexpr (TwoTemperatures<T>)
    return rho * law.sound_speed_squared(rho, rho_e);
  else
    return law.bulk_modulus(rho, p);
}

// All laws: the variant, the deck reader, texts, the reference page and the tests go through this
// list.
template <Law... Laws>
struct LawList {
  using Variant = std::variant<Laws...>;
  // f.operator()<Law>() of each in turn.
  template <class F>
  static void for_each(F&& f) {
    (f.template operator()<Laws>(), ...);
  }
};
using AllLaws =
    LawList<IdealGas, StiffenedGas, HardSphereGas, TstGas, Jwl, Jwlc, Murnaghan, BirchMurnaghan,
            MieGruneisen, LinearGruneisen, Tillotson, ThomsenHartkaWater, KnaussSeaWater,
            NobleAbelStiffenedGas, PerfectGas<Nasa7Heat>, PerfectGas<PolynomialHeat>>;
using EquationOfState = AllLaws::Variant;

// Does a deck name the law: <EOS type="name">.
template <Law T>
constexpr bool is_named_by_decks() {
  return T::parameters().size() > 0;
}

inline std::string_view name_of(const EquationOfState& law) {
  return std::visit([](const auto& l) { return std::decay_t<decltype(l)>::name; }, law);
}

// Fast path of kernels: laws with p = (gamma - 1) rho e and a constant specific heat offer
// themselves; of all others nothing.
inline const IdealGas* as_gamma_law(const EquationOfState& law) {
  return std::get_if<IdealGas>(&law);
}

// Fast path of the equilibration: p = G rho (e - q) - gamma_pi, G constant.
struct StiffenedForm {
  double G = 0, gamma = 0, pinf = 0, q = 0;  // 1, 1, Pa, J/kg
};
inline std::optional<StiffenedForm> as_stiffened(const EquationOfState& law) {
  if (const auto* gas = std::get_if<IdealGas>(&law))
    return StiffenedForm{gas->gamma - 1.0, gas->gamma, 0.0, 0.0};
  if (const auto* stiff = std::get_if<StiffenedGas>(&law))
    return StiffenedForm{stiff->gamma - 1.0, stiff->gamma, stiff->pinf, stiff->q};
  return std::nullopt;
}

using SpecificHeat = std::variant<ConstantHeat, DebyeHeat, Nasa7Heat, PolynomialHeat>;

// Laws whose p(rho, e) and cold curve do not know cv: any specific heat may stand beside them.
template <class T>
concept TakesAnyHeat = Law<T> && T::takes_any_heat;

template <TakesAnyHeat T, class Heat>
double temperature(const T& law, const Heat& heat, double rho, double rho_e) {
  return heat.temperature(law.thermal_energy(rho, rho_e));
}
template <TakesAnyHeat T, class Heat>
double energy_from_temperature(const T& law, const Heat& heat, double rho, double temperature) {
  return rho * (law.cold_energy(rho) + heat.energy(temperature));
}
template <TakesAnyHeat T, class Heat>
double density(const T& law, const Heat& heat, double p, double temperature) {
  return law.density_at_thermal_energy(p, heat.energy(temperature));
}

}  // namespace sluice::eos
