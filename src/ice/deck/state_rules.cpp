// States that an ICE deck gives: on sides, pressure, density and temperature that contradict each
// other; at the start, a weight that nothing carries.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/deck/faults.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "ice/conditions/face_conditions.hpp"
#include "ice/deck/mixed_gas_rules.hpp"
#include "ice/deck/read_fluid.hpp"
#include "ice/deck/schema.hpp"

namespace sluice {
namespace {

// threshold: relative difference between the pressure of an inlet and the initial pressures up to
//   which they count as equal: waves change it too; unit: 1; test: boundaries.rows
constexpr double from_inside = 0.1;

struct FaceState {
  const DeckNode* pressure = nullptr;
  const DeckNode* density = nullptr;
  const DeckNode* temperature = nullptr;
  const DeckNode* volume = nullptr;
  const DeckNode* velocity = nullptr;

  FaceState(const DeckNode& face, int material) {
    for (const DeckNode* condition : face.all("BCType")) {
      if (!applies_to(*condition, material)) continue;
      const std::string label = condition->attribute("label").value_or("");
      if (label == "Velocity") velocity = condition;
      if (condition->attribute("var") != "Dirichlet") continue;
      if (label == "Pressure") pressure = condition;
      if (label == "Density") density = condition;
      if (label == "Temperature") temperature = condition;
      if (label == "SpecificVol") volume = condition;
    }
  }
};

std::optional<double> number_of(const DeckNode* condition) {
  if (condition == nullptr) return std::nullopt;
  const auto number = parse_real(condition_value(*condition).text.value_or(""));
  return number ? std::optional(*number.value) : std::nullopt;
}

// What the velocity through the face is.
enum class Through { open, wall, given };

Through through(const FaceState& s, const std::string& side) {
  if (s.velocity == nullptr) return Through::open;
  const std::string kind = s.velocity->attribute("var").value_or("");
  const ice::FaceCondition* row = ice::face_condition(kind);
  if (row != nullptr && row->gives_velocity) return Through::given;
  if (row != nullptr && row->wall) return Through::wall;
  if (kind != "Dirichlet") return Through::open;
  const auto u = parse_vector(condition_value(*s.velocity).text.value_or(""));
  const auto normal = side.empty() ? std::string::npos : std::string("xyz").find(side[0]);
  if (!u || normal == std::string::npos) return Through::open;
  return (*u.value)[static_cast<int>(normal)] == 0 ? Through::wall : Through::given;
}

bool differ(double a, double b, double tolerance) {
  return std::fabs(a - b) > tolerance * std::fabs(a);
}

// Pressures with which the gas starts, and that which all starts are measured from.
bool is_near_a_start(const DeckNode& root, const DeckNode& material, double pressure) {
  const auto near = [&](std::optional<double> p) {
    return p && !differ(pressure, *p, from_inside);
  };
  if (near(real_of(root.child("PhysicalConstants"), "reference_pressure"))) return true;
  const std::optional<ice::Fluid> fluid = ice::readable_fluid(material);
  for (const DeckNode* object : material.all("geom_object")) {
    const auto rho = real_of(object, "density"), T = real_of(object, "temperature");
    if (fluid && rho && T && *rho > 0 && *T > 0 &&
        near(fluid->pressure(*rho, fluid->energy_from_temperature(*rho, *T))))
      return true;
  }
  return false;
}

// The density of a material itself: of several, that of the sides is mass per volume of the cell,
// and the specific volume says it, if anything does.
std::optional<double> own_density(const FaceState& s, bool several) {
  if (!several) return number_of(s.density);
  const auto volume = number_of(s.volume);
  return volume && *volume > 0 ? std::optional(1.0 / *volume) : std::nullopt;
}

// `number`: of the material in conditions; `several`: it is one of several.
void check_face(const DeckNode& root, const DeckNode& face, const DeckNode& material, int number,
                bool several, std::vector<Fault>& faults) {
  const FaceState s(face, number);
  const std::string side = side_of_face(face);
  const auto rho = own_density(s, several), T = number_of(s.temperature), p = number_of(s.pressure);
  const std::optional<ice::Fluid> fluid = ice::readable_fluid(material);
  const Through flow = through(s, side);
  if (!fluid || !rho || !T || !(*rho > 0) || !(*T > 0) || flow == Through::wall) return;
  const double made = fluid->pressure(*rho, fluid->energy_from_temperature(*rho, *T));
  const std::string given =
      fmt::format("{} {:.6g} and Temperature {:.6g} on side {} make a pressure of {:.6g}",
                  several ? "SpecificVol" : "Density", several ? 1.0 / *rho : *rho, *T, side, made);
  const char* of_inlet =
      "at a subsonic inlet the pressure comes from inside, and the fluid enters with this density "
      "and temperature";
  // What the pressure does when the last of the digits that decks write changes.
  const double unsure = ice::last_written_digit * std::fabs(fluid->bulk_modulus(*rho, made));
  if (p) {
    if (!differ(made, *p, ice::written_pressure_tolerance) || std::fabs(made - *p) <= unsure)
      return;
    const bool enters = flow == Through::given && !several;
    add_warning(faults, s.pressure->where,
                fmt::format("{}, but Pressure is {:.6g}: {}", given, *p,
                            enters ? of_inlet : "the temperature is not used"),
                fluid->gamma_law() == nullptr
                    ? "give two of the three"
                    : fmt::format("for {:.6g} write Temperature {:.6g}", *p, *T * *p / made));
  } else if (flow == Through::given && !several && std::fabs(made) > unsure &&
             !is_near_a_start(root, material, made)) {
    add_warning(faults, s.density->where,
                fmt::format("{}, which occurs nowhere in the initial state: {}", given, of_inlet),
                "give the Density or the Temperature alone, and the other as Neumann 0");
  }
}

// Whoever writes that there is no hydrostatic start knows; along a direction of one cell all is
// carried alike.
void check_weight(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* grid = root.child("Grid");
  const DeckNode* node = root.find("PhysicalConstants/gravity");
  const auto gravity = vector_of(root.child("PhysicalConstants"), "gravity");
  const DeckNode* balanced = root.find("CFD/ICE/applyHydrostaticPressure");
  if (grid == nullptr || node == nullptr || !gravity) return;
  if (balanced != nullptr && balanced->text == "false") return;
  const auto periodic = periodic_directions(*grid);
  const auto cells = int_vector_of(root.find("Grid/Level/Box"), "resolution");
  for (std::size_t d = 0; d < 3; ++d) {
    const int direction = static_cast<int>(d);
    if (periodic[d] && (*gravity)[direction] != 0 && !(cells && (*cells)[direction] == 1))
      add_warning(
          faults, node->where,
          fmt::format(
              "<gravity> acts along {}, which is periodic: no boundary supports the weight, so "
              "that everything accelerates without limit, and no initial pressure balances it",
              direction_names[d]),
          fmt::format("write 0 for {}, give its sides conditions, or, where the weight "
                      "shall drive the flow, <applyHydrostaticPressure>false"
                      "</applyHydrostaticPressure>",
                      direction_names[d]));
  }
}

}  // namespace

void check_ice_states(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_ice(root)) return;
  check_weight(root, faults);
  const auto materials = ice_materials(root);
  const DeckNode* conditions = root.find("Grid/BoundaryConditions");
  if (conditions == nullptr) return;
  std::vector<std::string> names;
  for (const DeckNode* material : materials)
    names.push_back(material->attribute("name").value_or(""));
  // Of a gas that is a mixture the pressure follows from a scalar too.
  const auto mixed = mixed_material(root, names);
  for (const DeckNode* face : conditions->all("Face"))
    for (std::size_t m = 0; m < materials.size(); ++m)
      if (mixed != m)
        check_face(root, *face, *materials[m], solid_material_count(root) + static_cast<int>(m),
                   materials.size() > 1, faults);
}

}  // namespace sluice
