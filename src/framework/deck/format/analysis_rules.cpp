// What the modules of DataAnalysis must have beyond single tags: places, times, weights.
#include <fmt/format.h>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/rule_tools.hpp"

namespace sluice {
namespace {

using Faults = std::vector<Fault>;

void check_times(const DeckNode& module, const std::string& name, Faults& faults) {
  const bool no_samples = name == "vorticity" || name == "SGS_ReynoldsStress" ||
                          name == "flatPlate_heatFlux" || name == "spatialAvg" || name.empty();
  const bool every_step = name == "statistics" || name == "turbulentFluxes" || no_samples;
  if (!every_step && module.child("samplingFrequency") == nullptr)
    add_error(faults, module.where, "<Module> needs <samplingFrequency>: samples per unit of time");
  const auto start = real_of(&module, "timeStart"), stop = real_of(&module, "timeStop");
  if (start && stop && *start > *stop)
    add_error(
        faults, module.where,
        fmt::format("timeStart {:g} lies after timeStop {:g}: nothing is sampled", *start, *stop));
}

void check_plane(const DeckNode& plane, Faults& faults) {
  const auto start = vector_of(&plane, "startingPt"), end = vector_of(&plane, "endingPt");
  if (!start || !end) return;
  int flat = 0;
  for (int d = 0; d < 3; ++d) flat += (*start)[d] == (*end)[d] ? 1 : 0;
  if (flat != 1)
    add_error(faults, plane.where,
              fmt::format("startingPt and endingPt agree in {} coordinates; the corners of a plane "
                          "along the axes agree in exactly one",
                          flat),
              "for a line use lineExtract");
}

void check_box(const DeckNode& box, Faults& faults) {
  const auto low = vector_of(&box, "min"), high = vector_of(&box, "max");
  if (!low || !high) return;
  for (int d = 0; d < 3; ++d)
    if (!((*low)[d] < (*high)[d]))
      add_error(faults, box.where,
                fmt::format("<box>: min {:g} is not below max {:g} in direction {}", (*low)[d],
                            (*high)[d], direction_names[d]));
}

void check_sides(const DeckNode& volume, Faults& faults) {
  std::vector<std::string> named;
  for (const DeckNode* face : volume.all("Face")) {
    const std::string side = face->attribute("side").value_or("");
    for (const std::string& other : named)
      if (other == side)
        add_error(faults, face->where, fmt::format("<Face side=\"{}\"> is named twice", side),
                  "once is enough");
    named.push_back(side);
    if (face->attribute("extents") == "partialFace" &&
        (face->child("startPt") == nullptr || face->child("endPt") == nullptr))
      add_error(
          faults, face->where,
          fmt::format("<Face side=\"{}\">: a partialFace needs <startPt> and <endPt>, its corners",
                      side));
  }
}

// Every entry of a list has a name of its own that can be a file's.
void check_names(const DeckNode* list, const char* entry, const char* attribute, Faults& faults) {
  if (list == nullptr) return;
  for (const DeckNode* e : list->all(entry)) {
    const std::string name = e->attribute(attribute).value_or("");
    if (name.find('/') != std::string::npos || (!name.empty() && name.front() == '.'))
      add_error(faults, e->where, fmt::format("<{}>: '{}' cannot be a folder's name", entry, name));
  }
}

void check_variables(const DeckNode& module, const std::string& name, Faults& faults) {
  const DeckNode* variables = module.child("Variables");
  if (variables == nullptr) return;
  bool velocity = false;
  for (const DeckNode* v : variables->all("analyze")) {
    const auto fluid = v->attribute("fluidVelocityLabel");
    velocity = velocity || (fluid && *fluid != "false");
    if (v->attribute("weighting") == "mass" && module.child("weight") == nullptr)
      add_error(faults, v->where,
                fmt::format("<analyze label=\"{}\" weighting=\"mass\"> needs a weight",
                            v->attribute("label").value_or("")),
                "name it in the module: <weight label=\"rho_CC\"/>");
  }
  if (name == "turbulentFluxes" && !velocity)
    add_error(faults, module.where, "turbulentFluxes needs the variable that is the velocity",
              "add fluidVelocityLabel=\"true\" to its <analyze>");
}

// A box has the same number of cells on either side of its middle.
void check_average_box(const DeckNode& module, Faults& faults) {
  const auto cells = int_vector_of(&module, "avgBoxCells");
  for (int d = 0; cells && d < 3; ++d)
    if ((*cells)[d] < 1 || (*cells)[d] % 2 == 0)
      add_error(faults, module.child("avgBoxCells")->where,
                fmt::format("<avgBoxCells>: {} cells along {}; a box is centred on its cell and "
                            "must have an odd number of cells",
                            (*cells)[d], direction_names[d]));
}

void check_module(const DeckNode& module, Faults& faults) {
  const std::string name = module.attribute("name").value_or("");
  check_times(module, name, faults);
  check_variables(module, name, faults);
  check_average_box(module, faults);
  check_names(module.child("lines"), "line", "name", faults);
  check_names(module.child("planes"), "plane", "name", faults);
  check_names(module.child("points"), "point", "name", faults);
  check_names(module.child("controlVolumes"), "box", "label", faults);
  if (const DeckNode* planes = module.child("planes"))
    for (const DeckNode* plane : planes->all("plane")) check_plane(*plane, faults);
  for (const DeckNode* plane : module.all("plane")) check_plane(*plane, faults);
  if (const DeckNode* volumes = module.child("controlVolumes"))
    for (const DeckNode* box : volumes->all("box")) check_box(*box, faults);
  if (const DeckNode* volume = module.child("controlVolume")) {
    check_sides(*volume, faults);
    if (const DeckNode* box = volume->child("box")) check_box(*box, faults);
  }
}

}  // namespace

void check_analyses(const DeckNode& root, std::vector<Fault>& faults) {
  if (const DeckNode* analysis = root.child("DataAnalysis"))
    for (const DeckNode* module : analysis->all("Module")) check_module(*module, faults);
}

}  // namespace sluice
