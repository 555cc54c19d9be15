// Words of older decks of solids: what they become, and what is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mpm/test_support/solid_deck.hpp"

namespace sluice::mpm::old_words_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Loaded {
  Deck deck;
  std::string told;

  explicit Loaded(std::string text) {
    Schema schema;
    add_framework_tags(schema);
    add_mpm_tags(schema);
    deck = load_deck_text(text, "old.ups", {}, schema);
    for (const Fault& fault : deck.faults) told += to_string(fault) + '\n';
  }
  explicit Loaded(const SolidDeck& solid) : Loaded(text_of(solid)) {}
  std::string text_at(const char* path) const {
    const DeckNode* node = deck.root->find(path);
    return node == nullptr ? "(none)" : node->text;
  }
};

constexpr const char* material = "MaterialProperties/MPM/material";

Loaded with_flags(const std::string& flags) {
  SolidDeck deck;
  deck.flags = flags;
  return Loaded(deck);
}

TEST(OldWords, OfFlagsAreReadAsThoseOfToday) {
  const Loaded l = with_flags(
      "<with_color>true</with_color><use_prescribed_deformation>true</use_prescribed_deformation>"
      "<prescribed_deformation_file>motion</prescribed_deformation_file>"
      "<do_explicit_heat_conduction>false</do_explicit_heat_conduction>"
      "<do_pressure_stabilization>true</do_pressure_stabilization><use_CBDI>true</use_CBDI>"
      "<keep_press_bc_normal_to_surface>true</keep_press_bc_normal_to_surface>");
  EXPECT_TRUE(l.deck.good()) << l.told;
  for (const auto& [path, value] :
       {std::pair{"MPM/withColor", "true"}, std::pair{"MPM/UsePrescribedDeformation", "true"},
        std::pair{"MPM/PrescribedDeformationFile", "motion"},
        std::pair{"MPM/DoExplicitHeatConduction", "false"},
        std::pair{"MPM/DoPressureStabilization", "true"},
        std::pair{"MPM/use_CBDI_boundary_condition", "true"},
        std::pair{"MPM/keepPressBCNormalToSurface", "true"}})
    EXPECT_EQ(l.text_at(path), value) << path;
  EXPECT_THAT(l.told, HasSubstr("<with_color> is an old spelling; read as <withColor>"));
}

TEST(OldWords, OfPhysicsThatIsNotThereMustBeOff) {
  for (const char* name : {"create_new_particles", "createNewParticles", "manual_new_material",
                           "ManualNewMaterial", "can_add_MPM_material", "CanAddMPMMaterial",
                           "use_momentum_form", "turn_on_adiabatic_heating"}) {
    const std::string tag = name;
    const Loaded off = with_flags("<" + tag + "> false </" + tag + ">");
    EXPECT_TRUE(off.deck.good()) << off.told;
    EXPECT_THAT(off.told, HasSubstr("<" + tag + "> is obsolete; dropped"));
    const Loaded on = with_flags("<" + tag + ">true</" + tag + ">");
    EXPECT_FALSE(on.deck.good()) << tag;
    EXPECT_THAT(on.told, HasSubstr("<" + tag + "> true is known to the format, but not supported"));
  }
}

TEST(OldWords, ErosionOfAllIsThatOfEachMaterialWithoutItsOwn) {
  SolidDeck deck;
  deck.flags = "<erosion algorithm='ZeroStress'/>";
  deck.further = solid_material("other", "<erosion algorithm='AllowNoShear'/>");
  const Loaded l(deck);
  EXPECT_TRUE(l.deck.good()) << l.told;
  const auto materials = mpm_materials(*l.deck.root);
  ASSERT_EQ(materials.size(), 2u);
  ASSERT_NE(materials[0]->child("erosion"), nullptr);
  EXPECT_EQ(materials[0]->child("erosion")->attribute("algorithm"), "ZeroStress");
  EXPECT_EQ(materials[1]->child("erosion")->attribute("algorithm"), "AllowNoShear");
  EXPECT_THAT(l.told, HasSubstr("read as <erosion> of each material that has none"));
  const Loaded none = with_flags("<erosion algorithm='none'/>");
  EXPECT_EQ(none.deck.root->find(std::string(material) + "/erosion"), nullptr);
  EXPECT_FALSE(with_flags("<erosion algorithm='RemoveMass'/>").deck.good());
}

TEST(OldWords, NodesOfAParticleAreThoseOfItsBasis) {
  EXPECT_EQ(with_flags("<nodes8or27>27</nodes8or27>").text_at("MPM/interpolator"), "gimp");
  EXPECT_EQ(with_flags("<nodes8or27>8</nodes8or27>").text_at("MPM/interpolator"), "linear");
  EXPECT_EQ(with_flags("<nodes8or27>27</nodes8or27><interpolator>cpdi</interpolator>")
                .text_at("MPM/interpolator"),
            "cpdi");
  EXPECT_FALSE(with_flags("<nodes8or27>64</nodes8or27>").deck.good());
}

