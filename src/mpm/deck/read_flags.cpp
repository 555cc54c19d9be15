// <MPM> and <AMR><MPM>.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "framework/deck/data_file.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/scene/deck_values.hpp"
#include "mpm/deck/bases.hpp"
#include "mpm/deck/implicit.hpp"
#include "mpm/deck/pore_water.hpp"
#include "mpm/deck/readers.hpp"
#include "mpm/deck/schema.hpp"

namespace sluice::mpm {
namespace {

template <class T>
struct Word {
  std::string_view name;
  T value;
};

constexpr Word<Transfer> transfers[] = {
    {"flip", Transfer::flip}, {"pic", Transfer::pic},       {"xpic", Transfer::xpic},
    {"apic", Transfer::apic}, {"affine", Transfer::affine}, {"midpoint", Transfer::midpoint}};

template <class T, std::size_t n>
T value_of(const Word<T> (&words)[n], std::string_view name) {
  const auto* at = std::find_if(std::begin(words), std::end(words),
                                [&](const Word<T>& word) { return word.name == name; });
  return at != std::end(words) ? at->value : words[0].value;
}

void read_scheme(const DeckNode& flags, MpmScene& s) {
  s.basis = basis_of(flags).basis;
  s.transfer = value_of(transfers, text_or(flags, "transfer", "flip"));
  s.xpic_order = integer_or(flags, "xpic_order", s.xpic_order);
  if (s.transfer == Transfer::xpic && s.xpic_order == 1) s.transfer = Transfer::pic;
  s.affine_damping = real_or(flags, "affine_damping", s.affine_damping);
  if (boolean_or(flags, "XPIC2", false)) {
    s.transfer = Transfer::xpic;
    s.xpic_order = 2;
    s.xpic2_of_format = true;
  }
  s.gradient_enhanced = boolean_or(flags, "UseGradientEnhancedVelocityProjection", false);
  if (s.gradient_enhanced) {
    s.transfer = Transfer::affine;
    s.affine_damping = 0;
  }
  s.musl = boolean_or(flags, "musl", basis_of(flags).points);
  s.total_lagrangian = boolean_or(flags, "total_lagrangian", false);
  s.cpdi_limit = real_or(flags, "cpdi_lcrit", s.cpdi_limit);
  s.axisymmetric = boolean_or(flags, "axisymmetric", false);
  s.subcycles_of_F = integer_or(flags, "minimum_subcycles_for_F", s.subcycles_of_F);
  s.pressure_stabilised = boolean_or(flags, "DoPressureStabilization", false);
  s.min_particle_mass = real_or(flags, "minimum_particle_mass", s.min_particle_mass);
  s.full_first_kick = boolean_or(flags, "full_first_kick", false);
}

void read_physics(const DeckNode& flags, MpmScene& s) {
  s.damping = real_or(flags, "artificial_damping_coeff", 0);
  s.artificial_viscosity = boolean_or(flags, "artificial_viscosity", false);
  s.viscosity_heats = boolean_or(flags, "artificial_viscosity_heating", s.artificial_viscosity);
  s.viscosity_1 = real_or(flags, "artificial_viscosity_coeff1", s.viscosity_1);
  s.viscosity_2 = real_or(flags, "artificial_viscosity_coeff2", s.viscosity_2);
  s.heat_conduction = boolean_or(flags, "DoExplicitHeatConduction", true);
  s.scalar_diffusion = boolean_or(flags, "do_scalar_diffusion", false);
  s.filters_pore_pressure = boolean_or(flags, "PorePressureFilter", false);
  s.friction_heats = boolean_or(flags, "do_contact_friction_heating", false);
  s.colinear_normals = boolean_or(flags, "computeColinearNormals", true);
  s.use_loads = boolean_or(flags, "use_load_curves", false);
  s.normal_to_surface = boolean_or(flags, "keepPressBCNormalToSurface", false);
  s.loads_on_corners = boolean_or(flags, "use_CBDI_boundary_condition", false);
  s.with_colour = boolean_or(flags, "withColor", false);
  s.manufactured = text_or(flags, "RunMMSProblem", "");
  s.manufactured_amplitude = real_or(flags, "manufactured_amplitude", 0);
  s.refine_particles = boolean_or(flags, "refine_particles", false);
}

void read_files(const DeckNode& flags, MpmScene& s, std::vector<Fault>& faults) {
  s.exact_deformation = boolean_or(flags, "exactDeformation", false);
  if (boolean_or(flags, "UsePrescribedDeformation", false))
    s.prescribed_file = data_file(flags.need("PrescribedDeformationFile"), faults);
  if (boolean_or(flags, "InsertParticles", false))
    s.insert_file = data_file(flags.need("InsertParticlesFile"), faults);
}

// "[xminus,zplus]"
void read_traction_faces(const DeckNode& flags, MpmScene& s, std::vector<Fault>& faults) {
  const DeckNode* node = flags.child("boundary_traction_faces");
  if (node == nullptr) return;
  const std::vector<std::string> valid = {"xminus", "xplus", "yminus", "yplus", "zminus", "zplus"};
  std::string words = node->text;
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
  for (std::size_t at = words.find_first_not_of(' '); at != std::string::npos;) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    const std::string word = words.substr(at, end - at);
    if (std::find(valid.begin(), valid.end(), word) != valid.end())
      s.traction_faces.push_back(word);
    else
      add_error(faults, node->where,
                fmt::format("<boundary_traction_faces>: '{}' is not a face", word),
                suggest_name(word, valid));
    at = words.find_first_not_of(' ', end);
  }
}

// <AMR><MPM>: criteria by material.
void read_splits(const DeckNode& root, MpmScene& s, std::vector<Fault>& faults) {
  const DeckNode* list = root.find("AMR/MPM/Refinement_Criteria_Thresholds");
  const auto count = static_cast<int>(s.materials.size());
  if (list != nullptr)
    for (const DeckNode* v : list->all("Variable")) {
      SplitCriterion c;
      c.where = v->where;
      if (v->attribute("name") == "stretchRatio") c.kind = SplitCriterion::Kind::stretch_ratio;
      collect(faults, v->where, [&] {
        c.value = real_attribute(*v, "value").value_or(0);
        if (v->attribute("matl") != "all") c.material = integer_attribute(*v, "matl").value_or(-1);
      });
      if (c.material >= count)
        add_error(faults, v->where,
                  fmt::format("<Variable matl>: there is no material {}: the deck has {}, counted "
                              "from 0",
                              c.material, count));
      s.splits.push_back(c);
    }
  const DeckNode* flag = root.find("MPM/refine_particles");
  if (s.refine_particles && s.splits.empty())
    add_error(faults, flag->where,
              "<refine_particles> needs a criterion: "
              "<AMR><MPM><Refinement_Criteria_Thresholds><Variable>");
}

}  // namespace

