#include "peridynamics/peridigm/parameters.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "framework/base/error.hpp"
#include "framework/deck/xml_reader.hpp"

namespace sluice::peridynamics {
namespace {

constexpr int deepest = 50;

Location at(const std::string& file, const YAML::Mark& mark) {
  return {file, mark.line + 1, mark.column + 1};
}

Parameter of_yaml(const std::string& name, const YAML::Node& key, const YAML::Node& node,
                  const std::string& file, int depth) {
  Parameter p;
  p.name = name;
  p.where = at(file, key.Mark());
  if (depth > deepest) throw InputError(to_string(p.where) + ": lists inside lists are too deep");
  if (node.IsMap()) {
    p.is_list = true;
    for (const auto& child : node)
      p.children.push_back(
          of_yaml(child.first.as<std::string>(), child.first, child.second, file, depth + 1));
  } else if (node.IsScalar()) {
    p.text = node.as<std::string>();
  } else if (!node.IsNull()) {
    throw InputError(to_string(p.where) + ": '" + name + "' is a sequence; decks have values and " +
                     "lists of named parameters");
  }
  return p;
}

Parameter of_xml(const DeckNode& node) {
  Parameter p;
  p.name = node.attribute("name").value_or("");
  p.where = node.where;
  if (node.name == "ParameterList") {
    p.is_list = true;
    for (const auto& child : node.children) p.children.push_back(of_xml(*child));
  } else if (node.name == "Parameter") {
    if (!node.attribute("name") || !node.attribute("value"))
      throw InputError(to_string(node.where) + ": <Parameter> needs name and value");
    p.text = *node.attribute("value");
  } else {
    throw InputError(fmt::format("{}: <{}> is neither <ParameterList> nor <Parameter>",
                                 to_string(node.where), node.name));
  }
  return p;
}

Parameter from_yaml(const std::string& text, const std::string& file) {
  try {
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) throw InputError(file + ": this is no tree of parameters");
    Parameter all = of_yaml("", root, root, file, 0);
    for (const Parameter& child : all.children)
      if (child.name == "Peridigm" && child.is_list) return child;
    return all;
  } catch (const YAML::Exception& e) {
    throw InputError(to_string(at(file, e.mark)) + ": this YAML cannot be read: " + e.msg);
  }
}

Parameter from_xml(const std::string& text, const std::string& file) {
  ReadBudget budget;
  const XmlTree tree = read_xml_text(text, file, budget);
  if (tree.root == nullptr)
    throw InputError(tree.faults.empty() ? file + ": this XML cannot be read"
                                         : to_string(tree.faults.front()));
  return of_xml(*tree.root);
}

}  // namespace

const Parameter* Parameter::find(std::string_view child) const {
  for (const Parameter& p : children)
    if (p.name == child) {
      p.known = true;
      return &p;
    }
  return nullptr;
}

Parameter read_parameters_text(const std::string& text, bool yaml, const std::string& shown_name) {
  return yaml ? from_yaml(text, shown_name) : from_xml(text, shown_name);
}

Parameter read_parameters(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError("the deck '" + file + "' cannot be opened");
  std::ostringstream text;
  text << in.rdbuf();
  return read_parameters_text(text.str(), file.ends_with(".yaml") || file.ends_with(".yml"), file);
}

}  // namespace sluice::peridynamics
