// Model "DDT1": how a deck says it.
#include "models/burn/ddt1.hpp"

#include <fmt/format.h>

#include "framework/base/infinity.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "models/deck/material_name.hpp"

namespace sluice::models {
namespace {

TagSpec intervals(TagSpec of) {
  const auto interval = [](const char* name, const char* text) {
    return tag(name, text).once().real().above(0).unit("time");
  };
  return of.child(interval("newOutputInterval", "interval of outputs after the event"))
      .child(interval("newCheckPointInterval", "interval of checkpoints after the event"));
}

TagSpec intervals_tag() {
  return tag("adjust_IO_intervals",
             "other intervals of outputs and checkpoints after an event, each once")
      .child(
          intervals(tag("PressureSwitch",
                        "intervals from the time when the pressure in a cell with explosive "
                        "exceeds a threshold")
                        .child(tag("PressureThreshold", "pressure above which the intervals change")
                                   .once()
                                   .real()
                                   .above(0)
                                   .unit("pressure"))))
      .child(intervals(
          tag("DetonationDetected", "intervals from the time when explosive detonates in any cell")
              .child(tag("remainingTimesteps",
                         "the run ends this number of steps later; 0: the end of the "
                         "run is not changed")
                         .integer()
                         .at_least(0)
                         .by_default("0"))));
}

constexpr const char* of_flames[] = {"IgnitionConst", "PressureShift", "PreexpoConst",
                                     "ExponentialConst"};

OutputSwitch read_intervals(const DeckNode& node) {
  OutputSwitch to;
  to.output_interval = node.real("newOutputInterval");
  to.checkpoint_interval = node.real("newCheckPointInterval");
  if (node.child("remainingTimesteps") != nullptr)
    to.remaining_steps = node.integer("remainingTimesteps");
  return to;
}

}  // namespace

TagSpec ddt1_tag() {
  const auto detonation = [](const char* name, const char* text) {
    return tag(name, text).once().real().at_least(0);
  };
  const auto flame = [](const char* name, const char* text) {
    return tag(name, std::string(text) + "; with <useInductionTime>").real();
  };
  return tag("DDT1",
             "explosive that burns at surfaces and in cracks, or detonates, depending on the "
             "pressure")
      .with_children(surface_and_flame_tags("ThresholdPressureSB"))
      .with_children(
          {tag("burnMaterial",
               "name of the fluid that burning surfaces produce; absent: that of <toMaterial>")
               .text(),
           detonation("ThresholdPressureJWL", "detonates above this pressure instead of burning")
               .unit("pressure"),
           tag("ThresholdVolFrac", "detonates where it fills more than this fraction of a cell")
               .real()
               .at_least(0)
               .at_most(1)
               .by_default("0"),
           detonation("G", "rate of the detonation, with the pressure in the deck's units"),
           detonation("b", "exponent of the pressure in this rate"),
           tag("E0", "heat of the detonation per mass, given to the product")
               .once()
               .real()
               .unit("energy/mass"),
           tag("useCrackModel",
               "cracked explosive burns next to hot gas; its law must have cracks (visco_scram)")
               .boolean()
               .by_default("false"),
           tag("Gcrack", "accepted without effect").real(),
           tag("nCrack", "accepted without effect").real(),
           tag("CrackVolThreshold",
               "fluid that fills no more than this fraction of a cell does not ignite cracks")
               .real()
               .at_least(0)
               .at_most(1)
               .by_default("1e-14"),
           tag("CrackConstant",
               "cracks of radius a burn where a^2 p^n is above it; in the deck's units")
               .real()
               .above(0)
               .by_default("8e8"),
           tag("CrackExponent", "n").real().above(0).by_default("2.84"),
           tag("CrackSpacing", "volume of explosive divided by the area of its crack walls")
               .real()
               .above(0)
               .unit("length")
               .by_default("0.002"),
           tag("useInductionTime", "flames have an induction time").boolean().by_default("false"),
           flame("IgnitionConst", "fraction I of the path for a flame normal to the surface")
               .above(0)
               .at_most(1),
           flame("PressureShift", "pressure of the speed of flames, p_0").above(0).unit("pressure"),
           flame("PreexpoConst", "speed of flames at that pressure, F_b").above(0).unit("velocity"),
           flame("ExponentialConst", "exponent of the pressure in it, F_c").at_least(0),
           intervals_tag()});
}

void check_ddt1(const DeckNode& parameters, const MaterialNames& names,
                std::vector<Fault>& faults) {
  check_solid_reactant(parameters, names, faults);
  if (const DeckNode* burned = parameters.child("burnMaterial")) {
    const auto to = check_material(parameters, "burnMaterial", names.all(), faults);
    if (to && *to < static_cast<int>(names.solids.size()))
      add_error(faults, burned->where,
                "<burnMaterial> is a solid: the product of a model is a fluid",
                "name a material of <ICE>");
  }
  if (boolean_or(parameters, "useInductionTime", false))
    for (const char* name : of_flames)
      if (parameters.child(name) == nullptr)
        add_error(faults, parameters.where,
                  fmt::format("<DDT1> with <useInductionTime> needs <{}>", name),
                  fmt::format("add <{}>", name));
  const double surfaces = real_or(parameters, "ThresholdPressureSB", 0),
               detonation = real_or(parameters, "ThresholdPressureJWL", infinity);
  if (surfaces > detonation)
    add_error(
        faults, parameters.child("ThresholdPressureSB")->where,
        fmt::format("<ThresholdPressureSB> {:g} is above <ThresholdPressureJWL> {:g}: nothing "
                    "would burn before it detonates",
                    surfaces, detonation),
        "burning begins at the smaller pressure");
}

namespace {

class Ddt1Law final : public BurnLaw {
 public:
  explicit Ddt1Law(Ddt1 law) : law_(std::move(law)) {}
  bool burn(BurningForms& step) const override { return step.burn_explosive(law_); }
  // Of what detonates; what burns has the heat of the flame.
  double heat_of_reaction() const override { return law_.detonation.heat; }
  std::vector<int> products(int product) const override {
    if (law_.surface_product == product) return {product};
    return {product, law_.surface_product};
  }
  BurningMemory memory() const override { return {.flame = law_.spread.has_value()}; }
  std::vector<BurningOutput> outputs() const override {
    return {{BurningValue::detonates, "detonating"},
            {BurningValue::kind, "burning"},
            {BurningValue::share, "F"},
            {BurningValue::gain, "delF"},
            {BurningValue::delay, "inductionTime"},
            {BurningValue::waited, "countTime"}};
  }
  std::vector<OutputSwitch> output_switches() const override {
    std::vector<OutputSwitch> all;
    for (const Ddt1::Switch& s : law_.switches) all.push_back(s.to);
    return all;
  }
  bool burns_cracks() const override { return law_.cracks; }

