// A box of gas in the classic form, stepped by hand in this process.
#pragma once
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/deck/schema.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/ice.hpp"

namespace sluice::ice {

// What the deck says; formulas of x, y, z.
struct GasBox {
  IntVec3 cells{16, 1, 1};
  Vec3 low{0, 0, 0}, high{1, 1, 1};
  bool periodic = true;  // otherwise every side copies outward (walls: symmetry)
  bool walls = false;
  bool plates = false;  // sides at rest that hold the fluid
  std::string advection = "type='SecondOrder'";
  std::string density = "1", pressure = "1", velocity[3] = {"0", "0", "0"};
  double viscosity = 0, specific_heat = 1, cfl = 0.4;
  std::string gravity = "[0,0,0]", scheme = "classic";
  std::string models;  // the elements <Model> of the deck
};

inline std::string sides(const GasBox& box) {
  if (box.periodic) return {};
  std::string text = "<BoundaryConditions>";
  for (const char* side : {"x-", "x+", "y-", "y+", "z-", "z+"}) {
    const bool flat = box.cells[side[0] - 'x'] == 1;
    text += fmt::format("<Face side='{}'>", side);
    if (box.walls || flat) {
      text += "<BCType id='all' label='Symmetric' var='symmetry'/>";
    } else {
      for (const char* label : {"Pressure", "Density", "Temperature"})
        text += fmt::format("<BCType id='all' label='{}' var='Neumann'><value>0</value></BCType>",
                            label);
      text +=
          fmt::format("<BCType id='all' label='Velocity' var='{}'><value>[0,0,0]</value></BCType>",
                      box.plates ? "Dirichlet" : "Neumann");
    }
    text += "</Face>";
  }
  return text + "</BoundaryConditions>";
}

// A formula as XML text.
inline std::string escaped(const std::string& formula) {
  std::string text;
  for (const char c : formula) text += c == '<' ? std::string("&lt;") : std::string(1, c);
  return text;
}

inline std::string deck_text(const GasBox& b) {
  const std::string formula = fmt::format(
      "<customInitialization><formula><density>{}</density><pressure>{}</pressure>"
      "<velocity_x>{}</velocity_x><velocity_y>{}</velocity_y><velocity_z>{}</velocity_z></formula>"
      "</customInitialization>",
      escaped(b.density), escaped(b.pressure), escaped(b.velocity[0]), escaped(b.velocity[1]),
      escaped(b.velocity[2]));
  return fmt::format(
      "<Uintah_specification><SimulationComponent type='ice'/><Time><maxTime>1</maxTime>"
      "<initTime>0</initTime><delt_min>0</delt_min><delt_max>1</delt_max>"
      "<timestep_multiplier>1</timestep_multiplier></Time><Grid>{}<Level><Box><lower>[{:.17g},"
      "{:.17g},{:.17g}]</lower><upper>[{:.17g},{:.17g},{:.17g}]</upper>"
      "<resolution>[{},{},{}]</resolution></Box>{}</Level></Grid>"
      "<DataArchiver><filebase>box.uda</filebase><outputInterval>1</outputInterval><save "
      "label='rho_CC'/></DataArchiver>"
      "<CFD><cfl>{}</cfl><ICE><scheme>{}</scheme><advection {}/>{}</ICE></CFD>"
      "<PhysicalConstants><gravity>{}</gravity><reference_pressure>1</reference_pressure>"
      "</PhysicalConstants><MaterialProperties><ICE><material name='gas'><EOS type='ideal_gas'/>"
      "<dynamic_viscosity>{}</dynamic_viscosity><thermal_conductivity>0</thermal_conductivity>"
      "<specific_heat>{}</specific_heat><gamma>1.4</gamma><geom_object><box>"
      "<min>[-99,-99,-99]</min><max>[99,99,99]</max></box><velocity>[0,0,0]</velocity>"
      "<density>1</density><temperature>1</temperature></geom_object></material></ICE>"
      "</MaterialProperties>{}</Uintah_specification>",
      sides(b), b.low.x, b.low.y, b.low.z, b.high.x, b.high.y, b.high.z, b.cells.x, b.cells.y,
      b.cells.z, b.periodic ? "<periodic>[1,1,1]</periodic>" : "", b.cfl, b.scheme, b.advection,
      formula, b.gravity, b.viscosity, b.specific_heat,
      b.models.empty() ? "" : "<Models>" + b.models + "</Models>");
}

// Shared by the runs of a test: a process has one at a time.
inline std::shared_ptr<RunControl> shared_control() {
  static std::weak_ptr<RunControl> kept;
  std::shared_ptr<RunControl> control = kept.lock();
  if (control == nullptr) kept = control = std::make_shared<RunControl>();
  return control;
}

// A deck, its scene, and its gas, which keeps a pointer to the scene.
struct DeckScene {
  Deck deck;
  Scene scene;
  std::unique_ptr<Ice> ice;

