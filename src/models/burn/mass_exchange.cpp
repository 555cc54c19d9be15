// Model "Test": its law, and how a deck says it.
#include "models/burn/mass_exchange.hpp"

#include <cmath>

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::models {

double MassExchange::share(double time, double dt) const {
  return -std::expm1(-rate * when.overlap(time, dt));
}

TagSpec mass_exchange_tag() {
  return tag("Test", "mass of one material is transferred to another at a constant rate")
      .with_children(
          {tag("fromMaterial", "name of the material that loses mass").once().text(),
           tag("toMaterial",
               "name of the material that receives it, with its momentum, energy and volume")
               .once()
               .text(),
           tag("rate", "fraction of the mass transferred per time, m' = -rate m")
               .once()
               .real()
               .at_least(0)
               .unit("1/time"),
           tag("startTime", "start time").real().at_least(0).unit("time").by_default("0")});
}

namespace {

MassExchange read_materials(const DeckNode& parameters, const MaterialNames& names) {
  MassExchange m;
  const Reactant reactant = read_reactant(parameters, names);
  m.from = reactant.from;
  m.to = reactant.to;
  m.where = parameters.where;
  return m;
}

}  // namespace

MassExchange read_mass_exchange(const DeckNode& parameters, const MaterialNames& names) {
  MassExchange m = read_materials(parameters, names);
  m.rate = parameters.real("rate");
  m.when.start = real_or(parameters, "startTime", 0);
  return m;
}

MassExchange read_jwlpp(const DeckNode& parameters, const MaterialNames& names) {
  MassExchange m = read_materials(parameters, names);
  m.by_pressure = read_jwlpp_law(parameters);
  return m;
}

namespace {

// A constant rate, in every cell.
class ConstantRateLaw final : public CellLaw {
 public:
  explicit ConstantRateLaw(MassExchange law) : law_(std::move(law)) {}
  double heat_of_reaction() const override { return 0; }
  bool depends_on_state() const override { return false; }
  double share(const CellState& /*cell*/, double time, double dt) const override {
    return law_.share(time, dt);
  }

 private:
  MassExchange law_;
};

class JwlPpLaw final : public CellLaw {
 public:
  explicit JwlPpLaw(const JwlPp& law) : law_(law) {}
  double heat_of_reaction() const override { return law_.heat; }
  bool depends_on_state() const override { return true; }
  double share(const CellState& cell, double /*time*/, double dt) const override {
    if (!law_.burns(cell.pressure, cell.volume_fraction)) return 0.0;
    return law_.burned(dt, cell.pressure, cell.reactant, cell.product) / cell.reactant;
  }

 private:
  JwlPp law_;
};

}  // namespace

std::shared_ptr<const BurnLaw> read_solid_exchange(const DeckNode& parameters,
                                                   const MaterialNames& names) {
  return std::make_shared<ConstantRateLaw>(read_mass_exchange(parameters, names));
}

std::shared_ptr<const BurnLaw> read_solid_jwlpp(const DeckNode& parameters,
                                                const MaterialNames& /*names*/) {
  return std::make_shared<JwlPpLaw>(read_jwlpp_law(parameters));
}

MassExchange read_light_time(const DeckNode& parameters, const MaterialNames& names) {
  MassExchange m = read_materials(parameters, names);
  m.by_front = read_light_time_law(parameters);
  return m;
}

}  // namespace sluice::models
