// The table of constitutive models, and how an element of a deck becomes a law.
#include "mpm/material/materials.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/schema_check.hpp"
#include "mpm/material/failure/failure.hpp"

namespace sluice::mpm {

// Each in the file of its name.
using Describe = MaterialModel();
Describe rigid_model, comp_neo_hook_model, comp_neo_hook_plastic_model, UCNH_model, cnh_mms_model,
    comp_mooney_rivlin_model, hypo_elastic_model, elastic_plastic_model, elastic_plastic_hp_model,
    rf_elastic_plastic_model, visco_scram_model, trans_iso_hyper_model, visco_trans_iso_hyper_model,
    ideal_gas_model, water_model, murnaghanMPM_model, jwlpp_mpm_model, MohrCoulomb_model,
    Arenisca_model, Arenisca3_model, Arenisca4_model, ArenaSoil_model, program_burn_model,
    mw_visco_elastic_model, p_alpha_model, ArrudaBoyce8_model, TH_water_model;

const std::vector<MaterialModel>& material_models() {
  static const std::vector<MaterialModel> table = {
      rigid_model(),
      comp_neo_hook_model(),
      comp_neo_hook_plastic_model(),
      UCNH_model(),
      cnh_mms_model(),
      comp_mooney_rivlin_model(),
      hypo_elastic_model(),
      elastic_plastic_model(),
      elastic_plastic_hp_model(),
      rf_elastic_plastic_model(),
      visco_scram_model(),
      trans_iso_hyper_model(),
      visco_trans_iso_hyper_model(),
      ideal_gas_model(),
      water_model(),
      murnaghanMPM_model(),
      jwlpp_mpm_model(),
      MohrCoulomb_model(),
      Arenisca_model(),
      Arenisca3_model(),
      Arenisca4_model(),
      ArenaSoil_model(),
      program_burn_model(),
      mw_visco_elastic_model(),
      p_alpha_model(),
      ArrudaBoyce8_model(),
      TH_water_model(),
  };
  return table;
}

namespace {

// Known to the format.
const std::vector<std::string> models_not_supported = {"HypoplasticB",
                                                       "Kelvin_Voigt",
                                                       "Maxwell_Weichert",
                                                       "QADamage",
                                                       "SVK",
                                                       "TongeRameshPTR",
                                                       "TransIsoHypoFrictional",
                                                       "UCNHVar",
                                                       "VUMAT",
                                                       "camclay",
                                                       "ceramic_fiber_damage",
                                                       "diamm",
                                                       "gao_elastic",
                                                       "hypo_elastic_fortran",
                                                       "kayenta",
                                                       "membrane",
                                                       "nonlocal_drucker_prager",
                                                       "shell_CNH",
                                                       "soil_foam",
                                                       "tabular_plasticity",
                                                       "three_factor_mooney",
                                                       "visco_plastic"};
// Tags that decks give to models which never read them.
const std::vector<std::string> laws_never_read = {"strain_limit",
                                                  "reduction_factor",
                                                  "yield_stress",
                                                  "hardening_modulus",
                                                  "isothermal",
                                                  "useTaylorSeriesForDefGrad",
                                                  "num_taylor_terms",
                                                  "coeff_thermal_expansion",
                                                  "G",
                                                  "K",
                                                  "use_polar_decomposition_RMB",
                                                  "StrainEnergy",
                                                  "shear_modulus",
                                                  "bulk_modulus",
                                                  "alpha"};

// Of the attribute `type`.
AttributeSpec type_attribute() {
  std::vector<std::string> types;
  AttributeSpec spec = attribute("type", "which one").once();
  for (const MaterialModel& model : material_models()) types.push_back(model.name);
  spec = spec.words(types).not_built(models_not_supported);
  for (const MaterialModel& model : material_models())
    for (const std::string& alias : model.aliases) spec = spec.spelling(alias, model.name);
  return spec;
}

const MaterialModel* find_model(const DeckNode& node, std::vector<Fault>& faults) {
  std::string type = node.attribute("type").value_or("");
  const ValueVerdict verdict = judge_value(type_attribute().value, type);
  for (const MaterialModel& model : material_models())
    if (verdict.problem.empty() && model.name == type) return &model;
  if (!error_at(faults, node.where)) {
    add_error(faults, node.where, fmt::format("<constitutive_model type>: {}", verdict.problem),
              verdict.suggestion);
    faults.back().not_built = verdict.not_built;
  }
  return nullptr;
}

}  // namespace

TagSpec constitutive_model_tag() {
  std::vector<std::pair<std::string, const Tags*>> parts;
  for (const MaterialModel& model : material_models()) parts.emplace_back(model.name, &model.tags);
  TagSpec whole = choice_tag("constitutive_model",
                             "the law between deformation and stress; "
                             "docs/theory/mpm_materials.md has the formulas",
                             parts, laws_never_read)
                      .once();
  whole.attributes = {type_attribute()};
  return whole;
}

std::vector<TagSpec> failure_tags() {
  return {damage_model_tag(), erosion_tag()};
}

std::shared_ptr<const Material> make_material(const DeckNode& constitutive_model,
                                              const DeckNode& material,
                                              const MaterialConstants& constants,
                                              std::vector<Fault>& faults) {
  const MaterialModel* model = find_model(constitutive_model, faults);
  if (model == nullptr) return nullptr;
  const Parameters parameters(constitutive_model, model->name, model->tags,
                              {constants, erodes(material)}, faults);
  if (!parameters.good()) return nullptr;
  const std::size_t before = faults.size();
  auto law = model->make(parameters);
  const bool bad = std::any_of(faults.begin() + static_cast<std::ptrdiff_t>(before), faults.end(),
                               [](const Fault& f) { return f.severity == Severity::error; });
  if (law == nullptr || bad) return nullptr;
  return with_failure(std::move(law), material, constants, faults);
}

}  // namespace sluice::mpm