// Decks that leave the scheme to Sluice have the midpoint transfer wherever it has a form.
bool takes_midpoint_transfer(const DeckNode& root) {
  const DeckNode* flags = root.child("MPM");
  if (flags == nullptr || !runs_mpm(root) || runs_implicit(root) || runs_pore_water(root))
    return false;
  for (const char* name : {"transfer", "musl"})
    if (flags->has(name)) return false;
  for (const char* name : {"XPIC2", "UseGradientEnhancedVelocityProjection"})
    if (boolean_or(*flags, name, false)) return false;
  for (const char* name : without_midpoint)
    if (boolean_or(*flags, name, false)) return false;
  return !basis_of(*flags).points;
}

void read_flags(const DeckNode& root, MpmScene& s, std::vector<Fault>& faults) {
  if (const DeckNode* flags = root.child("MPM")) {
    read_scheme(*flags, s);
    read_physics(*flags, s);
    read_files(*flags, s, faults);
    read_traction_faces(*flags, s, faults);
  }
  if (takes_midpoint_transfer(root)) s.transfer = Transfer::midpoint;
  if (runs_implicit(root)) {
    const DeckNode* flags = root.child("MPM");
    s.implicit = flags != nullptr ? read_implicit(*flags) : ImplicitSettings{};
    s.total_lagrangian |= flags != nullptr && !boolean_or(*flags, "do_grid_reset", true);
    s.heat_conduction = s.implicit->conducts;
    s.musl = false;
  }
  read_splits(root, s, faults);
}

}  // namespace sluice::mpm
