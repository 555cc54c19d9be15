// Who runs, for how long, under what constants.
#include <fmt/format.h>

#include <map>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/format/switcher.hpp"
#include "framework/deck/rule_tools.hpp"

namespace sluice {
namespace {

// A limit of the time step may ask for an output or a checkpoint when it acts.
TagSpec limit(const std::string& name, const std::string& doc) {
  return tag(name, doc).real().at_least(0).with_attributes(
      {attribute("output", "write an output when this limit acts").boolean(),
       attribute("checkpoint", "write a checkpoint when this limit acts").boolean()});
}

TagSpec time_block() {
  return tag("Time", "run control: start, end and limits of the time step")
      .once()
      .with_children({
          tag("initTime", "time at the start").once().real().at_least(0).unit("time"),
          tag("maxTime", "time at the end").once().real().at_least(0).unit("time"),
          tag("timestep_multiplier", "factor of the time step that the physics allows")
              .once()
              .real()
              .above(0),
          limit("delt_min", "minimum time step; 0: none").once().unit("time"),
          limit("delt_max", "maximum time step; 0: none").once().unit("time"),
          limit("delt_init",
                "maximum time step while t + dt is at most initial_delt_range; 0: none")
              .by_default("0")
              .unit("time"),
          tag("initial_delt_range",
              "time up to which delt_init applies; 0: for the first step only")
              .real()
              .at_least(0)
              .by_default("0")
              .unit("time"),
          limit("max_delt_increase",
                "the next time step is at most (1 + this) times the present "
                "one; 0: no limit")
              .by_default("0"),
          tag("max_Timesteps", "number of steps after which the run ends; 0: no limit")
              .integer()
              .at_least(0)
              .by_default("0")
              .alias("max_Timestep")
              .alias("max_iterations"),
          tag("max_wall_time", "wall-clock time after which the run ends; 0: no limit")
              .real()
              .at_least(0)
              .by_default("0")
              .unit("s"),
          tag("end_at_max_time_exactly", "the last step is shortened to end at maxTime")
              .boolean()
              .by_default("false")
              .alias("end_on_max_time_exactly"),
          tag("clamp_time_to_output", "steps are shortened to meet output and checkpoint times")
              .boolean()
              .by_default("false")
              .alias("clamp_timesteps_to_output"),
          tag("override_restart_delt", "first time step after a restart; 0: the stored one")
              .real()
              .at_least(0)
              .by_default("0")
              .unit("time"),
      });
}

// Components that the format knows, and that are not supported.
const std::vector<std::string> unsupported_components = {"arches",
                                                         "ARCHES",
                                                         "dosweep",
                                                         "DOSWEEP",
                                                         "electrostatic_solver",
                                                         "esmpm2",
                                                         "ESMPM2",
                                                         "esmpm",
                                                         "ESMPM",
                                                         "gauss_solver",
                                                         "gpuresizetest1",
                                                         "heat",
                                                         "mpnp",
                                                         "particletest",
                                                         "PARTICLETEST",
                                                         "phasefield",
                                                         "PHASEFIELD",
                                                         "poisson4",
                                                         "POISSON4",
                                                         "portabledependencytest",
                                                         "portabledependencytest1",
                                                         "postProcessUda",
                                                         "regriddertest",
                                                         "REGRIDDERTEST",
                                                         "RMCRT_Test",
                                                         "rmpm",
                                                         "rigidmpm",
                                                         "RIGIDMPM",
                                                         "smpmice",
                                                         "shellmpmice",
                                                         "SHELLMPMICE",
                                                         "smpm",
                                                         "shellmpm",
                                                         "SHELLMPM",
                                                         "solvertest2",
                                                         "SOLVERTEST2",
                                                         "unifiedschedulertest",
                                                         "UNIFIEDSCHEDULERTEST",
                                                         "wasatch"};

AttributeSpec type_of_component(const std::vector<ComponentWord>& components) {
  AttributeSpec type = attribute("type", "the component").once();
  if (components.empty()) return type.text();
  std::vector<std::string> words;
  for (const ComponentWord& c : components) {
    words.push_back(c.word);
    for (const std::string& spelling : c.spellings) type = type.spelling(spelling, c.word);
  }
  words.emplace_back(switcher_word);
  return type.words(words).not_built(unsupported_components);
}

TagSpec component(const std::vector<ComponentWord>& components) {
  return tag("SimulationComponent", "which component runs")
      .once()
      .attribute(type_of_component(components))
      .with_children(switcher_tags(components));
}

// Public decks give some numbers twice: the first counts.
void keep_first_of_time(DeckNode& root, std::vector<Fault>& faults) {
  DeckNode* time = root.child("Time");
  if (time == nullptr) return;
  std::map<std::string, Location> known;
  std::erase_if(time->children, [&](const std::unique_ptr<DeckNode>& child) {
    const auto [first, fresh] = known.try_emplace(child->name, child->where);
    if (fresh || !child->children.empty()) return false;
    add_warning(faults, child->where,
                fmt::format("second <{}> in <Time>; dropped: the first, at {}, is used",
                            child->name, to_string(first->second)),
                "remove one of them");
    return true;
  });
}

}  // namespace

void add_run_tags(Schema& schema, const std::vector<ComponentWord>& components) {
  schema.root.doc = "the deck: everything about one run";
  schema.add(tag("Meta", "for the reader")
                 .with_children({tag("title", "name of the problem").text(),
                                 tag("info", "what the deck is for").text()}));
  schema.add(component(components));
  schema.add(time_block());
  schema.add(
      tag("PhysicalConstants", "constants of nature and of the reference state")
          .with_children({tag("gravity", "acceleration").once().vector().unit("length/time^2"),
                          tag("reference_pressure", "pressure of the undisturbed state")
                              .real()
                              .at_least(0)
                              .unit("pressure"),
                          tag("reference_point", "point that has the reference pressure")
                              .vector()
                              .unit("length")}));
  schema.add(tag("SimulationController", "how often a line per step is printed")
                 .child(tag("RuntimeStats", "the line printed for a step")
                            .with_children({tag("frequency", "print every so many steps")
                                                .integer()
                                                .at_least(1)
                                                .by_default("1"),
                                            tag("onTimeStep", "offset of the printed steps")
                                                .integer()
                                                .at_least(0)
                                                .by_default("0")})));
  schema.add(tag("Scheduler", "accepted without effect: the task graph is compiled by itself")
                 .attribute(attribute("type", "the scheduler of the deck's author")
                                .words({"MPI", "DynamicMPI", "Unified", "Kokkos", "KokkosOpenMP"}))
                 .with_children({tag("small_messages", "accepted without effect").boolean(),
                                 tag("taskReadyQueueAlg", "accepted without effect").text()}));
  schema.rewrites.emplace_back(keep_first_of_time);
  schema.rewrites.emplace_back(fill_in_from_other_decks);
  schema.rewrites.emplace_back(settle_material_names);
  schema.rules.emplace_back(check_time);
  schema.rules.emplace_back(check_switcher);
}

void check_time(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* time = root.child("Time");
  if (time == nullptr) return;
  const auto begin = real_of(time, "initTime");
  const auto end = real_of(time, "maxTime");
  if (begin && end && *end < *begin) {
    add_error(faults, time->child("maxTime")->where,
              "<maxTime> is before <initTime>: nothing would be computed",
              "maxTime must be at least initTime");
  } else if (begin && end && *end == *begin) {
    add_warning(
        faults, time->child("maxTime")->where,
        fmt::format("<maxTime> {:g} is <initTime>: the run ends before its first step", *end),
        "give the time at which the run is to end");
  }
  const auto least = real_of(time, "delt_min");
  const auto most = real_of(time, "delt_max");
  if (least && most && *most > 0 && *least > *most) {
    add_error(faults, time->child("delt_max")->where, "<delt_max> is smaller than <delt_min>");
  }
}

}  // namespace sluice
