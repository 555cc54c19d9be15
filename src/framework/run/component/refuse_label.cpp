// What is told of it.
#include "framework/run/component/refuse_label.hpp"

#include <fmt/format.h>

#include "framework/deck/faults.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {

void refuse_label(const Location& where, LabelUse use, const std::string& label,
                  const std::vector<std::string>& names) {
  const bool saves = use == LabelUse::save;
  const std::string nearest = suggest_name(label, names);
  throw DeckError(where,
                  fmt::format("<{} label=\"{}\"> names no {} of this run",
                              saves ? "save" : "analyze", label, saves ? "variable" : "field"),
                  nearest.empty() ? "sluice help --labels describes it" : nearest);
}

}  // namespace sluice
