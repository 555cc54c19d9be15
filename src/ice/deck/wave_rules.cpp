// Conditions of an ICE deck's boundary that need a block of their own: LODI, Sine, inlet profiles,
// slip and creep.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "framework/deck/faults.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "ice/deck/schema.hpp"

namespace sluice {
namespace {

struct SpecialKind {
  std::string_view kind, block;
  std::vector<std::string_view> labels;  // that it is for
};

const std::array<SpecialKind, 6>& special_kinds() {
  static const std::array<SpecialKind, 6> all = {
      SpecialKind{"LODI", "LODI", {"Pressure", "Density", "Temperature", "Velocity"}},
      SpecialKind{"Sine", "SINE_BC", {"Pressure", "Temperature", "Velocity"}},
      SpecialKind{"powerLawProfile", "inletVelocity", {"Velocity"}},
      SpecialKind{"logLawProfile", "inletVelocity", {"Velocity"}},
      SpecialKind{"slip", "microSlip", {"Velocity", "Temperature"}},
      SpecialKind{"creep", "microSlip", {"Velocity"}}};
  return all;
}

// The flow of a manufactured solution goes on at the boundary.
void check_exact_flow(const DeckNode& root, const DeckNode& condition, const std::string& label,
                      std::vector<Fault>& faults) {
  if (label != "Pressure" && label != "Velocity" && label != "Temperature")
    add_error(faults, condition.where,
              fmt::format("MMS_1 is for Pressure, Velocity, Temperature, not for {}", label));
  const DeckNode* exact = root.find("CFD/ICE/customInitialization/manufacturedSolution");
  if (exact == nullptr || exact->attribute("type") != "mms_1")
    add_error(faults, condition.where,
              fmt::format("MMS_1 of {} needs <manufacturedSolution type=\"mms_1\"> in "
                          "<customInitialization>",
                          label),
              "see sluice help CFD/ICE/customInitialization/manufacturedSolution");
}

void check_special(const DeckNode& root, const DeckNode& conditions, const DeckNode& condition,
                   std::vector<Fault>& faults) {
  const std::string kind = condition.attribute("var").value_or("");
  const std::string label = condition.attribute("label").value_or("");
  if (kind == "FreeSlipWall" && label != "Velocity")
    add_error(faults, condition.where,
              fmt::format("FreeSlipWall is for Velocity only, not for {}", label));
  if (kind == "MMS_1") check_exact_flow(root, condition, label, faults);
  for (const SpecialKind& special : special_kinds()) {
    if (kind != special.kind) continue;
    if (std::find(special.labels.begin(), special.labels.end(), label) == special.labels.end())
      add_error(
          faults, condition.where,
          fmt::format("{} is for {}, not for {}", kind, fmt::join(special.labels, ", "), label));
    if (conditions.child(special.block) == nullptr)
      add_error(faults, condition.where,
                fmt::format("{} of {} needs the block <{}> in <BoundaryConditions>", kind, label,
                            special.block),
                fmt::format("see sluice help Grid/BoundaryConditions/{}", special.block));
    const DeckNode* profile = conditions.child("inletVelocity");
    if (profile == nullptr || special.block != "inletVelocity") continue;
    const char* wanted = kind == "powerLawProfile" ? "exponent" : "roughness";
    if (profile->child(wanted) == nullptr)
      add_error(faults, profile->where, fmt::format("a {} needs <{}>", kind, wanted));
    const DeckNode* tag = condition.child("value");
    const auto text = tag != nullptr ? std::optional(tag->text) : condition.attribute("value");
    if (!text || !parse_vector(*text))
      add_error(faults, (tag != nullptr ? *tag : condition).where,
                fmt::format("{} needs a <value> that is a vector, as [1.0, 0.0, 0.0]", kind));
  }
}

}  // namespace

void check_wave_conditions(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* conditions = root.find("Grid/BoundaryConditions");
  if (!runs_ice(root) || conditions == nullptr) return;
  for (const DeckNode* face : conditions->all("Face"))
    for (const DeckNode* condition : face->all("BCType"))
      check_special(root, *conditions, *condition, faults);
  const DeckNode* lodi = conditions->child("LODI");
  if (lodi == nullptr) return;
  const DeckNode *velocity = lodi->child("vel_infinity"), *rho = lodi->child("rho_infinity");
  if ((velocity == nullptr) == (rho == nullptr)) return;
  add_error(faults, (velocity != nullptr ? *velocity : *rho).where,
            "<LODI>: vel_infinity and rho_infinity belong together; one of them is missing",
            "give both, or none");
}

}  // namespace sluice
