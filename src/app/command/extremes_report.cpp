#include "app/command/extremes_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/archive/extremes/field_extremes.hpp"
#include "framework/archive/extremes/material_sums.hpp"
#include "framework/base/console.hpp"
#include "framework/base/json.hpp"
#include "framework/deck/deck.hpp"
#include "framework/field/component_name.hpp"

namespace sluice {
namespace {

// A deck that cannot be read says nothing: then the volume of cells is taken from saved labels.
bool has_one_material(const Archive& archive) {
  const Deck deck = read_deck((archive.folder() / "input.xml").string());
  const DeckNode* all = deck.root ? deck.root->child("MaterialProperties") : nullptr;
  if (all == nullptr) return false;
  std::size_t materials = 0;
  for (const auto& kind : all->children) materials += kind->all("material").size();
  return materials == 1;
}

std::string full_name(const FieldExtremes& e) {
  const int components = e.field.components();
  if (components == 1) return e.field.name;
  return fmt::format("{}.{}", e.field.name, component_name(components, e.component));
}

std::string short_text(Vec3 v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z);
}

std::string value_text(const std::optional<ValuePlace>& v) {
  return v ? fmt::format("{:.6g}", v->value) : "";
}

std::string place_text(const FieldExtremes& e, const std::optional<ValuePlace>& v) {
  return v ? fmt::format("{} {}", place_text(e.field, *v), short_text(v->at)) : "";
}

std::string number_text(const std::optional<double>& x) {
  return x ? fmt::format("{:.10g}", *x) : "-";
}

Json triple(Vec3 v) {
  return {v.x, v.y, v.z};
}

Json place_json(const std::optional<ValuePlace>& v) {
  if (!v) return nullptr;
  Json j = {{"value", v->value}, {"at", triple(v->at)}};
  if (v->particle >= 0)
    j["particle"] = v->particle;
  else
    j["index"] = Json{v->index.x, v->index.y, v->index.z};
  return j;
}

Json optional_json(const std::optional<double>& x) {
  return x ? Json(*x) : Json(nullptr);
}

}  // namespace

std::string extremes_text(const Archive& archive, const ArchiveStep& step) {
  using Align = TextTable::Align;
  TextTable table({{"label"},
                   {"material", Align::right},
                   {"level", Align::right},
                   {"least", Align::right},
                   {"where"},
                   {"largest", Align::right},
                   {"where"},
                   {"not a number", Align::right}});
  for (const FieldExtremes& e : all_extremes(step))
    table.row({full_name(e), std::to_string(e.field.material), std::to_string(e.field.level),
               value_text(e.least), place_text(e, e.least), value_text(e.most),
               place_text(e, e.most), e.not_numbers > 0 ? human_count(e.not_numbers) : ""});
  std::string text = fmt::format("extremes of step {}, t = {:.10g}\n{}", step.info().step,
                                 step.info().time, table.text("  "));
  TextTable sums({{"material", Align::right},
                  {"over"},
                  {"volume", Align::right},
                  {"mass", Align::right},
                  {"momentum"}});
  std::set<std::string> missing;
  for (const MaterialSums& s : material_sums(step, has_one_material(archive))) {
    const std::string momentum = s.momentum
                                     ? fmt::format("({:.10g}, {:.10g}, {:.10g})", s.momentum->x,
                                                   s.momentum->y, s.momentum->z)
                                     : "-";
    sums.row({std::to_string(s.material), s.particles ? "particles" : "cells",
              number_text(s.volume), number_text(s.mass), momentum});
    missing.insert(s.missing.begin(), s.missing.end());
  }
  text += "sums, each place once, on its finest level\n" + sums.text("  ");
  if (!missing.empty())
    text += fmt::format("  - : not known without {} in the list of saved labels\n",
                        fmt::join(missing, ", "));
  return text;
}

Json extremes_json(const Archive& archive, const ArchiveStep& step) {
  Json extremes = Json::array(), sums = Json::array();
  for (const FieldExtremes& e : all_extremes(step))
    extremes.push_back({{"label", e.field.name},
                        {"component", component_name(e.field.components(), e.component)},
                        {"material", e.field.material},
                        {"level", e.field.level},
                        {"unit", e.field.unit},
                        {"values", e.values},
                        {"not_numbers", e.not_numbers},
                        {"least", place_json(e.least)},
                        {"largest", place_json(e.most)}});
  for (const MaterialSums& s : material_sums(step, has_one_material(archive)))
    sums.push_back({{"material", s.material},
                    {"over", s.particles ? "particles" : "cells"},
                    {"volume", optional_json(s.volume)},
                    {"mass", optional_json(s.mass)},
                    {"momentum", s.momentum ? triple(*s.momentum) : Json(nullptr)},
                    {"missing", s.missing}});
  return {{"step", step.info().step},
          {"time", step.info().time},
          {"extremes", extremes},
          {"sums", sums}};
}

}  // namespace sluice
