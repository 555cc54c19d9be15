// One particle along the path of a deck.
#include "mpm/material/material_driver.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/scene/deck_values.hpp"
#include "mpm/material/materials.hpp"

namespace sluice::mpm {
namespace {

TagSpec driver_tag() {
  const TagSpec material =
      tag("material", "as in <MaterialProperties>, without its bodies")
          .once()
          .attribute(attribute("name", "free text, without effect").text())
          .child(positive("density", "initial temperature").unit("kg/m^3"))
          .child(positive_or("specific_heat", "c_v", 1000).unit("J/kg/K"))
          .child(tag("thermal_conductivity", "without effect here").real())
          .child(number("linear_thermal_expansion_coef", "alpha_t", 0).unit("1/K"))
          .child(number("room_temp", "temperature without thermal strain", 294).unit("K"))
          .child(number("melt_temp", "melting temperature", 295e10).unit("K"))
          .child(constitutive_model_tag())
          .with_children(failure_tags());
  const TagSpec piece =
      tag("piece", "a part of the path; consecutive pieces")
          .at_least_once()
          .child(positive("duration", "duration of the piece").unit("s"))
          .child(tag("steps", "number of equal time steps in the piece")
                     .integer()
                     .at_least(1)
                     .by_default("100"))
          .child(tag("velocity_gradient", "L, nine numbers row after row, for the whole piece")
                     .reals()
                     .unit("1/s"))
          .child(tag("deformation", "F at the end, nine numbers: F changes linearly to it").reals())
          .child(tag("rotation", "axis of a rigid rotation").vector())
          .child(number("angle", "angle of the rotation, degrees", 0))
          .not_both({"velocity_gradient", "deformation"});
  return tag("MaterialDriver", "one particle of a material along a path of deformation")
      .once()
      .child(material)
      .child(number("temperature", "initial temperature", 300).above(0).unit("K"))
      .child(choice("isothermal", "whether heat of the law is removed from the particle at once",
                    false))
      .child(piece);
}

std::optional<Matrix> matrix_of(const DeckNode& piece, const char* name,
                                std::vector<Fault>& faults) {
  const DeckNode* node = piece.child(name);
  if (node == nullptr) return std::nullopt;
  const std::vector<double> values = node->as_reals();
  Matrix m{};
  if (values.size() == 9) {
    std::copy(values.begin(), values.end(), m.begin());
    return m;
  }
  add_error(faults, node->where,
            fmt::format("<{}>: {} numbers, expected nine", name, values.size()),
            "row by row: xx, xy, xz, yx, ...");
  return std::nullopt;
}

PathPiece read_piece(const DeckNode& node, std::vector<Fault>& faults) {
  PathPiece piece;
  piece.duration = node.real("duration");
  piece.steps = node.integer("steps");
  piece.velocity_gradient = matrix_of(node, "velocity_gradient", faults);
  piece.deformation = matrix_of(node, "deformation", faults);
  if (piece.deformation && !(determinant(*piece.deformation) > 0))
    add_error(faults, node.child("deformation")->where,
              fmt::format("<deformation>: det F = {:.6g}, expected greater than 0",
                          determinant(*piece.deformation)));
  const Vec3 axis = vector_or(node, "rotation", {0, 0, 1});
  piece.axis = {axis[0], axis[1], axis[2]};
  if (axis[0] == 0 && axis[1] == 0 && axis[2] == 0)
    add_error(faults, node.child("rotation")->where, "<rotation>: the axis is a zero vector");
  piece.angle = real_or(node, "angle", 0) * 3.14159265358979323846 / 180;
  return piece;
}

}  // namespace

Schema driver_schema() {
  Schema schema;
  schema.root =
      schema.root.child(driver_tag())
          .child(tag("Meta", "free text, without effect").child(tag("title", "heading").text()));
  return schema;
}

std::optional<DriverDeck> read_driver_deck(const std::string& file,
                                           const std::vector<std::string>& overrides,
                                           std::vector<Fault>& faults) {
  const Deck loaded = load_deck(file, overrides, driver_schema());
  faults.insert(faults.end(), loaded.faults.begin(), loaded.faults.end());
  if (!loaded.good()) return std::nullopt;
  const DeckNode& driver = loaded.root->need("MaterialDriver");
  const DeckNode& material = driver.need("material");
  DriverDeck deck;
  if (const DeckNode* title = loaded.root->find("Meta/title")) deck.title = title->text;
  MaterialConstants& c = deck.constants;
  c.density = material.real("density");
  c.specific_heat = real_or(material, "specific_heat", 1000);
  c.conductivity = real_or(material, "thermal_conductivity", 0);
  c.thermal_expansion = real_or(material, "linear_thermal_expansion_coef", 0);
  c.room_temperature = real_or(material, "room_temp", 294);
  c.melt_temperature = real_or(material, "melt_temp", 295e10);
  deck.law = material.need("constitutive_model").attribute("type").value_or("");
  deck.material = make_material(material.need("constitutive_model"), material, c, faults);
  deck.temperature = real_or(driver, "temperature", 300);
  deck.isothermal = boolean_or(driver, "isothermal", false);
  for (const DeckNode* piece : driver.all("piece")) deck.path.push_back(read_piece(*piece, faults));
  if (any_error(faults)) return std::nullopt;
  return deck;
}

namespace {

std::vector<std::string> columns_of(const Material& law) {
  std::vector<std::string> names = {"time"};
  const char* axes[9] = {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
  for (const char* a : axes) names.push_back(fmt::format("F_{}", a));
  for (const char* a : {"xx", "yy", "zz", "yz", "xz", "xy"})
    names.push_back(fmt::format("stress_{}", a));
  for (const char* name : {"pressure", "equivalent_stress", "energy", "temperature", "wave_speed"})
    names.emplace_back(name);
  for (const HistoryColumn& h : law.history())
    for (int k = 0; k < h.components; ++k)
      names.push_back(h.components == 1 ? h.label.name() : fmt::format("{}_{}", h.label.name(), k));
  return names;
}

std::vector<double> row_of(const MaterialSample& s) {
  std::vector<double> row = {s.time()};
  for (const double x : s.F()) row.push_back(x);
  for (const double x : s.stress()) row.push_back(x);
  for (const double x : {s.pressure(), s.equivalent(), s.energy(), s.temperature(), s.wave_speed()})
    row.push_back(x);
  for (int k = 0; k < s.history_columns(); ++k) row.push_back(s.history(k));
  return row;
}

}  // namespace

DriverTable drive(const DriverDeck& deck) {
  DriverTable table;
  table.columns = columns_of(*deck.material);
  MaterialSample sample(deck.material, deck.constants, 1, deck.temperature);
  sample.keep_temperature(deck.isothermal);
  table.rows.push_back(row_of(sample));
  for (const PathPiece& piece : deck.path) {
    const Matrix from = sample.F();
    const double start = sample.time();
    for (int n = 1; n <= piece.steps; ++n) {
      const double share = static_cast<double>(n) / piece.steps;
      Matrix F = from;
      if (piece.velocity_gradient) {
        Matrix L = *piece.velocity_gradient;
        for (double& x : L) x *= share * piece.duration;
        F = product(exponential(L), from);
      } else if (piece.deformation) {
        for (std::size_t k = 0; k < 9; ++k) F[k] += share * ((*piece.deformation)[k] - from[k]);
      }
      if (piece.angle != 0) F = product(rotation(piece.axis, share * piece.angle), F);
      const auto fault = sample.step(F, piece.duration / piece.steps);
      if (fault)
        throw PhysicsError(fmt::format("{} refuses the step to t = {:.6g} s: {} ({:.6g})", deck.law,
                                       start + share * piece.duration, fault->reason,
                                       fault->value));
      table.rows.push_back(row_of(sample));
    }
  }
  return table;
}

}  // namespace sluice::mpm
