// The step loop.
#include "framework/run/simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "framework/archive/archive.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

constexpr int smaller_attempts = 20;  // halvings of a step before the run ends

ArchiveSetup archive_setup(const Scene& scene, const RunOptions& o) {
  ArchiveSetup setup;
  setup.parent = o.parent;
  setup.filebase = scene.output.filebase;
  setup.deck_xml = o.deck_xml;
  setup.other_decks = o.other_decks;
  setup.kept_files = o.kept_files;
  setup.program = o.program;
  setup.outputs.doubles_as_float = scene.output.doubles_as_floats;
  setup.checkpoint_cycle = scene.output.checkpoint.cycle;
  setup.histories.frequency = scene.output.reduction_frequency;
  setup.histories.on_step = scene.output.reduction_on_timestep;
  setup.histories.step_column = scene.output.reduction_step_column;
  setup.histories.time_column = scene.output.reduction_time_column;
  return setup;
}

using Rates = std::vector<std::vector<double>>;

bool all_finite(const Rates& rates) {
  for (const std::vector<double>& level : rates)
    for (double rate : level)
      if (!std::isfinite(rate)) return false;
  return true;
}

}  // namespace

Simulation::Simulation(const Scene& scene, const Component& component, Communicator& communicator,
                       RunOptions options)
    : scene_(&scene),
      component_(&component),
      communicator_(&communicator),
      options_(std::move(options)),
      time_(scene.time, scene.output, options_.limits),
      hierarchy_(empty_hierarchy(scene, component)),
      analysis_(std::make_unique<AnalysisRecorder>(scene, *hierarchy_, communicator)),
      level_history_(hierarchy_->levels().possible(), communicator.is_root()),
      conservation_(conserved_names(component)),
      tracked_(component.budgets().tracked_names()) {
  time_.set_switches(component.outputs().switches());
}

Simulation::~Simulation() = default;

void Simulation::restart_from(const ArchiveStep& checkpoint) {
  turn_to_component_of(checkpoint.info().state);
  hierarchy_->restore(checkpoint);
  const std::map<std::string, std::string>& kept = checkpoint.info().state;
  time_.restart(time_state_from_json_text(kept.at("time")));
  hierarchy_->coarse_step().set_previous_dt(time_.state().previous_dt);
  set_totals(true);
  conservation_.restore(Json::parse(kept.at("conservation")));
  if (const auto counted = kept.find("tallies"); counted != kept.end() && tracked_.count() > 0)
    tracked_.restore(Json::parse(counted->second));
  ledger_ = EventLedger::from_json(Json::parse(kept.at("events")));
  if (const auto energies = kept.find("energies"); energies != kept.end())
    energies_.restore(Json::parse(energies->second));
  if (const auto parted = kept.find("parted"); parted != kept.end())
    parted_.restore(Json::parse(parted->second));
  if (const auto sampled = kept.find("analysis"); sampled != kept.end())
    analysis_->restore(sampled->second, &checkpoint);
  limit_ = limit_at_restart(kept);
  time_.remember_physics_dt(limit_.dt);
}

// Of the rates that the checkpoint keeps, with the cfl and the substeps of the deck as it is now. A
// state alone does not tell them: those of face velocities are of the step before.
StepLimit Simulation::limit_at_restart(const std::map<std::string, std::string>& kept) {
  const auto found = kept.find("rates");
  Rates rates = found == kept.end() ? Rates() : Json::parse(found->second).get<Rates>();
  rates.resize(hierarchy_->levels().possible());
  for (int l = 0; l < hierarchy_->level_count(); ++l)
    if (static_cast<int>(rates[l].size()) != component_->step().reductions().maxima())
      return {time_.state().physics_dt, "checkpoint"};
  hierarchy_->rates().set_maxima(std::move(rates));
  return hierarchy_->rates().limit();
}

