// Compiling the graphs of a run without running them, and counting what they need.
#include "app/plan/run_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "app/plan/first_step_limit.hpp"
#include "app/plan/switched_plan.hpp"
#include "framework/run/analysis/analysis_heat.hpp"
#include "framework/run/analysis/analysis_particles.hpp"
#include "framework/run/analysis/analysis_spatial.hpp"
#include "framework/run/analysis/analysis_statistics.hpp"
#include "framework/run/component/refuse_label.hpp"
#include "framework/run/levels/particle_archive.hpp"
#include "framework/task/sweep_executor.hpp"

namespace sluice {
namespace {

constexpr double word_bytes = sizeof(double);

class Planner {
 public:
  Planner(const LoadedScene& loaded, const PlanOptions& options)
      : scene_(loaded.scene),
        component_(*loaded.component),
        level_(loaded.scene.grid.levels.front()),
        options_(options) {
    plan_.hierarchy =
        plan_hierarchy(loaded, options.ranks, options.threads, options.max_cells_for_levels);
    plan_.particles = plan_particles(loaded, options.max_cells_for_limits);
  }

  RunPlan plan() {
    describe_grid();
    const PlannedGraph all_step = plan_step_graph(component_, level_, {});
    step_labels_ = output_labels(all_step.list);
    if (const ParticleMethod* method = component_.particles()) {
      particle_labels_ = savable_labels(*method);
      node_labels_ = method->grid_labels();
    }
    TaskList diagnostics;
    component_.outputs().declare_diagnostics(diagnostics, 0);
    diagnostic_labels_ = output_labels(diagnostics);
    add_outputs(all_step.list, materials_of_);
    add_outputs(diagnostics, materials_of_);
    plain_ = plan_step_graph(component_, level_, {});
    plan_.dot = to_dot(plain_.list, component_.effects(), plain_.plan);
    plan_.halo = plain_.plan.halo;
    plan_.reductions = component_.state().boundary_sums() > 0 ? 2 : 1;
    describe_effects();
    describe_kinds();
    if (options_.output) describe_outputs();
    describe_quiet();
    find_first_step();
    predict_memory();
    return std::move(plan_);
  }

 private:
  void describe_grid() {
    plan_.title = scene_.title;
    plan_.component = component_.name();
    plan_.cells = level_.domain.size();
    plan_.cell_count = Grid{plan_.hierarchy.grid()}.cell_count();
    plan_.boxes = static_cast<int>(level_.boxes.size());
    plan_.ranks = options_.ranks;
    plan_.threads = options_.threads;
    plan_.directions = scene_.directions;
    block_ = options_.block == IntVec3{} ? default_block(level_, component_.blocks().size())
                                         : options_.block;
    plan_.blocks = static_cast<int>(place_blocks(level_.boxes, block_).size());
  }

  // What a block of each kind runs.
  void describe_kinds() {
    for (int kind = 0; kind < component_.blocks().kinds(); ++kind)
      plan_.kind_tasks.push_back(
          static_cast<int>(plan_step_graph(component_, level_, {}, kind).plan.tasks.size()));
  }

  void describe_effects() {
    const std::size_t count = component_.effects().size();
    std::vector<int> tasks(count, 0);
    std::vector<double> doubles(count, 0);
    plan_.effect_fields.assign(count, 0);
    for (const PlannedTask& p : plain_.plan.tasks) {
      const Task& t = plain_.list.tasks()[p.task];
      const std::size_t e = t.effect;
      ++tasks[e];
      for (VariableId v : t.writes) {
        plan_.effect_fields[e] += plain_.list[v].components;
        if (plain_.list[v].storage == Storage::new_state)
          doubles[e] += 2.0 * plain_.list[v].components;  // old and new
      }
    }
    for (std::size_t e = 0; e < count; ++e)
      plan_.effects.push_back(
          {component_.effects()[static_cast<int>(e)], tasks[e], word_bytes * doubles[e], 0.0});
  }

