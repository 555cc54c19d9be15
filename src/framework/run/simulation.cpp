// The step loop.
#include "framework/run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "framework/archive/archive.hpp"
#include "framework/base/memory.hpp"

namespace sluice {
namespace {

constexpr int masked_attempts = 3;    // at one step size, each with more cells at first order
constexpr int smaller_attempts = 20;  // halvings of a step before the run ends

std::vector<std::string> conserved_names(const Component& component) {
  std::vector<std::string> names;
  for (int m = 0; m < component.material_count(); ++m)
    names.push_back("mass of material " + std::to_string(m));
  for (const char* d : {"x", "y", "z"}) names.push_back(std::string("momentum ") + d);
  names.emplace_back("total energy");
  return names;
}

ArchiveSetup archive_setup(const Scene& scene, const RunOptions& o) {
  ArchiveSetup setup;
  setup.parent = o.parent;
  setup.filebase = scene.output.filebase;
  setup.deck_xml = o.deck_xml;
  setup.program = o.program;
  setup.outputs.doubles_as_float = scene.output.doubles_as_floats;
  setup.checkpoint_cycle = scene.output.checkpoint.cycle;
  setup.histories.frequency = scene.output.reduction_frequency;
  setup.histories.on_step = scene.output.reduction_on_timestep;
  setup.histories.step_column = scene.output.reduction_step_column;
  setup.histories.time_column = scene.output.reduction_time_column;
  return setup;
}

ConservedTotal single(double q) {
  ConservedTotal t;
  t.add(q);
  return t;
}

void merge_ranks(ConservedTotal& total, Communicator& communicator) {
  if (communicator.size() == 1) return;
  Reduction all;
  const auto sum = all.add_sum(total.sum), magnitude = all.add_sum(total.magnitude);
  communicator.reduce(all);
  total.sum = all.sum(sum);
  total.magnitude = all.sum(magnitude);
}

}  // namespace

Simulation::Simulation(const Scene& scene, const Component& component, Communicator& communicator,
                       RunOptions options)
    : scene_(scene),
      component_(component),
      communicator_(communicator),
      options_(std::move(options)),
      time_(scene.time, scene.output, options_.limits),
      solver_(component, scene.grid.levels.front(), communicator,
              {options_.threads, options_.force_all, 61, options_.block}),
      analysis_(scene, solver_, communicator),
      conservation_(conserved_names(component)) {}

Simulation::~Simulation() = default;

Totals Simulation::totals() {
  Totals t;
  component_.add_totals(solver_.state(), LevelCoverage{}, t);
  for (ConservedTotal& m : t.mass) merge_ranks(m, communicator_);
  for (ConservedTotal& m : t.momentum) merge_ranks(m, communicator_);
  merge_ranks(t.internal_energy, communicator_);
  merge_ranks(t.kinetic_energy, communicator_);
  return t;
}

void Simulation::set_totals(bool at_start) {
  const Totals t = totals();
  int q = 0;
  auto set = [&](const ConservedTotal& total) {
    if (at_start) conservation_.set_start(q, total);
    conservation_.set_now(q++, total);
  };
  step_start_ = {};
  for (const ConservedTotal& m : t.mass) {
    set(m);
    step_start_.mass.push_back(m.sum.value());
  }
  for (int d = 0; d < 3; ++d) {
    set(t.momentum[d]);
    step_start_.momentum[d] = t.momentum[d].sum.value();
  }
  ConservedTotal energy = t.internal_energy;
  energy.merge(t.kinetic_energy);
  set(energy);
}

namespace {

// A checkpoint continues on its own grid only.
void check_same_grid(const Level& now, const ArchiveStep& checkpoint) {
  const Level& then = checkpoint.grid().levels.front();
  auto differs = [&](const char* what) {
    throw InputError(fmt::format(
        "{} holds a grid of [{}, {}, {}] cells with another {} than the deck's [{}, {}, {}]: a "
        "restart goes on with the same grid; leave Grid out of --set",
        checkpoint.folder().string(), then.domain.size().x, then.domain.size().y,
        then.domain.size().z, what, now.domain.size().x, now.domain.size().y, now.domain.size().z));
  };
  if (!(then.domain == now.domain)) differs("number of cells");
  if (!(then.anchor == now.anchor)) differs("lower corner");
  if (!(then.spacing == now.spacing)) differs("spacing");
  if (then.periodic != now.periodic) differs("periodicity");
}

}  // namespace

void Simulation::restart_from(const ArchiveStep& checkpoint) {
  check_same_grid(scene_.grid.levels.front(), checkpoint);
  Warehouse& state = solver_.state();
  const std::vector<SlotInfo> slots = component_.state_slots();
  const std::vector<std::vector<Label>> labels = component_.checkpoint_labels();
  for (std::size_t s = 0; s < slots.size(); ++s)
    for (std::size_t c = 0; c < labels[s].size(); ++c) {
      const FieldInfo* field = checkpoint.find(labels[s][c].name(), slots[s].material, 0);
      if (field == nullptr)
        throw InputError(fmt::format("{} holds no {}: it cannot be restarted with this deck",
                                     checkpoint.folder().string(), labels[s][c].name()));
      const int slot = state.find(slots[s].label, slots[s].material);
      for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
        checkpoint.read_into(*field, 0, state.local_boxes()[static_cast<std::size_t>(b)].cells,
                             state.view(slot, static_cast<int>(c), b));
    }
  const std::map<std::string, std::string>& kept = checkpoint.info().state;
  time_.restart(time_state_from_json_text(kept.at("time")));
  set_totals(true);
  conservation_.restore(nlohmann::json::parse(kept.at("conservation")));
  ledger_ = EventLedger::from_json(nlohmann::json::parse(kept.at("events")));
  if (const auto sampled = kept.find("analysis"); sampled != kept.end())
    analysis_.restore(sampled->second);
  limit_.dt = time_.state().physics_dt;
  limit_.reason = "checkpoint";
}

void Simulation::start() {
  const bool restarting = !options_.restart.empty();
  int restart_step = 0;
  if (restarting) {
    const Archive earlier = Archive::open(options_.restart);
    const StepEntry& entry = earlier.select_checkpoint(options_.restart_step);
    restart_step = entry.step;
    restart_from(earlier.read_checkpoint(entry));
  } else {
    component_.initialise(solver_.state());
    set_totals(true);
    limit_ = component_.step_limit(solver_.initial_rates());
    time_.remember_physics_dt(limit_.dt);
  }
  sort_saves(scene_.output, solver_);  // bad labels are found also when nothing is written
  const bool writes = scene_.output.any() || scene_.output.checkpoint.any() || analysis_.any();
  if (options_.output && writes) {
    ArchiveWriter archive =
        ArchiveWriter::create(archive_setup(scene_, options_), writer_ranks(communicator_));
    if (restarting)
      archive.adopt(options_.restart, restart_step,
                    options_.copy_earlier ? Earlier::copy : Earlier::refer);
    analysis_.open(archive.folder());
    if (restarting) analysis_.adopt(options_.restart, time_.state().time);
    output_ = std::make_unique<OutputWriter>(scene_, component_, solver_, std::move(archive));
    if (!restarting && time_.outputs_initial_state()) output_->write_output(step_info(), true);
  }
  ProgressOptions p;
  p.mode = communicator_.is_root() ? options_.progress : ProgressMode::none;
  p.max_time = scene_.time.max_time;
  p.max_steps =
      options_.limits.max_steps > 0 ? options_.limits.max_steps : scene_.time.max_timesteps;
  p.wall_limit = options_.limits.wall_seconds;
  p.cells = scene_.grid.cell_count();
  progress_ = std::make_unique<Progress>(p);
  start_seconds_ = control_.wall_seconds();
  if (communicator_.is_root() && output_ != nullptr)
    for (const std::string& warning : analysis_.warnings()) progress_->note(warning);
  progress_->begin(time_.state().step, time_.state().time, start_seconds_);
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
  info.state["events"] = ledger_.to_json().dump();
  if (analysis_.any()) info.state["analysis"] = analysis_.state();
  return info;
}

void Simulation::fail(const StepPlan& plan) {
  const StepAttempt& a = solver_.attempt_result();
  const CellFault& f = a.first_fault;
  throw PhysicsError(fmt::format(
      "step {} at t = {:g}: task 'update' left {} cell{} inadmissible even with dt = {:g}; the "
      "first is cell [{}, {}, {}] of level {}, material {}: {} is {:g}. Try a smaller <cfl>, "
      "<advection type=\"FirstOrder\">, or look at the state before this step in the last "
      "checkpoint",
      plan.step, plan.start, a.faults, a.faults == 1 ? "" : "s", plan.dt, f.cell.x, f.cell.y,
      f.cell.z, f.level, f.material, component_.describe_fault(f.kind), f.value));
}

// The state was damaged from outside (memory, a fault of the program): a smaller step cannot help.
void Simulation::require_sound_start(const StepPlan& plan) {
  const std::optional<UnsoundCell> found = solver_.unsound_start();
  if (!found) return;
  state_is_sound_ = false;
  const CellFault& f = found->where;
  throw PhysicsError(fmt::format(
      "step {} at t = {:g}: task 'update' left {} cells inadmissible because {} is {:g} in cell "
      "[{}, {}, {}] of level {}, material {}, at the start of the step. The state is damaged; go "
      "on "
      "from the last checkpoint with sluice run --restart",
      plan.step, plan.start, solver_.attempt_result().faults, found->label.name(), f.value,
      f.cell.x, f.cell.y, f.cell.z, f.level, f.material));
}

// Labels that exist only inside the step and are saved or analysed at its end.
std::vector<Label> Simulation::labels_to_store(const StepPlan& plan) const {
  if (output_ == nullptr) return {};
  std::vector<Label> labels = analysis_.step_labels(plan.end);
  if (plan.output)
    for (Label l : output_->step_labels())
      if (std::find(labels.begin(), labels.end(), l) == labels.end()) labels.push_back(l);
  return labels;
}

// Attempts the step until it is admissible: first with slopes taken away where it failed, then with
// smaller steps. Nothing of the old state is touched.
StepPlan Simulation::advance(StepPlan plan) {
  for (int smaller = 0;; ++smaller) {
    const std::vector<Label> stored = labels_to_store(plan);
    for (int masked = 0; masked <= masked_attempts; ++masked) {
      const StepAttempt& a = solver_.attempt(plan.start, plan.dt, stored, control_);
      if (a.faults == 0) {
        ledger_.accept_step();
        return plan;
      }
      ledger_.reject_step();
      if (smaller == 0 && masked == 0) require_sound_start(plan);
      EventPlace place;
      place.step = plan.step;
      place.cell = a.first_fault.cell;
      place.material = a.first_fault.material;
      place.task = "update";
      place.value = a.first_fault.value;
      if (masked == masked_attempts || solver_.mask_faults(plan.start) == 0) break;
      ledger_.keep("step redone with first-order faces", place);
    }
    if (smaller == smaller_attempts) fail(plan);
    EventPlace place;
    place.step = plan.step;
    place.value = plan.dt;
    ledger_.keep("step redone with a smaller one", place);
    try {
      plan = time_.retry(plan, 0.5 * plan.dt);
    } catch (const PhysicsError&) {
      fail(plan);
    }
  }
}

void Simulation::book(const StepPlan& plan) {
  const StepBalance b = component_.balance(solver_.attempt_result().sums, &step_start_, plan.dt);
  int q = 0;
  for (std::size_t m = 0; m < b.mass.size(); ++m) {
    conservation_.add_boundary(q++, single(b.mass[m]));
    step_start_.mass[m] += b.mass[m];
  }
  for (int d = 0; d < 3; ++d) {
    conservation_.add_boundary(q, single(b.momentum[d]));
    conservation_.add_sources(q++, single(b.momentum_of_forces[d]));
    step_start_.momentum[d] += b.momentum[d] + b.momentum_of_forces[d];
  }
  conservation_.add_boundary(q, single(b.energy));
  conservation_.add_sources(q, single(b.energy_of_forces));
}

void Simulation::keep(const StepPlan& plan, const StepEnd& end) {
  if (output_ == nullptr) return;
  if (analysis_.sample(plan.step, plan.end)) ghosts_filled_ = true;
  if (plan.output || end.checkpoint) analysis_.flush();
  if (output_->writes_histories(plan.step)) output_->write_histories(plan.step, plan.end, totals());
  if (plan.output) {
    output_->write_output(step_info(), false);
    ghosts_filled_ = true;
  }
  if (end.checkpoint) {
    set_totals(false);
    output_->write_checkpoint(step_info());
    last_checkpoint_step_ = plan.step;
  }
}

bool Simulation::step() {
  StepPlan plan = time_.plan(limit_.dt);
  if (!plan.message.empty() && communicator_.is_root()) progress_->note(plan.message);
  const auto start = std::chrono::steady_clock::now();
  if (options_.plant_nan && options_.plant_nan->first == plan.step)
    for (int b = 0; b < static_cast<int>(solver_.state().local_boxes().size()); ++b) {
      const GridBox& box = solver_.state().local_boxes()[static_cast<std::size_t>(b)];
      if (box.cells.contains(options_.plant_nan->second))
        solver_.state().view(0, 0, b)(options_.plant_nan->second) =
            std::numeric_limits<double>::quiet_NaN();
    }
  if (!ghosts_filled_) solver_.fill_ghosts(plan.start);
  ghosts_filled_ = false;
  plan = advance(plan);
  solver_.accept();
  limit_ = component_.step_limit(solver_.attempt_result().maxima);
  book(plan);
  stepping_seconds_ +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const RunControl::Answer& answer = solver_.attempt_result().control;
  const StepEnd end = time_.accept(plan, answer.wall_seconds, answer.terminate());
  time_.remember_physics_dt(limit_.dt);
  ++steps_;
  keep(plan, end);
  status_ = end.status;
  progress_->step({plan.step, plan.end, limit_.dt, answer.wall_seconds});
  return end.status == RunStatus::running;
}

void Simulation::write_last_good_checkpoint() {
  if (output_ == nullptr || last_checkpoint_step_ == time_.state().step || steps_ == 0) return;
  analysis_.flush();
  output_->write_checkpoint(step_info());
}

RunReport Simulation::run() {
  start();
  status_ = time_.status();
  try {
    while (status_ == RunStatus::running && step()) {
    }
  } catch (const PhysicsError& e) {
    status_ = RunStatus::failed;
    message_ = e.what();
    if (state_is_sound_) write_last_good_checkpoint();
  }
  if (output_ != nullptr)
    for (const std::string& warning : output_->warnings()) progress_->note("warning: " + warning);
  progress_->end();
  if (status_ != RunStatus::failed) set_totals(false);
  RunReport r = report();
  if (output_ != nullptr) analysis_.flush();
  if (output_ != nullptr) output_->finish(to_json(r).dump(2) + "\n");
  return r;
}

RunReport Simulation::report() const {
  RunReport r;
  r.status = status_;
  r.message = message_;
  if (output_ != nullptr) r.archive = output_->archive_folder();
  r.steps = steps_;
  r.last_step = time_.state().step;
  r.time = time_.state().time;
  r.cells = scene_.grid.cell_count();
  r.ranks = communicator_.size();
  r.threads = options_.threads;
  r.wall_seconds = control_.wall_seconds();
  r.stepping_seconds = stepping_seconds_;
  r.start_seconds = start_seconds_;
  r.output_seconds = output_ != nullptr ? output_->seconds() : 0.0;
  r.peak_memory_bytes = peak_resident_bytes_of_all(communicator_);
  r.blocks_run = solver_.blocks_run();
  r.blocks_asleep = solver_.blocks_asleep();
  r.step_limit = limit_.reason;
  const std::vector<double> seconds = solver_.effect_seconds();
  const std::vector<int> tasks = solver_.effect_tasks();
  const std::vector<double> doubles = solver_.effect_doubles();
  for (int e = 0; e < component_.effects().size(); ++e) {
    const auto n = static_cast<std::size_t>(e);
    r.effects.push_back({component_.effects()[e], tasks[n],
                         doubles[n] * static_cast<double>(sizeof(double)), seconds[n]});
  }
  r.events_json = ledger_.to_json().dump();
  r.conservation_json = conservation_.to_json().dump();
  r.worst_drift = conservation_.worst_drift();
  return r;
}

}  // namespace sluice
