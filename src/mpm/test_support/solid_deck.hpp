// A deck of solids of a few parts, read in this process.
#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/scene/deck_values.hpp"
#include "framework/scene/scene.hpp"
#include "mpm/deck/read_mpm_scene.hpp"
#include "mpm/deck/schema.hpp"

namespace sluice::mpm {

// Each part may be replaced; the rest is a block of 1000 kg/m^3 in a box of ten cells a direction.
struct SolidDeck {
  std::string lower = "[0,0,0]", upper = "[1,1,1]", cells = "[10,10,10]";
  std::string flags;  // in <MPM>
  std::string objects =
      "<geom_object><box><min>[0.2,0.2,0.2]</min><max>[0.6,0.6,0.6]</max></box>"
      "<res>[2,2,2]</res><velocity>[1,2,3]</velocity>"
      "<temperature>300</temperature></geom_object>";
  std::string material;  // further tags of the first material
  std::string further;   // further materials
  std::string contacts;  // in <MaterialProperties><MPM>
  std::string blocks;    // at the root
  std::string level;     // in <Level>
  std::string faces;     // in place of symmetric sides
};

inline std::string solid_material(const std::string& name, const std::string& inside) {
  return fmt::format(
      "<material name='{}'><density>1000</density><constitutive_model type='comp_neo_hook'>"
      "<bulk_modulus>1e6</bulk_modulus><shear_modulus>5e5</shear_modulus></constitutive_model>"
      "<thermal_conductivity>1</thermal_conductivity><specific_heat>5</specific_heat>{}</"
      "material>\n",
      name, inside);
}

inline std::string text_of(const SolidDeck& deck) {
  std::string faces = deck.faces;
  if (faces.empty())
    for (const char* side : {"x-", "x+", "y-", "y+", "z-", "z+"})
      faces += fmt::format(
          "<Face side='{}'><BCType id='all' label='Symmetric' var='symmetry'/></Face>\n", side);
  return fmt::format(
      "<Uintah_specification>\n<Meta><title>solids</title></Meta>\n"
      "<SimulationComponent type='mpm'/>\n"
      "<Time><initTime>0</initTime><maxTime>1</maxTime><delt_min>0</delt_min><delt_max>1</delt_max>"
      "<timestep_multiplier>0.4</timestep_multiplier></Time>\n"
      "<DataArchiver><filebase>a.uda</filebase><outputInterval>0</outputInterval></DataArchiver>\n"
      "<PhysicalConstants><gravity>[0,0,0]</gravity></PhysicalConstants>\n"
      "<MPM>{}</MPM>\n{}\n"
      "<MaterialProperties><MPM>\n{}{}{}</MPM></MaterialProperties>\n"
      "<Grid><BoundaryConditions>\n{}</BoundaryConditions><Level><Box label='1'><lower>{}</lower>"
      "<upper>{}</upper><resolution>{}</resolution></Box>{}</Level></Grid>\n"
      "</Uintah_specification>\n",
      deck.flags, deck.blocks, solid_material("block", deck.material + deck.objects), deck.further,
      deck.contacts, faces, deck.lower, deck.upper, deck.cells, deck.level);
}

// What reading a deck gives; `text` holds all faults, one a line.
struct ReadDeck {
  Deck deck;
  Scene scene;
  MpmScene solids;
  std::vector<Fault> faults;
  std::string text;
};

inline Schema solid_schema() {
  Schema schema;
  add_framework_tags(schema);
  schema.add(tag("MaterialProperties", "materials").multiple());
  add_mpm_tags(schema);
  return schema;
}

inline void finish_reading(ReadDeck& read) {
  read.faults = read.deck.faults;
  if (read.deck.good()) {
    read.scene = read_scene(read.deck, {}, read.faults);
    if (!any_error(read.faults)) read.solids = read_mpm_scene(read.deck, read.scene, read.faults);
  }
  for (const Fault& fault : read.faults) read.text += to_string(fault) + '\n';
}

inline ReadDeck read_solids(const SolidDeck& deck, const std::string& name = "solids.ups") {
  ReadDeck read;
  read.deck = load_deck_text(text_of(deck), name, {}, solid_schema());
  finish_reading(read);
  return read;
}

// Without what is analysed.
inline ReadDeck read_solid_file(const std::string& file) {
  ReadDeck read;
  Schema schema = solid_schema();
  schema.rewrites.emplace_back([](DeckNode& root, std::vector<Fault>&) {
    std::erase_if(root.children, [](const auto& block) { return block->name == "DataAnalysis"; });
  });
  read.deck = load_deck(file, {}, schema);
  finish_reading(read);
  return read;
}

}  // namespace sluice::mpm
