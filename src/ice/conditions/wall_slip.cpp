// Velocity and temperature of slip.
#include "ice/conditions/wall_slip.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "framework/base/error.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/conditions/face_conditions.hpp"

namespace sluice::ice {
namespace {

// C of lambda^2 u''; reflection: (2 - a)/a.
double second_coefficient(SlipSettings::Model model, double reflection) {
  switch (model) {
    case SlipSettings::Model::first_order:
      return 0.0;
    case SlipSettings::Model::deissler:
      return 9.0 / 8.0;
    case SlipSettings::Model::karniadakis_beskok:
      return -0.5 * reflection;
  }
  return 0.0;
}

}  // namespace

double mean_free_path(double viscosity, double rho, double p) {
  return viscosity * std::sqrt(0.5 * std::numbers::pi / (rho * p));
}

double slip_velocity(const SlipSettings& settings, const SlipCell& cell, bool creep) {
  const double a = settings.momentum_accommodation, reflection = (2.0 - a) / a;
  const double lambda = mean_free_path(cell.viscosity, cell.rho, cell.p);
  const double weight = 2.0 * lambda * reflection / cell.spacing;  // of u - u_s in L u'
  double known = cell.wall_velocity - second_coefficient(settings.model, reflection) * lambda *
                                          lambda * cell.pull / cell.viscosity;
  if (creep) known += 0.75 * cell.viscosity / (cell.rho * cell.temperature) * cell.warming;
  return (known + weight * cell.velocity) / (1.0 + weight);
}

double slip_temperature(const SlipSettings& settings, const SlipHeat& cell) {
  if (!(cell.viscosity > 0)) return cell.wall_temperature;
  const double a = settings.thermal_accommodation;
  const double gamma = 1.0 + cell.p / (cell.rho * cell.temperature * cell.specific_heat);
  const double in_cell = mean_free_path(cell.viscosity, cell.rho, cell.p);
  const double per_path = (2.0 - a) / a * 2.0 * cell.conductivity /
                          ((gamma + 1.0) * cell.specific_heat * cell.viscosity);
  double second = 0;
  if (settings.model == SlipSettings::Model::deissler)
    second = 9.0 / 128.0 * (177.0 * gamma - 145.0) / (gamma + 1.0);
  if (settings.model == SlipSettings::Model::karniadakis_beskok) second = -0.5 * per_path;
  const double curvature = -cell.viscosity / cell.conductivity * cell.shear;
  double T = cell.temperature;
  // The mean free path is that of T itself; each pass gains two digits.
  for (int pass = 0; pass < 4; ++pass) {
    const double lambda = in_cell * std::sqrt(T / cell.temperature);
    const double weight = 2.0 * lambda * per_path / cell.spacing;
    T = (cell.wall_temperature - second * lambda * lambda * curvature + weight * cell.temperature) /
        (1.0 + weight);
  }
  return T;
}

namespace {

TagSpec slip_tag() {
  return tag("microSlip", "rarefied gas at walls: conditions of kind slip and creep")
      .with_children(
          {tag("alpha_momentum",
               "accommodation coefficient of momentum: fraction of the molecules that leave with "
               "the wall's velocity")
               .once()
               .real()
               .above(0)
               .at_most(2),
           tag("alpha_temperature",
               "accommodation coefficient of energy: fraction of the molecules that leave with the "
               "wall's temperature")
               .once()
               .real()
               .above(0)
               .at_most(2),
           tag("CreepFlow", "thermal creep: gas flows along walls towards higher temperature")
               .boolean()
               .by_default("false"),
           tag("SlipModel", "model of the slip velocity")
               .attribute(
                   attribute("type",
                             "FirstOrder: from the gradient; the others: also from the curvature")
                       .words(
                           {"FirstOrder", "SecondOrder_Deissler", "SecondOrder_Karniadakis-Beskok"})
                       .by_default("FirstOrder"))});
}

template <bool with_creep>
void apply_slip(const Condition& c, int normal, const FlowConditions& settings, GhostRule& rule) {
  if (!settings.slip) throw_missing_block(c, "microSlip");
  if (c.variable == "Temperature") {
    rule.heat = {true, true, c.value, 0};
    return;
  }
  if (c.vector[normal] != 0)
    throw InputError(fmt::format(
        "{}: {} is for walls, but this velocity has the normal component {:g}; write 0 there",
        to_string(c.where), c.kind_name, c.vector[normal]));
  rule.velocity_kind = GhostRule::Velocity::slip;
  rule.creep = settings.slip->creep || with_creep;
  rule.waves = false;  // no wave passes a wall
}

SlipSettings read_slip(const DeckNode& block) {
  using Model = SlipSettings::Model;
  SlipSettings s;
  s.momentum_accommodation = block.real("alpha_momentum");
  s.thermal_accommodation = block.real("alpha_temperature");
  s.creep = boolean_or(block, "CreepFlow", s.creep);
  const DeckNode* model = block.child("SlipModel");
  const std::string type = model == nullptr ? "" : model->attribute("type").value_or("");
  if (type == "SecondOrder_Deissler") s.model = Model::deissler;
  if (type == "SecondOrder_Karniadakis-Beskok") s.model = Model::karniadakis_beskok;
  return s;
}

}  // namespace

FaceCondition slip_condition() {
  return {
      .word = "slip",
      .variables = {"Velocity", "Temperature"},
      .block = slip_tag(),
      .wall = true,
      .rarefied = true,
      .read_settings = [](const DeckNode& block, FlowConditions& c) { c.slip = read_slip(block); },
      .apply = apply_slip<false>};
}

// The row of slip reads the block of both.
FaceCondition creep_condition() {
  return {.word = "creep",
          .variables = {"Velocity"},
          .block = slip_tag(),
          .wall = true,
          .rarefied = true,
          .apply = apply_slip<true>};
}

}  // namespace sluice::ice
