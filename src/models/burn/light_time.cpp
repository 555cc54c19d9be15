// Model "LightTime": how a deck says it.
#include "models/burn/light_time.hpp"

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::models {

TagSpec light_time_tag() {
  return tag("LightTime", "a prescribed detonation: a front of given speed burns the explosive")
      .with_children(
          {tag("fromMaterial", "name of the explosive, a fluid").once().text(),
           tag("toMaterial", "name of the fluid that the reaction products form").once().text(),
           tag("starting_location", "position of the front at time 0")
               .once()
               .vector()
               .unit("length"),
           tag("direction_if_plane", "normal of a plane front; zero: the front starts at a point")
               .vector()
               .by_default("[0, 0, 0]"),
           tag("D", "speed of the front").once().real().above(0).unit("velocity"),
           tag("E0", "heat of the reaction per mass, given to the product")
               .once()
               .real()
               .unit("energy/mass"),
           tag("rho0", "accepted without effect").real().unit("density"),
           tag("react_mixed_cells",
               "whether cells with other materials burn too; false: only cells filled to 0.99 by "
               "explosive and products")
               .boolean()
               .by_default("true")});
}

Label front_gradient_label() {
  return declare_label({"mag_grad_Fr", ValueType::real, Centring::cell, "1/m",
                        "Magnitude of the gradient of F, of the model LightTime."});
}

LightTime read_light_time_law(const DeckNode& parameters) {
  LightTime m;
  m.front = detonation_front(parameters.vector("starting_location"),
                             vector_or(parameters, "direction_if_plane", {}));
  m.D = parameters.real("D");
  m.heat = parameters.real("E0");
  m.in_mixed_cells = boolean_or(parameters, "react_mixed_cells", true);
  return m;
}

}  // namespace sluice::models