void Simulation::start() {
  const bool restarting = !options_.restart.empty();
  int restart_step = 0;
  if (restarting) {
    const Archive earlier = Archive::open(options_.restart);
    require_own_format(earlier);
    const StepEntry& entry = earlier.select_checkpoint(options_.restart_step);
    restart_step = entry.step;
    restart_from(earlier.read_checkpoint(entry));
  } else {
    hierarchy_->initialise();
    set_totals(true);
    limit_ = hierarchy_->rates().first_limit();
    time_.remember_physics_dt(limit_.dt);
  }
  // Bad labels are found also when nothing is written.
  sort_saves(scene_->output, *hierarchy_, analysis_->field_labels());
  check_saves_of_successors();
  const bool nothing_left = restarting && time_.status() != RunStatus::running;
  const bool writes = scene_->output.any() || scene_->output.checkpoint.any() || analysis_->any();
  if (options_.output && writes && !nothing_left) {
    ArchiveWriter archive =
        ArchiveWriter::create(archive_setup(*scene_, options_), writer_ranks(*communicator_));
    if (restarting)
      archive.adopt(options_.restart, restart_step,
                    options_.copy_earlier ? Earlier::copy : Earlier::refer);
    analysis_->open(archive.folder());
    level_history_.open(archive.folder());
    if (restarting) {
      analysis_->adopt(options_.restart, time_.state().time);
      level_history_.adopt(options_.restart, time_.state().time);
    }
    sample_levels();
    output_ = std::make_unique<OutputWriter>(*scene_, *component_, *hierarchy_, std::move(archive),
                                             analysis_.get());
    if (!restarting && time_.outputs_initial_state()) output_->write_output(step_info(), true);
  }
  ProgressOptions p;
  p.mode = communicator_->is_root() ? options_.progress : ProgressMode::none;
  p.max_time = scene_->time.max_time;
  p.max_steps =
      options_.limits.max_steps > 0 ? options_.limits.max_steps : scene_->time.max_timesteps;
  p.wall_limit = options_.limits.wall_seconds;
  if (!component_->state().slots().empty()) p.cells = hierarchy_->levels().cell_count();
  progress_ = std::make_unique<Progress>(p);
  start_seconds_ = control_.wall_seconds();
  if (output_ != nullptr) start_seconds_ -= output_->seconds();
  if (communicator_->is_root() && output_ != nullptr)
    for (const Fault& warning : analysis_->warnings()) progress_->note(to_string(warning));
  if (communicator_->is_root() && nothing_left) progress_->note(text_of_nothing_left());
  progress_->begin(time_.state().step, time_.state().time, control_.wall_seconds());
}

std::string Simulation::text_of_nothing_left() const {
  const TimeState& t = time_.state();
  const bool by_time = time_.status() == RunStatus::done;
  return fmt::format(
      "nothing is left to do: the checkpoint of step {} at t = {:g} is at the end of the run, {}; "
      "no archive is made\n  to continue, set a later end: {}",
      t.step, t.time,
      by_time ? fmt::format("maxTime = {:g}", scene_->time.max_time) : "its last step",
      by_time ? "--set Time/maxTime=..." : "more of --max-steps or --set Time/max_Timesteps=...");
}

StepInfo Simulation::step_info() const {
  const TimeState& t = time_.state();
  StepInfo info;
  info.step = t.step;
  info.time = t.time;
  info.old_delt = t.previous_dt;
  info.next_delt = limit_.dt;
  info.state["time"] = to_json_text(t);
  info.state["conservation"] = conservation_.checkpoint().dump();
  if (tracked_.count() > 0) info.state["tallies"] = tracked_.checkpoint().dump();
  if (energies_.any()) info.state["energies"] = energies_.checkpoint().dump();
  if (parted_.any()) info.state["parted"] = parted_.checkpoint().dump();
  info.state["events"] = ledger_.to_json().dump();
  if (all_finite(hierarchy_->rates().maxima()))
    info.state["rates"] = Json(hierarchy_->rates().maxima()).dump();
  if (analysis_->any()) info.state["analysis"] = analysis_->state();
  if (const ParticleCloud* particles = hierarchy_->particles())
    info.state["particles"] = particles->state();
  if (!options_.successors.empty()) info.state["component"] = Json(running_).dump();
  if (const std::string regrid = hierarchy_->regridding().state(); !regrid.empty())
    info.state["regrid"] = regrid;
  return info;
}

