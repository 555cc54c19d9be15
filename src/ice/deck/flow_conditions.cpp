// Reading them; the schema has checked the values.
#include "ice/deck/flow_conditions.hpp"

#include <cmath>

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::ice {
namespace {

std::optional<double> real_of(const DeckNode& node, std::string_view name) {
  const DeckNode* child = node.child(name);
  return child != nullptr ? std::optional(child->as_real()) : std::nullopt;
}

LodiSettings read_lodi(const DeckNode& node) {
  LodiSettings s;
  s.press_infinity = node.real("press_infinity");
  s.sigma = real_or(node, "sigma", s.sigma);
  s.scale = real_or(node, "Li_scale", s.scale);
  if (node.child("vel_infinity") != nullptr)
    s.velocity_infinity = vector_or(node, "vel_infinity", {});
  s.rho_infinity = real_of(node, "rho_infinity");
  s.where = node.where;
  return s;
}

SineSettings read_sine(const DeckNode& node) {
  SineSettings s;
  s.omega = node.real("omega");
  s.amplitude = node.real("A");
  s.reference_pressure = node.real("reference_pressure");
  s.reference_velocity = vector_or(node, "reference_velocity", {});
  return s;
}

InletProfile read_profile(const DeckNode& node) {
  InletProfile s;
  s.vertical = integer_or(node, "verticalDirection", s.vertical);
  s.exponent = real_or(node, "exponent", s.exponent);
  s.height = real_of(node, "maxHeight");
  s.roughness = real_or(node, "roughness", s.roughness);
  s.von_karman = real_or(node, "vonKarmanConstant", s.von_karman);
  return s;
}

SlipSettings read_slip(const DeckNode& node) {
  using Model = SlipSettings::Model;
  SlipSettings s;
  s.momentum_accommodation = node.real("alpha_momentum");
  s.thermal_accommodation = node.real("alpha_temperature");
  s.creep = boolean_or(node, "CreepFlow", s.creep);
  const DeckNode* model = node.child("SlipModel");
  const std::string type = model == nullptr ? "" : model->attribute("type").value_or("");
  if (type == "SecondOrder_Deissler") s.model = Model::deissler;
  if (type == "SecondOrder_Karniadakis-Beskok") s.model = Model::karniadakis_beskok;
  return s;
}

}  // namespace

TravellingVortices::Flow TravellingVortices::at(Vec3 x, double time, double rho,
                                                double viscosity) const {
  const double X = x.x - time, Y = x.y - time, decay = std::exp(-2.0 * viscosity / rho * time);
  const double A = amplitude * decay;
  return {1.0 - A * std::cos(X) * std::sin(Y), 1.0 + A * std::sin(X) * std::cos(Y),
          reference_pressure - 0.25 * rho * A * A * (std::cos(2.0 * X) + std::cos(2.0 * Y))};
}

FlowConditions read_flow_conditions(const DeckNode& root) {
  FlowConditions c;
  const DeckNode* exact = root.find("CFD/ICE/customInitialization/manufacturedSolution");
  const DeckNode* constants = root.child("PhysicalConstants");
  if (exact != nullptr && exact->attribute("type") == "mms_1" && constants != nullptr)
    c.vortices = {real_or(*exact, "A", 1.0), real_or(*constants, "reference_pressure", 0.0)};
  const DeckNode* conditions = root.find("Grid/BoundaryConditions");
  if (conditions == nullptr) return c;
  if (const DeckNode* lodi = conditions->child("LODI")) c.lodi = read_lodi(*lodi);
  if (const DeckNode* sine = conditions->child("SINE_BC")) c.sine = read_sine(*sine);
  if (const DeckNode* profile = conditions->child("inletVelocity"))
    c.profile = read_profile(*profile);
  if (const DeckNode* slip = conditions->child("microSlip")) c.slip = read_slip(*slip);
  return c;
}

}  // namespace sluice::ice