  // Throws InputError with the first error of the deck.
  explicit DeckScene(const std::string& text, IntVec3 boxes = {}) {
    Schema schema;
    add_framework_tags(schema);
    add_ice_tags(schema);
    deck = load_deck_text(text, "box.ups", {}, schema);
    std::vector<Fault> faults = deck.faults;
    SceneOptions options;
    options.boxes = boxes;
    if (deck.good()) scene = read_scene(deck, options, faults);
    IceScene ice_scene;
    if (!any_error(faults)) ice_scene = read_ice_scene(deck, scene, faults);
    for (const Fault& f : faults)
      if (f.severity == Severity::error) throw InputError(to_string(f));
    ice = std::make_unique<Ice>(scene, std::move(ice_scene));
  }
  DeckScene(const DeckScene&) = delete;
  DeckScene& operator=(const DeckScene&) = delete;
};

// A deck's gas and a solver at the start.
class Stepper {
 public:
  explicit Stepper(const GasBox& box, const SolverOptions& options = {}, IntVec3 boxes = {})
      : scene_(deck_text(box), boxes) {
    solver_ = std::make_unique<LevelSolver>(ice(), level(), world(), options);
    scene_.ice->state().initialise(solver_->state());
  }

  // One step that must be admissible.
  void step(double dt) {
    if (attempt(dt).faults > 0) throw PhysicsError("inadmissible step");
    solver_->advance();
    solver_->accept();
    time_ += dt;
  }
  const StepAttempt& attempt(double dt) {
    solver_->fill_ghosts(time_);
    return solver_->attempt(time_, dt, {}, control_.get());
  }

  double mass(IntVec3 cell) const { return value(labels().mass, 0, cell); }
  double energy(IntVec3 cell) const { return value(labels().energy, 0, cell); }  // per volume
  double momentum(IntVec3 cell, int c) const { return value(labels().momentum, c, cell); }
  double velocity(IntVec3 cell, int c = 0) const { return momentum(cell, c) / mass(cell); }
  double& value_at(Label label, IntVec3 cell) { return view(label, 0, cell)(cell); }
  double pressure(IntVec3 cell) const { return gas.pressure(mass(cell), energy(cell)); }
  double& mass_at(IntVec3 cell) { return view(labels().mass, 0, cell)(cell); }
  double& energy_at(IntVec3 cell) { return view(labels().energy, 0, cell)(cell); }
  double& momentum_at(IntVec3 cell, int c) { return view(labels().momentum, c, cell)(cell); }

  const Level& level() const { return scene_.scene.grid.levels.front(); }
  const IndexBox& domain() const { return level().domain; }
  double time() const { return time_; }
  const Ice& ice() const { return *scene_.ice; }
  LevelSolver& solver() { return *solver_; }

  eos::IdealGas gas;

 protected:
  void pass(double dt) { time_ += dt; }

 private:
  static bool any_error(const std::vector<Fault>& faults) {
    for (const Fault& f : faults)
      if (f.severity == Severity::error) return true;
    return false;
  }
  RealView view(Label label, int component, IntVec3 cell) const {
    const Warehouse& state = solver_->state();
    const int slot = state.find(label, 0);
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      if (state.local_boxes()[b].cells.contains(cell)) return state.view(slot, component, b);
    throw std::logic_error("no box holds the cell");
  }
  double value(Label label, int component, IntVec3 cell) const {
    return view(label, component, cell)(cell);
  }

  DeckScene scene_;
  std::unique_ptr<LevelSolver> solver_;
  std::shared_ptr<RunControl> control_ = shared_control();
  double time_ = 0;
};

}  // namespace sluice::ice