void Simulation::fail(const StepPlan& plan, const CycleResult& a) {
  if (!a.reason.empty())
    throw PhysicsError(fmt::format("step {} at t = {:g}, even with dt = {:g}: {}", plan.step,
                                   plan.start, plan.dt, a.reason));
  const CellFault& f = a.first_fault;
  if (a.unmatched)
    throw PhysicsError(fmt::format(
        "step {} at t = {:g}: task 'matching of fluxes' found no state that is admissible on both "
        "levels even with dt = {:g}; the first cell is [{}, {}, {}] of level {}, at the edge of a "
        "finer level. Try a smaller <cfl>, a wider <cell_stability_dilation>, or look at the state "
        "before this step in the last checkpoint",
        plan.step, plan.start, plan.dt, f.cell.x, f.cell.y, f.cell.z, f.level));
  throw PhysicsError(fmt::format(
      "step {} at t = {:g}: task 'update' left {} cell{} inadmissible even with dt = {:g}; the "
      "first is cell [{}, {}, {}] of level {}, material {}: {} is {:g}. Try a smaller <cfl>, "
      "<advection type=\"FirstOrder\">, or look at the state before this step in the last "
      "checkpoint",
      plan.step, plan.start, a.faults, a.faults == 1 ? "" : "s", plan.dt, f.cell.x, f.cell.y,
      f.cell.z, f.level, f.material, component_->step().describe_fault(f.kind), f.value));
}

// The state was damaged from outside (memory, a fault of the program): a smaller step cannot help.
void Simulation::fail_unsound(const StepPlan& plan, const CycleResult& a) {
  state_is_sound_ = false;
  const CellFault& f = a.unsound->where;
  throw PhysicsError(fmt::format(
      "step {} at t = {:g}: task 'update' left {} cells inadmissible because {} is {:g} in cell "
      "[{}, {}, {}] of level {}, material {}, at the start of the step. The state is damaged; "
      "continue from the last checkpoint with sluice run --restart",
      plan.step, plan.start, a.faults, a.unsound->label.name(), f.value, f.cell.x, f.cell.y,
      f.cell.z, f.level, f.material));
}

// Labels that exist only inside the step and are saved or analysed at its end.
std::vector<Label> Simulation::labels_to_store(const StepPlan& plan) const {
  if (output_ == nullptr) return {};
  std::vector<Label> labels = analysis_->step_labels(plan.end);
  if (plan.output)
    for (Label l : output_->step_labels())
      if (std::find(labels.begin(), labels.end(), l) == labels.end()) labels.push_back(l);
  return labels;
}

// Attempts the step until it is admissible, each time with a smaller one. Nothing of the old state
// is touched.
StepPlan Simulation::advance(StepPlan plan, CycleResult& result) {
  EnergyAttempts energies;
  hierarchy_->coarse_step().set_judge([&](const std::vector<double>& sums, std::string& reason) {
    return judge_energies(plan, sums, energies, reason);
  });
  for (int smaller = 0;; ++smaller) {
    energies.refused = false;
    result = hierarchy_->attempt(plan.step, plan.start, plan.dt, labels_to_store(plan), control_,
                                 ledger_);
    if (result.good) {
      hierarchy_->coarse_step().set_judge({});
      hierarchy_->accept();
      ledger_.accept_step();
      result.sums = hierarchy_->coarse_step().result().sums;  // with what was booked at acceptance
      return plan;
    }
    hierarchy_->reject();
    ledger_.reject_step();
    if (result.unsound) fail_unsound(plan, result);
    if (smaller == smaller_attempts || energies.hopeless) fail(plan, result);
    EventPlace place;
    place.step = plan.step;
    place.value = plan.dt;
    ledger_.keep(energies.refused ? "step redone: a solid gained energy by numerical error"
                                  : "step redone with a smaller one",
                 place);
    try {
      plan = time_.retry(plan, 0.5 * plan.dt);
    } catch (const PhysicsError&) {
      fail(plan, result);
    }
  }
}

void Simulation::sample_levels() {
  std::vector<std::int64_t> cells;
  for (int l = 0; l < hierarchy_->levels().possible(); ++l)
    cells.push_back(hierarchy_->level(l).level().cell_count());
  level_history_.sample(time_.state().step, time_.state().time, cells);
}

void Simulation::flush_samples() {
  analysis_->flush();
  level_history_.flush();
}

void Simulation::keep(const StepPlan& plan, const StepEnd& end) {
  if (output_ == nullptr) return;
  analysis_->sample(plan.step, plan.end);
  if (plan.output || end.checkpoint) flush_samples();
  if (output_->writes_histories(plan.step)) output_->write_histories(plan.step, plan.end, totals());
  if (plan.output) output_->write_output(step_info(), false);
}