 private:
  Ddt1 law_;
};

}  // namespace

std::shared_ptr<const BurnLaw> read_ddt1(const DeckNode& parameters, const MaterialNames& names) {
  Ddt1 m;
  m.flame = read_surface_and_flame(parameters, "ThresholdPressureSB");
  m.detonation.threshold_pressure = parameters.real("ThresholdPressureJWL");
  m.detonation.min_volume_fraction = real_or(parameters, "ThresholdVolFrac", 0);
  m.detonation.max_burned = 1;
  m.detonation.G = parameters.real("G");
  m.detonation.b = parameters.real("b");
  m.detonation.heat = parameters.real("E0");
  const char* burned = parameters.child("burnMaterial") != nullptr ? "burnMaterial" : "toMaterial";
  m.surface_product =
      read_material(parameters, burned, names.all()) - static_cast<int>(names.solids.size());
  m.cracks = boolean_or(parameters, "useCrackModel", false);
  m.crack_constant = real_or(parameters, "CrackConstant", m.crack_constant);
  m.crack_power = real_or(parameters, "CrackExponent", m.crack_power);
  m.crack_spacing = real_or(parameters, "CrackSpacing", m.crack_spacing);
  m.seen_in_cracks = real_or(parameters, "CrackVolThreshold", m.seen_in_cracks);
  if (boolean_or(parameters, "useInductionTime", false))
    m.spread = FlameSpread{parameters.real("IgnitionConst"), parameters.real("PreexpoConst"),
                           parameters.real("PressureShift"), parameters.real("ExponentialConst")};
  if (const DeckNode* adjust = parameters.child("adjust_IO_intervals")) {
    if (const DeckNode* node = adjust->child("PressureSwitch"))
      m.switches.push_back({node->real("PressureThreshold"), read_intervals(*node)});
    if (const DeckNode* node = adjust->child("DetonationDetected"))
      m.switches.push_back({0, read_intervals(*node)});
  }
  return std::make_shared<Ddt1Law>(std::move(m));
}

}  // namespace sluice::models
