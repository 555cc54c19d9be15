#include "app/loading/exact_solution_tag.hpp"

#include <map>
#include <memory>
#include <set>

#include "exact/exact_solutions.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

std::set<std::string> all_parameters() {
  std::set<std::string> names;
  for (const auto& help : exact::exact_solution_help())
    for (const auto& parameter : help.parameters) names.insert(parameter.name);
  return names;
}

void check_exact_solution(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* node = root.find("Meta/exact_solution");
  if (!node || !node->attribute("type")) return;
  std::map<std::string, std::string> values;
  const std::set<std::string> known = all_parameters();
  for (const auto& child : node->children)
    if (known.count(child->name) == 0) return;  // told as an unknown tag
  for (const auto& child : node->children) values[child->name] = child->text;
  try {
    exact::make_exact_solution({*node->attribute("type"), std::move(values)});
  } catch (const InputError& problem) {
    Fault fault;
    fault.where = node->where;
    fault.message = problem.what();
    faults.push_back(std::move(fault));
  }
}

}  // namespace

void describe_exact_solution(Schema& schema) {
  std::vector<std::string> types;
  std::map<std::string, std::string> parameters;  // of all types, with what they mean
  for (const auto& help : exact::exact_solution_help()) {
    types.push_back(help.type);
    for (const auto& parameter : help.parameters) {
      std::string& meaning = parameters[parameter.name];
      meaning += (meaning.empty() ? "" : "; ") + help.type + ": " + parameter.meaning;
    }
  }
  TagSpec solution =
      tag("exact_solution", "the exact or reference solution, for pictures and errors")
          .attribute(attribute("type", "which one").once().words(types));
  for (const auto& [name, meaning] : parameters) {
    solution = solution.child(tag(name, meaning).text());
  }
  for (const auto& help : exact::exact_solution_help()) {
    std::vector<TagSpec> read;
    for (const auto& parameter : help.parameters)
      read.push_back(tag(parameter.name, parameter.meaning).text());
    solution.laws.emplace_back(help.type, std::move(read));
  }
  schema.add(tag("Meta", "about the deck").child(solution));
  schema.rules.push_back(check_exact_solution);
}

}  // namespace sluice
