#include "ice/conditions/sine.hpp"

#include <cmath>

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/conditions/face_conditions.hpp"

namespace sluice::ice {

double SineFlow::swing(double time) const {
  return s_.amplitude * std::sin(s_.omega * time);
}

Vec3 SineFlow::velocity(const GhostPlace& at, Vec3 /*value*/, double /*rho*/) const {
  Vec3 u = s_.reference_velocity;
  const double more = swing(at.time + at.arrival);
  for (int n = 0; n < 3; ++n) u[n] += u[n] == 0 ? 0.0 : more;
  return u;
}

double SineFlow::pressure(const GhostPlace& at, double /*rho*/) const {
  return s_.reference_pressure + swing(at.time + at.arrival);
}

double SineFlow::on_face(int direction, Vec3 /*value*/, double /*in_ghost*/, double time) const {
  const double mean = s_.reference_velocity[direction];
  return mean == 0 ? 0.0 : mean + swing(time);
}

namespace {

TagSpec sine_tag() {
  return tag("SINE_BC", "conditions of kind Sine: reference + A sin(omega t)")
      .with_children(
          {tag("omega", "angular frequency").once().real().at_least(0).unit("1/time"),
           tag("A", "amplitude, of the pressure and of the velocity").once().real(),
           tag("reference_pressure", "mean pressure").once().real().above(0).unit("pressure"),
           tag("reference_velocity", "mean velocity; components that are zero stay zero")
               .vector()
               .by_default("[0,0,0]")});
}

std::shared_ptr<const PrescribedFlow> read_sine(const DeckNode& root) {
  const DeckNode* node = root.find("Grid/BoundaryConditions/SINE_BC");
  if (node == nullptr) return nullptr;
  SineSettings s;
  s.omega = node->real("omega");
  s.amplitude = node->real("A");
  s.reference_pressure = node->real("reference_pressure");
  s.reference_velocity = vector_or(*node, "reference_velocity", {});
  return std::make_shared<SineFlow>(s);
}

}  // namespace

// The temperature follows from pressure and density.
FaceCondition sine_condition() {
  return {.word = "Sine",
          .variables = {"Pressure", "Temperature", "Velocity"},
          .block = sine_tag(),
          .read_flow = read_sine,
          .apply = apply_flow};
}

}  // namespace sluice::ice
