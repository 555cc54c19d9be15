// sluice plan DECK: what a run will do and cost, before it.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/option_values.hpp"
#include "app/plan/planned_graph.hpp"
#include "app/plan/run_plan.hpp"
#include "app/process/study_process.hpp"
#include "app/process/text_sink.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

struct PlanRequest {
  RunOptionValues run;
  std::string deck, graph;
  int ranks = 1, max_steps = 0;
  std::string json;
  bool every_graph = false;
};

void write_graph(const std::string& file, const std::string& dot) {
  const fs::path path = file;
  if (path.extension() == ".dot") {
    write_text(path.string(), dot);
    return;
  }
  if (path.extension() != ".svg")
    throw InputError(fmt::format("--graph {}: the name must end in .dot or .svg", file));
  constexpr const char* program = "/usr/bin/dot";
  if (::access(program, X_OK) != 0)
    throw SystemError(
        fmt::format("--graph {}: an SVG needs Graphviz ({}; on Debian: apt-get "
                    "install graphviz); a .dot file does not",
                    file, program));
  const fs::path source = path.string() + ".dot";
  write_text(source.string(), dot);
  ProcessRequest request;
  request.words = {program, "-Tsvg", "-o", path.string(), source.string()};
  const int status = run_process(request);
  fs::remove(source);
  if (status != 0) throw SystemError(fmt::format("{} ended with status {}", program, status));
}

int plan(const PlanRequest& o) {
  if (o.every_graph && o.graph.empty())
    throw InputError("--every-graph takes effect with --graph FILE alone");
  if (o.ranks < 1) throw InputError("--ranks takes a number of at least 1");
  if (o.max_steps < 0) throw InputError("--max-steps takes a number of at least 1");
  check_run_options(o.run);
  const auto loaded =
      load_scene(o.deck, o.run.overrides, o.run.scene_options(o.ranks), o.run.warnings());
  PlanOptions options;
  options.ranks = o.ranks;
  options.threads = o.run.threads;
  options.force_all = o.run.force_all;
  options.output = !o.run.no_output;
  options.max_steps = o.max_steps;
  options.block = o.run.block_extents();
  RunPlan plan = plan_run(*loaded, options);
  if (loaded->deck.root->child("MPM") != nullptr)
    plan.best = best_settings(o.deck, o.run.overrides);
  if (!o.graph.empty())
    write_graph(o.graph, o.every_graph ? to_dot(every_graph(*loaded->component, loaded->scene),
                                                loaded->component->effects())
                                       : plan.dot);
  if (!o.json.empty()) write_text(o.json, plan_json(plan));
  if (o.json != "-") fmt::print("{}", plan_text(plan));
  return 0;
}

}  // namespace

void declare_plan_command(Command& command) {
  auto o = std::make_shared<PlanRequest>();
  command.option("DECK", o->deck, "Deck (.ups)").required();
  command.json(o->json, "As JSON, for scripts");
  command.option("--graph", o->graph, "Write the task graph to FILE.dot or FILE.svg");
  command.flag("--every-graph", o->every_graph,
               "With --graph: the graphs of each level, kind of blocks and variant of the step");
  command.option("--ranks", o->ranks, "Plan for this number of ranks");
  command.option("--max-steps", o->max_steps, "Plan for a run that ends after this step");
  add_run_options(command, o->run);
  command.action([o] { return plan(*o); });
}

}  // namespace sluice
