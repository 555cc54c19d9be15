// Reading the ICE blocks of a deck that the schema has checked.
#include "ice/ice_scene.hpp"

#include <fmt/format.h>

namespace sluice::ice {
namespace {

Location place(const DeckNode* node) {
  return node != nullptr ? node->where : Location{};
}

std::optional<std::string> formula_text(const DeckNode& formula, std::string_view name) {
  const DeckNode* child = formula.child(name);
  if (child == nullptr || child->text.empty()) return std::nullopt;
  return child->text;
}

std::optional<FormulaFill> read_formula(const DeckNode* ice) {
  const DeckNode* node = ice != nullptr ? ice->find("customInitialization/formula") : nullptr;
  if (node == nullptr) return std::nullopt;
  FormulaFill fill;
  fill.where = node->where;
  fill.density = formula_text(*node, "density");
  fill.pressure = formula_text(*node, "pressure");
  fill.temperature = formula_text(*node, "temperature");
  constexpr const char* velocities[] = {"velocity_x", "velocity_y", "velocity_z"};
  for (std::size_t d = 0; d < 3; ++d) fill.velocity[d] = formula_text(*node, velocities[d]);
  return fill;
}

IceMaterial read_material(const DeckNode& node, int index, const GeometryReader& geometry,
                          std::vector<Fault>& faults) {
  IceMaterial m;
  m.index = index;
  m.name = node.attribute("name").value_or("");
  m.where = node.where;
  m.fluid = ideal_gas(node.real("gamma"), node.real("specific_heat"));
  m.viscosity = node.real("dynamic_viscosity");
  m.viscosity_where = place(node.child("dynamic_viscosity"));
  for (const DeckNode* object : node.all("geom_object"))
    m.objects.push_back(geometry.object(*object, faults));
  return m;
}

void read_numerics(const DeckNode& cfd, IceScene& s) {
  s.cfl = cfd.real("cfl");
  s.cfl_where = place(cfd.child("cfl"));
  const DeckNode* ice = cfd.child("ICE");
  if (ice == nullptr) return;
  if (const DeckNode* scheme = ice->child("scheme")) {
    s.classic = scheme->text == "classic";
    s.scheme_where = scheme->where;
  }
  if (const DeckNode* advection = ice->child("advection")) {
    s.second_order = advection->attribute("type").value_or("SecondOrder") == "SecondOrder";
    s.compatible_fluxes = advection->attribute("useCompatibleFluxes").value_or("true") == "true";
    s.advection_where = advection->where;
  }
  if (const DeckNode* h = ice->child("applyHydrostaticPressure"))
    s.hydrostatic_start = h->as_boolean();
  if (const DeckNode* control = ice->child("TimeStepControl")) {
    if (const DeckNode* n = control->child("Scheme_for_delT_calc"))
      s.conservative_time_step = n->text == "conservative";
    if (const DeckNode* n = control->child("knob_for_speedSound"))
      s.sound_speed_knob = n->as_real();
    if (const DeckNode* n = control->child("knob_for_diffusion")) s.diffusion_knob = n->as_real();
  }
  s.formula = read_formula(ice);
}

// `all` materials: one criterion each.
void read_criteria(const DeckNode& root, IceScene& s) {
  const DeckNode* list = root.find("AMR/ICE/Refinement_Criteria_Thresholds");
  if (list == nullptr) return;
  for (const DeckNode* v : list->all("Variable")) {
    RefinementCriterion c;
    c.label = v->attribute("name").value_or("");
    c.value = std::stod(v->attribute("value").value_or("0"));
    const std::string material = v->attribute("matl").value_or("all");
    for (const IceMaterial& m : s.materials) {
      c.material = m.index;
      if (material == "all" || std::stoi(material) == m.index) s.criteria.push_back(c);
    }
  }
}

}  // namespace

IceScene read_ice_scene(const Deck& deck, const Scene& scene, std::vector<Fault>& faults) {
  IceScene s;
  const DeckNode& root = *deck.root;
  if (const DeckNode* cfd = root.child("CFD")) read_numerics(*cfd, s);
  const GeometryReader geometry(root, faults);
  if (const DeckNode* ice = root.find("MaterialProperties/ICE"))
    for (const DeckNode* node : ice->all("material"))
      s.materials.push_back(
          read_material(*node, static_cast<int>(s.materials.size()), geometry, faults));
  if (s.materials.size() != 1)
    faults.push_back(
        {Severity::error, place(root.find("MaterialProperties")),
         fmt::format("{} ICE materials; exactly one is built so far", s.materials.size()), ""});
  if (const DeckNode* x = root.find("MaterialProperties/exchange_properties")) {
    s.exchange_written = true;
    s.exchange_where = x->where;
  }
  read_criteria(root, s);
  s.gravity_where = scene.constants.gravity_where;
  return s;
}

}  // namespace sluice::ice
