#include "ice/conditions/travelling_vortices.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/deck/faults.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/conditions/face_conditions.hpp"

namespace sluice::ice {

TravellingVortices::Flow TravellingVortices::at(Vec3 x, double time, double rho,
                                                double viscosity) const {
  const double X = x.x - time, Y = x.y - time, decay = std::exp(-2.0 * viscosity / rho * time);
  const double A = amplitude * decay;
  return {1.0 - A * std::cos(X) * std::sin(Y), 1.0 + A * std::sin(X) * std::cos(Y),
          reference_pressure - 0.25 * rho * A * A * (std::cos(2.0 * X) + std::cos(2.0 * Y))};
}

namespace {

const DeckNode* vortices_of_start(const DeckNode& root) {
  const DeckNode* exact = root.find("CFD/ICE/customInitialization/manufacturedSolution");
  return exact != nullptr && exact->attribute("type") == "mms_1" ? exact : nullptr;
}

void check_start(const DeckNode& root, const DeckNode& condition, std::vector<Fault>& faults) {
  if (vortices_of_start(root) != nullptr) return;
  add_error(faults, condition.where,
            fmt::format("MMS_1 of {} needs <manufacturedSolution type=\"mms_1\"> in "
                        "<customInitialization>",
                        condition.attribute("label").value_or("")),
            "see sluice help CFD/ICE/customInitialization/manufacturedSolution");
}

std::shared_ptr<const PrescribedFlow> read_vortices(const DeckNode& root) {
  const DeckNode *exact = vortices_of_start(root), *constants = root.child("PhysicalConstants");
  if (exact == nullptr || constants == nullptr) return nullptr;
  return std::make_shared<VortexFlow>(TravellingVortices{
      real_or(*exact, "A", 1.0), real_or(*constants, "reference_pressure", 0.0)});
}

}  // namespace

FaceCondition travelling_vortices_condition() {
  return {.word = "MMS_1",
          .variables = {"Pressure", "Velocity", "Temperature"},
          .check = check_start,
          .read_flow = read_vortices,
          .apply = apply_flow};
}

}  // namespace sluice::ice