  bool is_on_nodes(Label label) const {
    return std::find(node_labels_.begin(), node_labels_.end(), label) != node_labels_.end();
  }
  // A label that this run can make.
  std::optional<Label> find_known(const std::string& name, bool histories) const {
    const std::optional<Label> label = find_label(name);
    if (!label) return {};
    const bool history = histories && label->info().centring == Centring::reduction;
    const bool of_particles = std::find(particle_labels_.begin(), particle_labels_.end(), *label) !=
                              particle_labels_.end();
    if (histories && (of_particles || is_on_nodes(*label))) return label;
    const bool field = step_labels_.count(*label) > 0 || diagnostic_labels_.count(*label) > 0;
    return history || field ? label : std::nullopt;
  }

  [[noreturn]] void refuse(const Location& where, LabelUse use, const std::string& name) const {
    std::vector<std::string> names;
    for (Label l : all_labels())
      if (find_known(l.name(), use == LabelUse::save)) names.push_back(l.name());
    refuse_label(where, use, name, names);
  }

  void describe_analyses() {
    for (const AnalysisModule& m : scene_.analysis.modules) {
      if (follows_particles(m)) {
        describe_followed(m);
        continue;
      }
      for (const AnalysedVariable& v : m.variables) {
        std::optional<Label> label = find_known(v.label, false);
        const std::optional<Label> node = find_label(v.label);
        const bool of_nodes = m.name == "minMax" && node && is_on_nodes(*node);
        if (of_nodes) label = node;
        if (!label) refuse(v.where, LabelUse::analyse, v.label);
        const bool in_step = step_labels_.count(*label) > 0;
        if (!of_nodes) (in_step ? stored_ : computed_).insert(*label);
        PlannedOutput out;
        out.label = v.label;
        out.made = fmt::format("{}, {}", m.name,
                               of_nodes  ? "from the particles"
                               : in_step ? "stored in the step"
                                         : "from the state");
        out.where = v.where;
        plan_.outputs.push_back(std::move(out));
      }
    }
  }
  void describe_followed(const AnalysisModule& m) {
    ParticleHistories(m, component_.particles());  // tells what is wrong with it
    for (const AnalysedVariable& v : m.variables) {
      PlannedOutput out;
      out.label = v.label;
      out.made = fmt::format("{}, one file per particle", m.name);
      out.where = v.where;
      plan_.outputs.push_back(std::move(out));
    }
  }

