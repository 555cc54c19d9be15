// <contact> with its profile files.
#include <fmt/format.h>

#include "framework/base/data_lines.hpp"
#include "framework/deck/data_file.hpp"
#include "framework/scene/deck_values.hpp"
#include "mpm/deck/readers.hpp"

namespace sluice::mpm {
namespace {

ContactKind kind_of(const std::string& type) {
  if (type == "null") return ContactKind::none;
  if (type == "single_velocity") return ContactKind::single_velocity;
  if (type == "specified") return ContactKind::specified;
  if (type == "specified_friction") return ContactKind::specified_friction;
  return ContactKind::friction;
}

void read_friction(const DeckNode& node, ContactRule& rule) {
  rule.friction = real_or(node, "mu", 0);
  rule.volume_constraint = real_or(node, "volume_constraint", 0);
  rule.separation_factor = real_or(node, "separation_factor", rule.separation_factor);
  if (const DeckNode* list = node.child("variable_friction"))
    for (const DeckNode* entry : list->all("entry"))
      rule.friction_of_colour.emplace_back(entry->real("color"), entry->real("mu"));
}

void read_master(const DeckNode& node, ContactRule& rule, std::vector<Fault>& faults) {
  rule.master = integer_or(node, "master_material", 0);
  rule.rotates = boolean_or(node, "include_rotation", false);
  rule.normal_only = boolean_or(node, "normal_only", false);
  rule.directions = int_vector_or(node, "direction", rule.directions);
  if (const DeckNode* stop = node.child("stop_time")) rule.stop_time = stop->as_real();
  rule.velocity_after_stop = vector_or(node, "velocity_after_stop", {});
  const DeckNode* file = node.child("filename");
  if (file == nullptr || file->text.empty()) return;
  rule.profile_file = data_file(*file, faults);
  if (rule.profile_file.empty()) return;
  collect(faults, file->where,
          [&] { rule.profile = read_profile(rule.profile_file, rule.rotates); });
}

ContactRule read_contact(const DeckNode& node, int materials, std::vector<Fault>& faults) {
  ContactRule rule;
  rule.where = node.where;
  rule.type = node.string("type");
  rule.kind = kind_of(rule.type);
  if (const DeckNode* list = node.child("materials"))
    for (const double index : list->as_reals())
      if (index < materials) rule.materials.push_back(static_cast<int>(index));
  const bool by_master =
      rule.kind == ContactKind::specified || rule.kind == ContactKind::specified_friction;
  rule.applied_before_and_after_integration =
      integer_or(node, "OneOrTwoStep", by_master ? 1 : 2) == 2;
  if (const DeckNode* excluded = node.child("ExcludeMaterial"))
    rule.exclude = excluded->as_integer();
  read_friction(node, rule);
  if (by_master) read_master(node, rule, faults);
  return rule;
}

}  // namespace

std::vector<std::array<double, 10>> read_profile(const std::string& file, bool rotates) {
  std::vector<std::array<double, 10>> rows;
  std::vector<std::string> columns = {"time", "velocity x", "velocity y", "velocity z"};
  if (rotates)
    for (const char* more : {"origin x", "origin y", "origin z", "angular velocity x",
                             "angular velocity y", "angular velocity z"})
      columns.emplace_back(more);
  read_table(file, columns, [&](const TableRow& numbers) {
    std::array<double, 10> row{};
    for (std::size_t n = 0; n < columns.size(); ++n) row[n] = numbers[n];
    if (!rows.empty() && !(row[0] > rows.back()[0]))
      numbers.refuse(
          0, fmt::format("time {:g} is not after the one before, {:g}", row[0], rows.back()[0]));
    rows.push_back(row);
  });
  return rows;
}

void read_contacts(const DeckNode& block, MpmScene& s, std::vector<Fault>& faults) {
  for (const DeckNode* node : block.all("contact")) {
    ContactRule rule = read_contact(*node, static_cast<int>(s.materials.size()), faults);
    const bool listed = node->child("materials") != nullptr;
    // What acts on nothing is left out; an empty list would mean all.
    if (rule.kind == ContactKind::none || (listed && rule.materials.empty())) continue;
    s.contacts.push_back(std::move(rule));
  }
  s.thermal_contact = s.thermal_contact || block.child("thermal_contact") != nullptr;
}

}  // namespace sluice::mpm
