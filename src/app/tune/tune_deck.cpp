// Edits of a deck's text at the places of its tags. The deck has been read without a fault before,
// so that its tags are known to be well formed.
#include "app/tune/tune_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "app/tune/tune_candidates.hpp"
#include "app/tune/tune_xml.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace sluice {
namespace {

using solve::SolverSettings;

constexpr const char* variable = "implicitPressure";

struct Tag {
  std::string name, value;
  bool if_there = false;  // replaced where the deck has it, else left out
};

// What <Parameters> must say so that a deck which said `deck` says `to`.
std::vector<Tag> parameters_of(const SolverSettings& to, const SolverSettings& deck) {
  std::vector<Tag> tags;
  if (to.type == "hypre") {
    tags.push_back({"solver", to.solver});
    tags.push_back({"preconditioner", to.preconditioner});
  }
  const auto number = [&](const char* name, int value, int before) {
    if (value != before) tags.push_back({name, std::to_string(value)});
  };
  number("npre", to.before, deck.before);
  number("npost", to.after, deck.after);
  number("skip", to.skip, deck.skip);
  number("relax_type", to.relax_type, deck.relax_type);
  number("precond_maxiters", to.preconditioner_iterations, deck.preconditioner_iterations);
  if (to.preconditioner_tolerance != deck.preconditioner_tolerance)
    tags.push_back({"precond_tolerance", shortest_text(to.preconditioner_tolerance)});
  if (to.tolerance != deck.tolerance || to.absolute_tolerance != deck.absolute_tolerance)
    tags.push_back({"tolerance", shortest_text(to.tolerance)});
  // Under hypre these have no effect and may say anything; a change of solver must not wake them.
  if (to.type != deck.type && to.norm == solve::Norm::two) {
    tags.push_back({"norm", "L2", true});
    tags.push_back({"criteria", "Relative", true});
  }
  return tags;
}

const XmlSpan* parameters_in(const XmlSpan* block) {
  if (block == nullptr) return nullptr;
  for (const XmlSpan& child : block->children)
    if (child.name == "Parameters") {
      const auto named = child.attribute("variable");
      if (!named || named->value == variable) return &child;
    }
  return nullptr;
}

void set_parameters(XmlEdits& edits, const XmlSpan& block, const std::vector<Tag>& tags) {
  for (const Tag& tag : tags) {
    const XmlSpan* found = block.child(tag.name);
    if (found != nullptr)
      edits.set_text(*found, tag.value);
    else if (!tag.if_there)
      edits.add_child(block, fmt::format("<{0}>{1}</{0}>", tag.name, tag.value));
  }
}

}  // namespace

std::string solver_xml(const SolverSettings& s) {
  std::string text =
      fmt::format("<Solver type=\"{}\"/>\n<Parameters variable=\"{}\">\n", s.type, variable);
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("  <{0}>{1}</{0}>\n", name, value);
  };
  if (s.type == "hypre") {
    line("solver", s.solver);
    line("preconditioner", s.preconditioner);
  }
  if (works_with(s, "pfmg") || works_with(s, "smg")) {
    line("npre", std::to_string(s.before));
    line("npost", std::to_string(s.after));
  }
  if (works_with(s, "pfmg")) {
    line("relax_type", std::to_string(s.relax_type));
    line("skip", std::to_string(s.skip));
  }
  const bool absolute = s.absolute_tolerance > 0;
  line("tolerance", shortest_text(absolute ? s.absolute_tolerance : s.tolerance));
  if (absolute) line("criteria", "Absolute");
  if (s.norm != solve::Norm::two) line("norm", s.norm == solve::Norm::one ? "L1" : "LInfinity");
  line("maxiterations", std::to_string(s.max_iterations));
  return text + "</Parameters>\n";
}

std::string tuned_deck(const std::string& text, const std::string& name, const SolverSettings& deck,
                       const SolverSettings& solver) {
  const XmlSpan root = xml_elements(text);
  const XmlSpan* block = root.find({"CFD", "ICE", "ImplicitSolver"});
  if (block == nullptr) block = root.find({"SolverTest"});
  if (block == nullptr)
    throw InputError(
        fmt::format("--apply: {} has no <ImplicitSolver> in its own text (it may come from an "
                    "<include>); paste the tags into the file that has it",
                    name));
  XmlEdits edits(text);
  const XmlSpan* named = root.child("Solver");
  if (named == nullptr) {
    if (solver.type != SolverSettings{}.type)
      edits.add_before(root.children.front(), fmt::format("<Solver type=\"{}\"/>", solver.type));
  } else if (const auto type = named->attribute("type")) {
    edits.set_attribute(*type, solver.type);
  } else {
    throw InputError(fmt::format("--apply: the <Solver> of {} has no type", name));
  }
  const std::vector<Tag> tags = parameters_of(solver, deck);
  const XmlSpan* parameters = parameters_in(block);
  if (parameters == nullptr) parameters = parameters_in(named);
  if (parameters != nullptr) {
    set_parameters(edits, *parameters, tags);
  } else {
    std::string lines;
    for (const Tag& t : tags)
      if (!t.if_there) lines += fmt::format("<{0}>{1}</{0}>", t.name, t.value);
    if (!lines.empty())
      edits.add_child(*block,
                      fmt::format("<Parameters variable=\"{}\">{}</Parameters>", variable, lines));
  }
  return edits.result();
}

}  // namespace sluice