  int saved_materials(const SaveRequest& request, Label label) const {
    int count = 0;
    for (const int m : materials_of_.at(label))
      count += request.materials.contains(m, component_.material_count()) ? 1 : 0;
    return count;
  }
  double saved_particles(const SaveRequest& request) const {
    double count = 0;
    for (const PlannedKind& k : plan_.particles.kinds)
      if (request.materials.contains(k.material, component_.material_count()))
        count += static_cast<double>(k.count);
    return count;
  }
  static std::vector<std::pair<std::string, ValueType>> fields_of(const AnalysisModule& m,
                                                                  const TypeOfVariable& type_of) {
    if (keeps_statistics(m)) return fields_of_statistics(m, type_of);
    std::vector<std::pair<std::string, ValueType>> fields;
    if (averages_cells(m))
      for (const AnalysedVariable& v : m.variables)
        for (const std::string& name : names_of_cell_averages(v.label))
          fields.emplace_back(name, type_of(v));
    return fields;
  }
  // A field that an analysis gives; false: none of that name.
  bool describe_analysed_field(const SaveRequest& r) {
    const TypeOfVariable type_of = [this](const AnalysedVariable& v) {
      const std::optional<Label> label = find_known(v.label, false);
      if (!label) refuse(v.where, LabelUse::analyse, v.label);
      return label->info().type;
    };
    for (const AnalysisModule& m : scene_.analysis.modules) {
      for (const auto& [name, type] : fields_of(m, type_of)) {
        if (name != r.label) continue;
        PlannedOutput out;
        out.label = r.label;
        out.where = r.where;
        out.made =
            fmt::format("{}, from {}", m.name, keeps_statistics(m) ? "its samples" : "the state");
        out.materials = 1;
        out.bytes_per_cell = component_count(type) * real_bytes(type);
        plan_.output_bytes += out.bytes_per_cell * static_cast<double>(plan_.cell_count);
        plan_.outputs.push_back(std::move(out));
        return true;
      }
    }
    return false;
  }
  double real_bytes(ValueType type) const {
    const bool short_reals = scene_.output.doubles_as_floats && type == ValueType::real;
    return type == ValueType::integer || short_reals ? 4 : word_bytes;
  }
  void describe_outputs() {
    const OutputSettings& o = scene_.output;
    for (const AnalysisModule& m : scene_.analysis.modules)
      if (takes_heat(m)) total_heat_rate();  // its history can be saved
    std::set<Label> counted;
    for (const SaveRequest& r : o.saves) {
      const std::optional<Label> label = find_known(r.label, true);
      if (!label && describe_analysed_field(r)) continue;
      if (!label && component_.particles() != nullptr && component_.particles()->is_absent(r.label))
        continue;  // a warning has told it
      if (!label) refuse(r.where, LabelUse::save, r.label);
      PlannedOutput out;
      out.label = r.label;
      out.where = r.where;
      const int components = component_count(label->info().type);
      if (label->info().centring == Centring::reduction) {
        out.made = "history, one line per step";
      } else if (label->info().centring == Centring::particle) {
        out.made = "of particles";
        out.bytes = real_bytes(label->info().type) * components * saved_particles(r);
        plan_.output_bytes += out.bytes;
      } else if (is_on_nodes(*label)) {
        out.made = "on nodes, from the particles";
        for (const PlannedKind& k : plan_.particles.kinds)
          if (r.materials.contains(k.material, component_.material_count()))
            out.bytes_per_cell += real_bytes(label->info().type) * components;
        plan_.output_bytes += out.bytes_per_cell * static_cast<double>(plan_.cell_count);
      } else {
        out.made = step_labels_.count(*label) > 0 ? "stored in the step" : "from the state";
        const double bytes = real_bytes(label->info().type);
        out.materials = saved_materials(r, *label);
        out.bytes_per_cell = bytes * components * out.materials;
        out.memory_per_cell = word_bytes * stored_components(materials_of_, *label);
        if (counted.insert(*label).second)
          plan_.output_bytes += out.bytes_per_cell * static_cast<double>(plan_.cell_count);
        (step_labels_.count(*label) > 0 ? stored_ : computed_).insert(*label);
      }
      plan_.outputs.push_back(std::move(out));
    }
    describe_analyses();
    plan_.output_times = o.interval > 0 ? fmt::format("every {:g} of time", o.interval)
                         : o.timestep_interval > 0
                             ? fmt::format("every {} steps", o.timestep_interval)
                             : "at no interval";
    if (o.initial_timestep) plan_.output_times += ", at the start";
    if (o.last_timestep) plan_.output_times += ", at the end";
    const CheckpointSettings& c = o.checkpoint;
    plan_.checkpoint_times =
        c.interval > 0            ? fmt::format("every {:g} of time", c.interval)
        : c.timestep_interval > 0 ? fmt::format("every {} steps", c.timestep_interval)
        : c.walltime_interval > 0 ? fmt::format("every {:g} s of wall time", c.walltime_interval)
        : c.last_timestep         ? "at the end"
                                  : "never";
    plan_.checkpoint_bytes =
        word_bytes * state_components(component_) * static_cast<double>(plan_.cell_count) +
        plan_.particles.checkpoint_bytes();
  }

  void describe_quiet() {
    plan_.skipping_allowed = component_.blocks().skipping_allowed() && !options_.force_all;
    const bool gravity = !(scene_.constants.gravity == Vec3{});
    plan_.skipping_reason = options_.force_all ? "--force-all"
                            : plan_.skipping_allowed
                                ? "no effect of the problem changes a uniform state"
                            : gravity ? "gravity changes a uniform state"
                                      : "an effect of the problem changes a uniform state";
    if (gravity) plan_.skipping_where = scene_.constants.gravity_where;
  }

