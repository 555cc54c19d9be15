// DataArchiver: what is kept, when and how.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/format_labels.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/spelling.hpp"

namespace sluice {
namespace {

TagSpec save() {
  return tag("save", "a variable that is written at every output")
      .multiple()
      .with_attributes(
          {attribute("label", "name of the variable").once().text(),
           attribute("material", "indices of the materials; absent: all").index_set(),
           attribute("levels", "indices of the levels, -1 the finest; absent: all").index_set(),
           attribute("compression",
                     "gzip or empty (no compression); absent: as chosen for the archive")
               .words({"gzip", ""}),
           attribute("table_lookup", "accepted without effect").boolean()});
}

TagSpec checkpoint() {
  return tag("checkpoint", "states from which the run can be restarted; exactly one interval")
      .with_attributes(
          {attribute("interval", "time between checkpoints").real().at_least(0).unit("time"),
           attribute("timestepInterval", "steps between checkpoints").integer().at_least(0),
           attribute("walltimeInterval", "wall-clock time between checkpoints")
               .real()
               .at_least(0)
               .unit("s"),
           attribute("walltimeStart", "wall-clock time of the first checkpoint")
               .real()
               .at_least(0)
               .unit("s"),
           attribute("walltimeIntervalHours", "as walltimeInterval").real().at_least(0).unit("h"),
           attribute("walltimeStartHours", "as walltimeStart").real().at_least(0).unit("h"),
           attribute("cycle", "how many checkpoints are kept; 0: all")
               .integer()
               .at_least(0)
               .by_default("2"),
           attribute("lastTimestep", "a checkpoint at the end of the run")
               .boolean()
               .by_default("false")});
}

bool listed(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void add_output_tags(Schema& schema) {
  schema.add(
      tag("DataArchiver", "what is saved, when and how")
          .once()
          .attribute(attribute("type", "format of the archive").words({"UDA"}).not_built({"PIDX"}))
          .exactly_one({"outputInterval", "outputTimestepInterval"})
          .with_children(
              {tag("filebase", "name of the archive's folder").once().text(),
               tag("outputInterval", "time between outputs; 0: none")
                   .real()
                   .at_least(0)
                   .unit("time"),
               tag("outputTimestepInterval", "steps between outputs; 0: none")
                   .integer()
                   .at_least(0),
               tag("outputInitTimestep", "present: the state at the start is written too"),
               tag("outputLastTimestep", "the state at the end is written too")
                   .boolean()
                   .by_default("false"),
               tag("outputDoubleAsFloat",
                   "present: outputs (never checkpoints) are written in single precision"),
               tag("compression", "compression of the data").words({"gzip", ""}), save(),
               checkpoint(),
               tag("frequency", "steps between lines of .dat files")
                   .integer()
                   .at_least(1)
                   .by_default("1"),
               tag("onTimeStep", "offset of the steps that write lines of .dat files")
                   .integer()
                   .at_least(0)
                   .by_default("0"),
               tag("timeStep", "lines of .dat files begin with the step's number")
                   .boolean()
                   .by_default("false"),
               tag("simTime", "lines of .dat files hold the time").boolean().by_default("true")}));
  schema.rules.emplace_back(check_checkpoint);
  schema.rules.emplace_back(check_filebase);
  schema.rules.emplace_back(check_saves);
}

// Whether the sets of indices have one in common, as far as the deck alone can tell; empty: all.
bool overlap(const DeckNode& a, const DeckNode& b, const char* name) {
  const auto one = parse_index_set(a.attribute(name).value_or(""));
  const auto other = parse_index_set(b.attribute(name).value_or(""));
  if (!one || !other) return false;
  if (one.value->empty() || other.value->empty()) return true;
  for (const IndexInterval& x : *one.value)
    for (const IndexInterval& y : *other.value)
      if (x.low <= y.high && y.low <= x.high) return true;
  return false;
}

// A label may be saved for several materials or levels, one <save> each.
void check_saves(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* archiver = root.child("DataArchiver");
  if (archiver == nullptr) return;
  const auto saves = archiver->all("save");
  for (auto save = saves.begin(); save != saves.end(); ++save) {
    const auto first = std::find_if(saves.begin(), save, [&](const DeckNode* before) {
      return before->attribute("label") == (*save)->attribute("label") &&
             overlap(*before, **save, "material") && overlap(*before, **save, "levels");
    });
    if (first == save || !(*save)->attribute("label")) continue;
    add_warning(faults, (*save)->where,
                fmt::format("{} is saved already, by the line at {}",
                            in_quotes(*(*save)->attribute("label")), to_string((*first)->where)),
                "remove one of them");
  }
}

// An archive's folder must stay within the folder that the user chose for it.
void check_filebase(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* node = root.find("DataArchiver/filebase");
  if (node == nullptr) return;
  const std::filesystem::path base = node->text;
  const bool climbs =
      std::any_of(base.begin(), base.end(), [](const auto& p) { return p == ".."; });
  if (!climbs && !base.is_absolute()) return;
  add_error(faults, node->where,
            fmt::format("<filebase> {} leads outside the folder of the run's archives",
                        in_quotes(node->text)),
            "give only the name of the archive, such as run.uda, and its parent folder with -o");
}

void check_checkpoint(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* node = root.find("DataArchiver/checkpoint");
  if (node == nullptr) return;
  std::vector<std::string> intervals;
  for (const char* name :
       {"interval", "timestepInterval", "walltimeInterval", "walltimeIntervalHours"}) {
    if (node->attribute(name)) intervals.emplace_back(name);
  }
  const bool last = node->attribute("lastTimestep") == "true";
  if (intervals.empty() && !last) {
    add_error(faults, node->where, "<checkpoint> has no interval",
              "give one of interval, timestepInterval, walltimeInterval, walltimeIntervalHours");
  } else if (intervals.size() > 1) {
    add_error(faults, node->where,
              fmt::format("<checkpoint> has several intervals: {}", fmt::join(intervals, ", ")),
              "keep one of them");
  }
  for (const char* unit : {"", "Hours"}) {
    const std::string start = std::string("walltimeStart") + unit;
    const std::string interval = std::string("walltimeInterval") + unit;
    if (node->attribute(start) && !node->attribute(interval)) {
      add_error(faults, node->where,
                fmt::format("<checkpoint> has {} without {}", start, interval));
    }
  }
}

DeckRule check_analysed_labels(FieldLabels labels) {
  return [labels = std::move(labels)](const DeckNode& root, std::vector<Fault>& faults) {
    const auto check = [&](const DeckNode& node) {
      const auto label = node.attribute("label");
      if (!label || listed(labels.built, *label)) return;
      if (const ForeignLabel* foreign = find_foreign_label(*label)) {
        Fault fault{Severity::error, node.where, refusal_of(*foreign, *label), foreign->instead};
        fault.not_built = true;
        faults.push_back(std::move(fault));
      } else if (listed(labels.not_built, *label) || label->starts_with("p.") ||
                 label->starts_with("g.")) {
        add_not_built(faults, node.where, "variable " + in_quotes(*label));
      } else {
        add_error(faults, node.where, fmt::format("there is no variable {}", in_quotes(*label)),
                  suggest_name(*label, labels.built));
      }
    };
    const DeckNode* analysis = root.child("DataAnalysis");
    if (analysis == nullptr) return;
    for (const DeckNode* module : analysis->all("Module")) {
      for (const char* name : {"weight", "velocity"})
        if (const DeckNode* node = module->child(name)) check(*node);
      const DeckNode* variables = module->child("Variables");
      if (variables == nullptr) continue;
      for (const DeckNode* node : variables->all("analyze")) check(*node);
    }
  };
}

DeckRule check_saved_labels(std::function<std::vector<std::string>(const DeckNode& root)> known) {
  return [known = std::move(known)](const DeckNode& root, std::vector<Fault>& faults) {
    const DeckNode* archiver = root.child("DataArchiver");
    if (archiver == nullptr) return;
    std::vector<std::string> names = known(root);
    for (std::string& label : labels_of_analyses(root)) names.push_back(std::move(label));
    const auto any_spelling = [&](const std::string& label) {
      return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return plain_spelling(name) == plain_spelling(label);
      });
    };
    for (const DeckNode* save : archiver->all("save")) {
      const auto label = save->attribute("label");
      if (!label || any_spelling(*label) || format_has_label(*label)) continue;
      add_error(faults, save->where, fmt::format("there is no variable {}", in_quotes(*label)),
                suggest_name(*label, names));
    }
  };
}

}  // namespace sluice