TEST(OldWords, ExpansionIsOffWhereNoMaterialHasACoefficient) {
  SolidDeck deck;
  deck.flags = "<DoThermalExpansion>false</DoThermalExpansion>";
  EXPECT_TRUE(Loaded(deck).deck.good()) << Loaded(deck).told;
  deck.material = "<linear_thermal_expansion_coef>1e-5</linear_thermal_expansion_coef>";
  EXPECT_THAT(Loaded(deck).told, HasSubstr("<DoThermalExpansion> false with a <linear"));
  deck.flags = "<do_thermal_expansion>true</do_thermal_expansion>";
  EXPECT_TRUE(Loaded(deck).deck.good()) << Loaded(deck).told;
}

// The text of the default deck with more in its law.
std::string with_law(const std::string& inside, const std::string& in_material = "") {
  SolidDeck deck;
  deck.material = in_material;
  std::string text = text_of(deck);
  text.insert(text.find("</constitutive_model>"), inside);
  return text;
}

TEST(OldWords, DamageInsideALawIsThatOfTheMaterial) {
  const Loaded l(
      with_law("<damage_model type='johnson_cook'><D1>.05</D1><D2>3.44</D2><D3>-2.12</D3>"
               "<D4>.002</D4><D5>.61</D5></damage_model>"
               "<initial_mean_scalar_damage>0.01</initial_mean_scalar_damage>"
               "<initial_std_scalar_damage>0.005</initial_std_scalar_damage>"
               "<initial_scalar_damage_distrib>gauss</initial_scalar_damage_distrib>"
               "<critical_scalar_damage>1</critical_scalar_damage>"));
  EXPECT_TRUE(l.deck.good()) << l.told;
  const std::string damage = std::string(material) + "/damage_model";
  EXPECT_EQ(l.deck.root->find(damage)->attribute("type"), "johnson_cook");
  EXPECT_EQ(l.text_at((damage + "/D3").c_str()), "-2.12");
  EXPECT_EQ(l.text_at((damage + "/initial_mean_scalar_damage").c_str()), "0.01");
  EXPECT_EQ(l.text_at((damage + "/initial_scalar_damage_distrib").c_str()), "gauss");
  EXPECT_THAT(l.told, HasSubstr("<damage_model> in <constitutive_model> is obsolete; read as"));
  EXPECT_FALSE(
      Loaded(with_law("<damage_model type='none'/>", "<damage_model type='none'/>")).deck.good());
}

TEST(OldWords, BasicDamageIsOffOrRefused) {
  EXPECT_TRUE(Loaded(with_law("", "<do_basic_damage>false</do_basic_damage>")).deck.good());
  const Loaded on(with_law("", "<do_basic_damage>true</do_basic_damage>"));
  EXPECT_THAT(on.told, HasSubstr("<do_basic_damage> true is known to the format"));
}

TEST(OldWords, ADensityInsideALawIsToldWhereItDiffers) {
  const auto metal = [](const char* density) {
    return std::string(
               "<material><density>8930</density><constitutive_model type='elastic_plastic'"
               "><bulk_modulus>136e9</bulk_modulus><shear_modulus>46e9</shear_modulus>"
               "<flow_model type='isotropic_hardening'><sigma_0>1e8</sigma_0><K>1e8</K>"
               "</flow_model><equation_of_state type='mie_gruneisen'><C_0>3940</C_0>"
               "<Gamma_0>2.02</Gamma_0><S_alpha>1.489</S_alpha><rho_0>") +
           density +
           "</rho_0></equation_of_state></constitutive_model><thermal_conductivity>1"
           "</thermal_conductivity><specific_heat>5</specific_heat></material>";
  };
  SolidDeck deck;
  deck.further = metal("8930.0");
  EXPECT_THAT(Loaded(deck).told, HasSubstr("<rho_0> in <equation_of_state> is obsolete; dropped"));
  deck.further = metal("8900");
  EXPECT_THAT(Loaded(deck).told, HasSubstr("the material's <density> 8930 is used"));
  EXPECT_TRUE(Loaded(deck).deck.good()) << Loaded(deck).told;
}

TEST(OldWords, OnATubeOfARadiusAndAThickness) {
  SolidDeck deck;
  deck.objects =
      "<geom_object><smoothcyl><bottom>[.5,.5,.1]</bottom><top>[.5,.5,.9]</top>"
      "<radius>.4</radius><thickness>.25</thickness><num_radial>4</num_radial>"
      "<num_axial>8</num_axial></smoothcyl><res>[2,2,2]</res><velocity>[0,0,0]</velocity>"
      "<temperature>300</temperature></geom_object>";
  const Loaded l(deck);
  EXPECT_TRUE(l.deck.good()) << l.told;
  const std::string tube = std::string(material) + "/geom_object/smoothcyl/";
  EXPECT_EQ(l.text_at((tube + "outer_radius").c_str()), ".4");
  EXPECT_NEAR(std::stod(l.text_at((tube + "inner_radius").c_str())), 0.15, 1e-15);
  EXPECT_EQ(l.text_at((tube + "discretization_scheme").c_str()), "pie_slices");
  EXPECT_THAT(l.told, Not(HasSubstr("error")));
}

}  // namespace
}  // namespace sluice::mpm::old_words_test