  // The initial state slab by slab: its rates give the first step.
  void find_first_step() {
    const TimeSettings& t = scene_.time;
    std::optional<StepLimit> physics;
    if (plan_.particles.any())
      physics = plan_.particles.limit;
    else if (plan_.hierarchy.limit)
      physics = plan_.hierarchy.limit;
    else if (plan_.hierarchy.levels.size() == 1 &&
             plan_.cell_count <= options_.max_cells_for_limits)
      physics = first_step_limit(component_, level_);
    TimeControl control(t, scene_.output);
    StepPlan first;
    if (physics) first = control.plan(physics->dt);
    auto add = [&](const std::string& rule, const std::string& value, bool acts) {
      plan_.limits.push_back({rule, value, physics && acts ? "sets the first step" : ""});
    };
    const bool by_physics = first.limits == 0;
    add("physics", physics ? physics->reason : "known when the run starts", by_physics);
    if (t.timestep_multiplier != 1)
      add("timestep_multiplier", fmt::format("{:g}", t.timestep_multiplier), by_physics);
    auto bound = [&](const char* rule, double value, TimeLimit limit) {
      if (value > 0) add(rule, fmt::format("{:g}", value), first.set_by(limit));
    };
    bound("max_delt_increase", t.max_delt_increase, TimeLimit::max_delt_increase);
    bound("delt_min", t.delt_min, TimeLimit::delt_min);
    bound("delt_max", t.delt_max, TimeLimit::delt_max);
    bound("delt_init", t.delt_init, TimeLimit::delt_init);
    if (t.clamp_time_to_output)
      add("clamp_time_to_output", "steps end at outputs and checkpoints",
          first.set_by(TimeLimit::output_time) || first.set_by(TimeLimit::checkpoint_time));
    if (t.end_at_max_time_exactly)
      add("end_at_max_time_exactly", fmt::format("{:g}", t.max_time),
          first.set_by(TimeLimit::max_time));
    if (!physics) return;
    plan_.physics = physics;
    plan_.first_dt = first.dt;
    plan_.first_dt_reason = by_physics ? physics->reason : "deck";
    const double typical =
        std::min(physics->dt * t.timestep_multiplier, t.delt_max > 0 ? t.delt_max : HUGE_VAL);
    plan_.estimated_steps = std::ceil((t.max_time - t.initial_time) / typical);
    if (t.max_timesteps > 0)
      plan_.estimated_steps = std::min<double>(plan_.estimated_steps, t.max_timesteps);
  }

  void predict_memory() {
    if (plan_.hierarchy.adaptive) computed_.insert(component_.levels().refine_flag());
    std::tie(plan_.memory, plan_.messages) = plan_memory({.scene = scene_,
                                                          .component = component_,
                                                          .hierarchy = plan_.hierarchy,
                                                          .ranks = options_.ranks,
                                                          .threads = options_.threads,
                                                          .block = options_.block,
                                                          .stored = stored_,
                                                          .computed = computed_,
                                                          .materials = materials_of_});
    plan_.memory.particles = plan_.particles.bytes() / options_.ranks;
    plan_.memory.all_ranks += plan_.particles.bytes();
  }

  const Scene& scene_;
  const Component& component_;
  const Level& level_;  // the coarsest
  PlanOptions options_;
  RunPlan plan_;
  PlannedGraph plain_;
  IntVec3 block_{};
  std::set<Label> step_labels_, diagnostic_labels_;
  std::vector<Label> particle_labels_, node_labels_;
  MaterialsOfLabels materials_of_;     // that can be saved
  std::set<Label> stored_, computed_;  // of saves and analyses
};

}  // namespace

RunPlan plan_run(const LoadedScene& loaded, const PlanOptions& options) {
  RunPlan plan = Planner(loaded, options).plan();
  plan.deck = loaded.deck.file;
  plan.parts = plan_parts(loaded);
  plan.cost = cost_of(plan, loaded, options.max_steps);
  return plan;
}

}  // namespace sluice