// Outputs and samples are of the levels that the step was made with; a checkpoint is of those that
// the next step will be made with.
void Simulation::prepare_next(const StepPlan& plan, const StepEnd& end) {
  const auto start = std::chrono::steady_clock::now();
  const MessageCounts sent_before = message_counts();
  const bool regridded = hierarchy_->regrid(plan.step);
  if (hierarchy_->balance(plan.step) || regridded) {
    limit_ = hierarchy_->rates().limit();
    time_.remember_physics_dt(limit_.dt);
    analysis_->follow_levels();
  }
  stepping_seconds_ +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  messages_ += message_counts() - sent_before;
  if (output_ == nullptr) return;
  sample_levels();
  if (!end.checkpoint) return;
  level_history_.flush();
  set_totals(false);
  output_->write_checkpoint(step_info());
  last_checkpoint_step_ = plan.step;
}

void Simulation::plant_nan(IntVec3 cell) {
  Warehouse& state = hierarchy_->level(0).state();
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
    if (state.local_boxes()[b].cells.contains(cell))
      state.view(0, 0, b)(cell) = std::numeric_limits<double>::quiet_NaN();
  hierarchy_->level(0).mark_modified();
}

void Simulation::act_on_switches(const std::vector<double>& sums) {
  const std::vector<OutputSwitch> switches = component_->outputs().switches();
  for (std::size_t n = 0; n < switches.size(); ++n) {
    if (!component_->outputs().passes_switch(n, sums) || !time_.act_on_switch(n)) continue;
    const TimeState& t = time_.state();
    std::string note = fmt::format(
        "step {} at t = {:.6g}: outputs every {:g}, checkpoints every {:g} from here on", t.step,
        t.time, switches[n].output_interval, switches[n].checkpoint_interval);
    if (t.last_step > 0) note += fmt::format("; the last step is {}", t.last_step);
    if (communicator_->is_root()) progress_->note(note);
  }
}

void Simulation::step() {
  StepPlan plan = time_.plan(limit_.dt * energies_.factor());
  if (!plan.message.empty() && communicator_->is_root()) progress_->note(plan.message);
  const auto start = std::chrono::steady_clock::now();
  const MessageCounts sent_before = message_counts();
  if (options_.plant_nan && options_.plant_nan->first == plan.step)
    plant_nan(options_.plant_nan->second);
  CycleResult result;
  plan = advance(plan, result);
  record(plan, result.sums);
  record_energies(plan, result.sums);
  analysis_->record(plan.dt, result.sums);
  limit_ = hierarchy_->rates().limit();
  stepping_seconds_ +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  messages_ += message_counts() - sent_before;
  const RunControl::Answer& answer = result.control;
  const StepEnd end = time_.accept(plan, answer.wall_seconds, answer.terminate());
  act_on_switches(result.sums);
  time_.remember_physics_dt(limit_.dt);
  ++steps_;
  if (const ParticleCloud* particles = hierarchy_->particles())
    particle_updates_ += particles->local_count();
  keep(plan, end);
  prepare_next(plan, end);
  status_ = end.status;
  progress_->step({plan.step, plan.end, limit_.dt, answer.wall_seconds});
}

void Simulation::write_last_good_checkpoint() {
  if (output_ == nullptr || last_checkpoint_step_ == time_.state().step || steps_ == 0) return;
  flush_samples();
  output_->write_checkpoint(step_info());
  last_checkpoint_step_ = time_.state().step;
}

RunReport Simulation::run() {
  start();
  status_ = time_.status();
  try {
    while (status_ == RunStatus::running) {
      while (is_next_due()) hand_over();
      step();
    }
  } catch (const PhysicsError& e) {
    status_ = RunStatus::failed;
    message_ = e.what();
    set_totals(false);  // of the last step that was accepted, as what has been booked
    if (state_is_sound_) write_last_good_checkpoint();
  }
  if (output_ != nullptr)
    for (const std::string& warning : output_->warnings()) progress_->note("warning: " + warning);
  progress_->end();
  if (status_ != RunStatus::failed) set_totals(false);
  tell_energies();
  RunReport r = report();
  if (output_ != nullptr) {
    analysis_->flush();
    level_history_.finish();
  }
  if (output_ != nullptr) output_->finish(to_json(r).dump(2) + "\n");
  return r;
}

}  // namespace sluice
