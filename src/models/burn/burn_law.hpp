// A law by which a solid becomes a fluid: everything that the coupled step, the particles and the
// outputs must know of it.
//
// A law has one of three forms, by where mass leaves the solid: over surfaces that face the fluid
// (SurfaceLaw), throughout a cell (CellLaw), or in the order of an explosive that detonates, burns
// at its surface and in its cracks (Ddt1). A new law derives from one of the first two in a file of
// its own, and has a row in model_table.cpp; what it leaves undefined does not compile.
#pragma once
#include <string>
#include <vector>

#include "framework/scene/output_switch.hpp"

namespace sluice::models {

struct Ddt1;
class SurfaceLaw;
class CellLaw;

// The state of a surface that burns.
struct BurningSurface {
  double temperature = 0;  // T_s, K
  double flux = 0;         // of mass, kg/(m^2 s); 0: the surface does not burn
};

// The fluid at a piece of surface, and the particle behind it.
struct AtSurface {
  double pressure = 0;           // of the fluid, Pa
  double hottest = 0;            // temperature, of the fluid there and the particle, K
  double solid_temperature = 0;  // of the particle, K
  double density = 0;            // of the particle, kg/m^3
};

// What a surface remembers. At first what decks of the format expect of one that has not burned.
struct SurfaceHistory {
  static constexpr double unlit_gradient = 1e12;
  double temperature = 300;          // T_s, K
  double gradient = unlit_gradient;  // beta, K/m

  bool lit() const { return gradient < unlit_gradient; }
};

// A cell in which a solid burns.
struct CellState {
  double pressure = 0;         // of solid and fluid together, Pa
  double volume_fraction = 0;  // of the solid
  double reactant = 0;         // mass of the solid per volume of the cell, kg/m^3
  double product = 0;          // likewise of the fluid that it becomes, kg/m^3
};

// A field of the cells in which a law burns, that a deck can save.
enum class BurningValue {
  burns,        // 1 where a surface burns
  temperature,  // of the surfaces, K
  gradient,     // of the temperature in the solid, K/m
  detonates,    // of Ddt1, from here on
  kind,
  delay,
  waited,
  share,
  gain
};
struct BurningOutput {
  BurningValue value = BurningValue::burns;
  std::string label;  // the name in a deck
};

// What the particles of the solid carry for a law.
struct BurningMemory {
  bool surface = false;  // SurfaceHistory
  bool flame = false;    // Ignition (ddt1.hpp)
};

// The three ways in which the coupled step takes mass from particles; each returns whether any
// particle of any rank has burned.
class BurningForms {
 public:
  virtual ~BurningForms() = default;
  virtual bool burn_surfaces(const SurfaceLaw& law) = 0;
  virtual bool burn_cells(const CellLaw& law) = 0;
  virtual bool burn_explosive(const Ddt1& law) = 0;
};

class BurnLaw {
 public:
  virtual ~BurnLaw() = default;
  // Calls the form that the law has.
  virtual bool burn(BurningForms& step) const = 0;
  // Heat that the product gets, in addition to what the mass brings with it, J/kg.
  virtual double heat_of_reaction() const = 0;
  // The fluids that it makes; `product`: the one that the deck names by <toMaterial>.
  virtual std::vector<int> products(int product) const = 0;
  virtual BurningMemory memory() const = 0;
  virtual std::vector<BurningOutput> outputs() const = 0;
  // Other intervals of outputs, each once, in the order in which the step asks for them.
  virtual std::vector<OutputSwitch> output_switches() const = 0;
  // Whether the solid's constitutive model must have cracks (p.crackRad).
  virtual bool burns_cracks() const = 0;
};

// A flux that follows changes of pressure with a delay.
class SurfaceDelay {
 public:
  virtual ~SurfaceDelay() = default;
  // What the surface remembers after dt (s); one that has not burned begins with the steady state.
  virtual SurfaceHistory after(double dt, const SurfaceHistory& before,
                               const BurningSurface& steady, double solid_temperature,
                               double density) const = 0;
  // Mass flux then, kg/(m^2 s).
  virtual double flux(const SurfaceHistory& now, double steady_flux, double density) const = 0;
};

class SurfaceLaw : public BurnLaw {
 public:
  bool burn(BurningForms& step) const final { return step.burn_surfaces(*this); }
  std::vector<int> products(int product) const final { return {product}; }
  BurningMemory memory() const final { return {.surface = delay() != nullptr}; }
  std::vector<OutputSwitch> output_switches() const final { return {}; }
  bool burns_cracks() const final { return false; }

  // Whether the fluid of the cells around counts as hot too, and not only where the cell has
  // little.
  virtual bool looks_around() const = 0;
  // The surface at a steady pressure.
  virtual BurningSurface steady_surface(const AtSurface& at) const = 0;
  // Null: the flux is the steady one.
  virtual const SurfaceDelay* delay() const = 0;
};

class CellLaw : public BurnLaw {
 public:
  bool burn(BurningForms& step) const final { return step.burn_cells(*this); }
  std::vector<int> products(int product) const final { return {product}; }
  BurningMemory memory() const final { return {}; }
  std::vector<BurningOutput> outputs() const final { return {}; }
  std::vector<OutputSwitch> output_switches() const final { return {}; }
  bool burns_cracks() const final { return false; }

  // Whether the share depends on the state of a cell: finding that state costs time.
  virtual bool depends_on_state() const = 0;
  // Share of the solid's mass that burns from `time` to time + dt (s).
  virtual double share(const CellState& cell, double time, double dt) const = 0;
};

}  // namespace sluice::models
