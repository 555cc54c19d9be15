#include "app/plan/switched_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/command/effect_table.hpp"
#include "framework/base/console.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

bool has(const std::vector<std::string>& list, const std::string& label) {
  return std::find(list.begin(), list.end(), label) != list.end();
}

// What becomes of a variable that the deck names.
std::string fate_of(const std::string& label, const std::vector<PassedOn>& kinds) {
  for (const PassedOn& p : kinds) {
    if (has(p.carried, label)) return "kept: both components carry it";
    if (has(p.at_start, label)) return "zero, as at the start of a run";
    if (has(p.dropped, label)) return "dropped: the component does not use it";
  }
  if (label.starts_with("g.")) return "computed again from the particles in every step";
  return "nothing to do: the component has no such variable";
}

std::vector<std::string> named_in(const DeckNode& component, const DeckNode& part,
                                  const std::vector<PassedOn>& kinds) {
  std::vector<std::string> lines;
  for (const DeckNode* init : part.all("init")) {
    const std::string label = init->attribute("var").value_or("");
    lines.push_back(fmt::format("init {}: {}", label, fate_of(label, kinds)));
  }
  for (const DeckNode* carry : component.all("carry_over")) {
    const std::string label = carry->attribute("var").value_or("");
    lines.push_back(fmt::format("carry_over {}: {}", label, fate_of(label, kinds)));
  }
  return lines;
}

}  // namespace

std::vector<PlannedPart> plan_parts(const LoadedScene& run) {
  std::vector<PlannedPart> parts;
  if (run.parts.empty()) return parts;
  const DeckNode& component = run.deck.root->need("SimulationComponent");
  const std::vector<const DeckNode*> nodes = component.all("subcomponent");
  const Component* before = nullptr;
  for (std::size_t n = 0; n < run.parts.size(); ++n) {
    const Component& own = n == 0 ? *run.component : *run.later[n - 1]->component;
    PlannedPart& part = parts.emplace_back();
    part.component = own.name();
    part.deck = run.parts[n].deck.file;
    part.after = run.parts[n].after;
    if (before != nullptr) {
      part.passed_on = passed_on(*before->particles(), *own.particles());
      part.named = named_in(component, *nodes[n], part.passed_on);
    }
    before = &own;
  }
  return parts;
}

std::string parts_text(const std::vector<PlannedPart>& parts) {
  TextTable table({{"component"}, {"from step"}, {"deck"}});
  for (const PlannedPart& p : parts) table.row({p.component, std::to_string(p.after + 1), p.deck});
  std::string text = table.text("  ");
  for (const PlannedPart& p : parts)
    for (const PassedOn& kind : p.passed_on)
      text += fmt::format(
          "  {} takes over particles of '{}': {} carried{}{}\n", p.component, kind.kind,
          fmt::join(kind.carried, ", "),
          kind.at_start.empty()
              ? ""
              : fmt::format("; {} zero, as at the start of a run", fmt::join(kind.at_start, ", ")),
          kind.dropped.empty() ? "" : fmt::format("; {} dropped", fmt::join(kind.dropped, ", ")));
  for (const PlannedPart& p : parts)
    for (const std::string& line : p.named) text += "  " + line + "\n";
  return text +
         "  grid, output and times of the run are those of the switcher's deck, limits of the time "
         "step those of\n  each component's deck; the rest of the plan is for the first "
         "component\n";
}

Json parts_json(const std::vector<PlannedPart>& parts) {
  Json list = Json::array();
  for (const PlannedPart& p : parts) {
    Json kinds = Json::array();
    for (const PassedOn& kind : p.passed_on)
      kinds.push_back({{"name", kind.kind},
                       {"carried", kind.carried},
                       {"at_start", kind.at_start},
                       {"dropped", kind.dropped}});
    list.push_back({{"component", p.component},
                    {"deck", p.deck},
                    {"after", p.after},
                    {"particles", kinds},
                    {"named", p.named}});
  }
  return list;
}

}  // namespace sluice
