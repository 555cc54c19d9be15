// Reading and checking <exchange_properties>.
//
// Lists of coefficients run over the upper triangle, 0-1, 0-2, ..., 1-2, ..., one number per pair.
#include "ice/deck/exchange_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/deck/schema.hpp"

namespace sluice::ice {
namespace {

std::size_t pairs_of(int materials) {
  return materials * (materials - 1) / 2;
}

PairCoefficients triangle(const DeckNode* list, int materials) {
  PairCoefficients k(materials);
  const auto values =
      list == nullptr ? ParsedValue<std::vector<double>>{} : parse_reals(list->text);
  if (!values || values.value->size() < pairs_of(materials)) return k;
  std::size_t next = 0;
  for (int m = 0; m < materials; ++m)
    for (int n = m + 1; n < materials; ++n) k.set(m, n, (*values.value)[next++]);
  return k;
}

const DeckNode* exchange_node(const DeckNode& root) {
  for (const DeckNode* properties : root.all("MaterialProperties"))
    if (const DeckNode* exchange = properties->child("exchange_properties")) return exchange;
  return nullptr;
}

bool varies(const DeckNode* exchange, const char* kind) {
  const DeckNode* model = exchange->find(std::string("CoefficientModel/") + kind);
  return model != nullptr && model->text == "linearVariation";
}

// The coefficients of momentum or heat.
PairCoefficients coefficients_of(const DeckNode* exchange, const DeckNode* list, const char* kind,
                                 int materials) {
  PairCoefficients k = triangle(list, materials);
  if (varies(exchange, kind)) k.vary_with_mass();
  return k;
}

// "0-1, 0-2, 1-2"
std::string pair_names(int materials) {
  std::string names;
  for (int m = 0; m < materials; ++m)
    for (int n = m + 1; n < materials; ++n)
      names += fmt::format("{}{}-{}", names.empty() ? "" : ", ", m, n);
  return names;
}

// True: as many as there are pairs.
bool check_count(const DeckNode& coefficients, const char* kind, int materials,
                 std::vector<Fault>& faults) {
  const DeckNode* list = coefficients.child(kind);
  const auto values = list == nullptr ? std::nullopt : parse_reals(list->text).value;
  if (!values || materials == 0) return false;
  const std::size_t wanted = pairs_of(materials);
  // One material: whatever stands there has nobody to act on.
  if (values->size() == wanted || materials == 1) return true;
  if (values->empty()) {
    add_warning(faults, list->where, fmt::format("<{}> is empty: 0 for each pair", kind),
                fmt::format("write {} numbers, or remove the tag", wanted));
    return true;
  }
  add_error(faults, list->where,
            fmt::format("<{}> has {} coefficient{}; {} materials have {} pair{}: {}", kind,
                        values->size(), values->size() == 1 ? "" : "s", materials, wanted,
                        wanted == 1 ? "" : "s", pair_names(materials)),
            "one number per pair, in this order");
  return false;
}

void check_index(const DeckNode& parent, const char* tag, int materials,
                 std::vector<Fault>& faults) {
  const auto index = integer_of(&parent, tag);
  if (!index || (*index >= 0 && *index < materials) || materials == 0) return;
  add_error(faults, parent.child(tag)->where,
            fmt::format("<{}>: there is no material {}: the deck has {}, counted from 0", tag,
                        *index, materials));
}

// A gas and what takes the place of a solid. The gas: an ideal one, if `slips`.
void check_surface(const DeckNode& parent, const char* fluid_tag, const char* solid_tag,
                   const std::vector<const DeckNode*>& materials, bool slips,
                   std::vector<Fault>& faults) {
  const auto count = static_cast<int>(materials.size());
  check_index(parent, fluid_tag, count, faults);
  check_index(parent, solid_tag, count, faults);
  const auto fluid = integer_of(&parent, fluid_tag), solid = integer_of(&parent, solid_tag);
  if (!fluid || !solid || *fluid < 0 || *fluid >= count) return;
  if (*fluid == *solid)
    add_error(faults, parent.child(solid_tag)->where,
              fmt::format("<{}> and <{}> are both {}: a material has no surface with itself",
                          fluid_tag, solid_tag, *fluid));
  const DeckNode* law = materials[*fluid]->child("EOS");
  if (!slips || law == nullptr || law->attribute("type") == "ideal_gas") return;
  add_error(
      faults, parent.child(fluid_tag)->where,
      fmt::format("<{}>: slip follows from the mean free path of an ideal gas; material {} is {}",
                  fluid_tag, *fluid, law->attribute("type").value_or("another law")));
}

// What a deck does not say is zero; said once.
void warn_of_no_exchange(const DeckNode& material, const DeckNode* exchange,
                         std::vector<Fault>& faults) {
  const DeckNode* coefficients =
      exchange == nullptr ? nullptr : exchange->child("exchange_coefficients");
  if (exchange == nullptr)
    add_warning(
        faults, material.where,
        "several materials without <exchange_properties>: they exchange neither momentum nor heat",
        "see sluice help MaterialProperties/exchange_properties");
  else if (coefficients != nullptr && coefficients->child("heat") == nullptr)
    add_warning(faults, coefficients->where,
                "<exchange_coefficients> without <heat>: materials exchange no heat",
                "write <heat> with a coefficient per pair, or 0 for each");
}

// True: the deck has it, and both of its materials.
bool check_convective(const DeckNode& exchange, std::vector<Fault>& faults) {
  const DeckNode* convective = exchange.child("do_convective_heat_transfer");
  if (convective == nullptr || convective->text != "true") return false;
  bool both = true;
  for (const char* needed : {"convective_fluid", "convective_solid"}) {
    if (exchange.child(needed) != nullptr) continue;
    both = false;
    add_error(faults, convective->where,
              fmt::format("<do_convective_heat_transfer> needs <{}>", needed));
  }
  return both;
}

void check_models(const DeckNode& exchange, const std::vector<const DeckNode*>& materials,
                  std::vector<Fault>& faults) {
  if (const DeckNode* model = exchange.child("Model"))
    check_surface(*model, "fluidMatlIndex", "solidMatlIndex", materials, true, faults);
  check_surface(exchange, "convective_fluid", "convective_solid", materials, false, faults);
  check_convective(exchange, faults);
}

// Beside solids, which are counted first: what has the surface may be one of them.
void check_convective_beside_solids(const DeckNode& exchange, int solids, int materials,
                                    std::vector<Fault>& faults) {
  if (!check_convective(exchange, faults)) return;
  for (const char* tag : {"convective_fluid", "convective_solid"})
    check_index(exchange, tag, materials, faults);
  const auto fluid = integer_of(&exchange, "convective_fluid"),
             solid = integer_of(&exchange, "convective_solid");
  if (!fluid || !solid || *fluid < 0 || *fluid >= materials) return;
  const Location& where = exchange.child("convective_fluid")->where;
  if (*fluid < solids)
    add_error(
        faults, where, fmt::format("<convective_fluid>: material {} is a solid", *fluid),
        fmt::format("the fluids are {} to {}: solids are counted first", solids, materials - 1));
  else if (*fluid == *solid)
    add_error(faults, where,
              fmt::format("<convective_fluid> and <convective_solid> are both {}: a material has "
                          "no surface with itself",
                          *fluid));
}

}  // namespace

double growth_with_mass_ratio(double M_m, double M_n) {
  // threshold: square of a mass ratio above which exchange coefficients grow with it; unit: 1;
  //   test: HeatContacts.ACoefficientMayGrowWithTheRatioOfMasses
  constexpr double least_square = 1e5;
  // threshold: square of a mass ratio above which they no longer grow; unit: 1; test:
  //   Drag.MayGrowWithTheRatioOfMasses
  constexpr double most_square = 1e12;
  const double ratio = M_m > M_n ? M_m / M_n : M_n / M_m;
  return std::clamp(ratio * ratio, least_square, most_square) / least_square;
}

// rho sqrt(2 R T/pi) a/(2 - a): Maxwell's slip length is (2 - a)/a mean free paths
// mu/(rho sqrt(2 R T/pi)).
double MultiVelocityExchange::momentum_transfer(const Fluid& gas, double rho, double T) const {
  const double R = (gas.gamma - 1.0) * gas.specific_heat, a = momentum_accommodation;
  return rho * std::sqrt(2.0 * R * std::max(T, 0.0) / std::numbers::pi) * (a / (2.0 - a));
}

// Smoluchowski's jump of temperature, (2 - a)/a 2/(gamma + 1) k/(cv mu) mean free paths.
double MultiVelocityExchange::heat_transfer(const Fluid& gas, double rho, double T,
                                            double cv) const {
  const double R = (gas.gamma - 1.0) * gas.specific_heat, a = thermal_accommodation;
  return rho * std::sqrt(2.0 * R * std::max(T, 0.0) / std::numbers::pi) * (a / (2.0 - a)) * cv *
         (0.5 * (gas.gamma + 1.0));
}

PairCoefficients PairCoefficients::of(int first, int count) const {
  PairCoefficients k(count);
  for (int m = 0; m < count; ++m)
    for (int n = m + 1; n < count; ++n) k.set(m, n, (*this)(first + m, first + n));
  if (varies()) k.vary_with_mass();
  return k;
}

bool PairCoefficients::any() const {
  return std::any_of(values_.begin(), values_.end(), [](double k) { return k > 0; });
}

double PairCoefficients::min_of_pairs() const {
  double least = materials_ < 2 ? 0.0 : std::numeric_limits<double>::infinity();
  for (int m = 0; m < materials_; ++m)
    for (int n = m + 1; n < materials_; ++n) least = std::min(least, (*this)(m, n));
  return least;
}

ExchangeSettings read_exchange(const DeckNode& root, int materials) {
  ExchangeSettings s;
  s.momentum = PairCoefficients(materials);
  s.heat = PairCoefficients(materials);
  const DeckNode* exchange = exchange_node(root);
  if (exchange == nullptr) return s;
  s.where = exchange->where;
  if (const DeckNode* coefficients = exchange->child("exchange_coefficients")) {
    s.written = true;
    const DeckNode *momentum = coefficients->child("momentum"), *heat = coefficients->child("heat");
    s.momentum = coefficients_of(exchange, momentum, "momentum", materials);
    s.heat = coefficients_of(exchange, heat, "heat", materials);
    s.momentum_location = momentum != nullptr ? momentum->where : exchange->where;
    s.heat_location = heat != nullptr ? heat->where : exchange->where;
  }
  if (const DeckNode* model = exchange->child("Model")) {
    const MultiVelocityExchange usual;
    s.slip = MultiVelocityExchange{integer_or(*model, "fluidMatlIndex", usual.fluid),
                                   integer_or(*model, "solidMatlIndex", usual.solid),
                                   real_or(*model, "momentum_accommodation_coeff", 1.0),
                                   real_or(*model, "thermal_accommodation_coeff", 1.0),
                                   boolean_or(*model, "useSlipCoeffs", true),
                                   model->where};
  }
  if (boolean_or(*exchange, "do_convective_heat_transfer", false))
    s.convective = ConvectiveExchange{integer_or(*exchange, "convective_fluid", 0),
                                      integer_or(*exchange, "convective_solid", 1),
                                      exchange->child("do_convective_heat_transfer")->where};
  return s;
}

TagSpec exchange_tag() {
  const auto variation = [](const std::string& name, const std::string& doc) {
    return tag(name, doc).words({"constant", "linearVariation"});
  };
  return tag("exchange_properties", "momentum and heat exchange between materials")
      .with_children(
          {tag("CoefficientModel",
               "variation of the coefficients; linearVariation: times r^2/1e5, limited to 1 to "
               "1e7, with r the ratio of the masses, so that traces are coupled too")
               .with_children({variation("momentum", "variation of the momentum coefficients"),
                               variation("heat", "variation of the heat coefficients")}),
           tag("Model", "slip of a rarefied gas along the surface of a material")
               .attribute(attribute("type", "which one").once().words({"slip"}))
               .with_children(
                   {tag("fluidMatlIndex", "the gas, an ideal one").once().integer().at_least(0),
                    tag("solidMatlIndex", "the material with the surface")
                        .once()
                        .integer()
                        .at_least(0),
                    tag("momentum_accommodation_coeff",
                        "accommodation coefficient of momentum (fraction of diffuse reflection)")
                        .once()
                        .real()
                        .above(0)
                        .at_most(1),
                    tag("thermal_accommodation_coeff", "accommodation coefficient of energy")
                        .once()
                        .real()
                        .above(0)
                        .at_most(1),
                    tag("useSlipCoeffs", "false: no slip").boolean().by_default("true")}),
           tag("do_convective_heat_transfer",
               "heat exchange between a surface and the fluid in front of it with the coefficient "
               "of the two times the spacing per area, without it a quarter of that")
               .boolean(),
           tag("convective_fluid", "the fluid of the exchange").integer().at_least(0),
           tag("convective_solid", "the material with the surface").integer().at_least(0),
           tag("exchange_coefficients", "coefficients of the pairs 0-1, 0-2, ..., 1-2, ...")
               .once()
               .with_children(
                   {tag("momentum", "momentum exchange").once().reals().at_least(0).at_most(1e20),
                    tag("heat", "heat exchange").reals().at_least(0).at_most(1e15)})});
}

void check_ice_exchange(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* exchange = exchange_node(root);
  if (!runs_ice(root)) return;
  const auto nodes = ice_materials(root);
  const int solids = solid_material_count(root);
  const int materials = solids + static_cast<int>(nodes.size());
  const DeckNode* coefficients =
      exchange == nullptr ? nullptr : exchange->child("exchange_coefficients");
  if (coefficients != nullptr) {
    check_count(*coefficients, "momentum", materials, faults);
    check_count(*coefficients, "heat", materials, faults);
  }
  if (materials > 1 && !nodes.empty()) warn_of_no_exchange(*nodes.front(), exchange, faults);
  if (exchange == nullptr) return;
  if (solids == 0)
    check_models(*exchange, nodes, faults);
  else
    check_convective_beside_solids(*exchange, solids, materials, faults);
}

}  // namespace sluice::ice
