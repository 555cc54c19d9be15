// How the levels of a run come about: at the start, after a regrid, from a checkpoint.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "framework/archive/archive.hpp"
#include "framework/base/memory.hpp"
#include "framework/grid/grid_boxes.hpp"
#include "framework/run/levels/hierarchy.hpp"
#include "framework/run/levels/load_balance.hpp"

namespace sluice {
namespace {

// The cells that the deck's own finer levels cover.
void add_start_boxes(const RefinementSettings& settings, std::vector<FlagField>& flags) {
  for (std::size_t l = 0; l < std::min(flags.size(), settings.start_boxes.size()); ++l)
    for (const IndexBox& fine : settings.start_boxes[l].boxes) {
      const IndexBox cells =
          intersection(coarsen(fine, settings.start_boxes[l].ratio), flags[l].domain());
      for_each_cell(cells, [&](IntVec3 c) { flags[l].set(c); });
    }
}

}  // namespace

void Hierarchy::make_joint(int coarser) {
  const int rank = communicator_->rank(), width = halo_width(*component_);
  auto& joint = interfaces_[coarser];
  joint.reset();
  const Level& coarse = level(coarser).level();
  const Level& fine = level(coarser + 1).level();
  if (fine.boxes.empty()) return;
  joint = std::make_unique<LevelInterface>(LevelInterface{
      Interpolation::for_ghosts(coarse, width, fine, width, rank, LevelSolver::arrays),
      FluxRegister(coarse, fine, component_->transfer().flux_quantities(), rank),
      Restriction(coarse, fine, rank)});
}

// What the levels know of each other, once every joint is made. Levels below `first` lie where they
// lay, and all but the one next to it meet what they met.
void Hierarchy::join_levels(int first) {
  ++layouts_;
  const int rank = communicator_->rank();
  for (int l = std::max(0, first - 1); l < possible_levels() && possible_levels() > 1; ++l) {
    FluxRecorder recorder;
    if (interfaces_[l] != nullptr) recorder.as_coarse = &interfaces_[l]->fluxes.coarse_faces();
    if (l > 0 && interfaces_[l - 1] != nullptr)
      recorder.as_fine = &interfaces_[l - 1]->fluxes.fine_faces();
    if (l >= first)
      ends_of_levels_[l] =
          InterfaceDistance(level(l).level(), rank, component_->interface_depth(level(l).level()),
                            halo_width(*component_));
    if (!ends_of_levels_[l].empty()) recorder.ends = &ends_of_levels_[l];
    const Level* finer = l + 1 < level_count() ? &level(l + 1).level() : nullptr;
    level(l).join(recorder, LevelCoverage(level(l).level(), finer, rank));
  }
  watch_volumes(first);
  if (level_count() == levels_in_cycle_) return;
  levels_in_cycle_ = level_count();
  cycle_ = cycle_of_levels();
  check(cycle_);
}

void Hierarchy::watch_volumes(int first) {
  if (volumes_.empty()) return;
  for (int l = std::max(0, first - 1); l < possible_levels(); ++l) {
    const Level* finer = l + 1 < level_count() ? &level(l + 1).level() : nullptr;
    level(l).watch(VolumeFaces(volumes_, scene_->grid.levels.front(), level(l).level(), finer,
                               communicator_->rank()));
  }
}

void Hierarchy::lay_out_level(int l, std::vector<GridBox> boxes, bool from_deck) {
  LevelSolver& solver = level(l);
  const Level earlier = solver.level();
  const Warehouse before = solver.lay_out(std::move(boxes));
  const Level& now = solver.level();
  if (now.boxes.empty()) return;
  if (from_deck) {
    component_->initialise(solver.state());
    return;
  }
  const int rank = communicator_->rank();
  if (!earlier.boxes.empty())
    LevelCopy(earlier, now, rank).run(before, solver.state(), solver.state_slots());
  if (l == 0 || solver.state_slots().empty()) return;  // cells of solids carry nothing
  LevelSolver& coarser = level(l - 1);
  Interpolation fresh = Interpolation::for_new_cells(coarser.level(), halo_width(*component_), now,
                                                     earlier.boxes, rank);
  fresh.run(nullptr, &coarser.state(), 1.0, solver.state(), solver.state_slots(),
            component_->transfer(), scene_->refinement.interpolation_order, solver.team());
}

// The boxes that the regridder wants, coarse to fine. Each new level needs the ghost cells of the
// one below it, and those the joint below: the next step finds them filled, as those of levels that
// nothing changes below. The first level that has changed.
int Hierarchy::lay_out(bool from_deck) {
  int first = possible_levels(), laid_out = -1;  // and the last one
  for (int l = 1; l < possible_levels(); ++l) {
    std::vector<GridBox> boxes = regridder_->boxes(l);
    deal_out(boxes, level(l), particles_.get(), *communicator_);
    if (same_boxes(boxes, level(l).level().boxes)) {
      if (laid_out == l - 1) make_joint(l - 1);
      if (laid_out > 0)
        level(l).mark_modified();  // cells have come where it took ghosts of ghosts from
      continue;
    }
    if (!from_deck && !boxes.empty()) fill(l - 1, time_);
    lay_out_level(l, std::move(boxes), from_deck);
    first = std::min(first, l);
    laid_out = l;
    make_joint(l - 1);
  }
  join_levels(first);
  return first;
}

// Levels whose cells ask for finer ones, coarse to fine, and how many must be read to know.
int Hierarchy::flagging_levels() const {
  return std::min(level_count(), possible_levels() - 1);
}

int Hierarchy::read_levels() const {
  return refinement_flags_.levels_read(level_count(), flagging_levels());
}

std::vector<FlagField> Hierarchy::flags() {
  std::vector<LevelSolver*> levels;
  for (int l = 0; l < read_levels(); ++l) {
    fill(l, time_);
    levels.push_back(&level(l));
  }
  return refinement_flags_.of(levels, flagging_levels(), time_, *communicator_, particles_.get());
}

void Hierarchy::restrict_all() {
  for (int l = level_count() - 2; l >= 0; --l) {
    LevelSolver& coarse = level(l);
    interfaces_[l]->restriction.run(level(l + 1).state(), coarse.state(), coarse.state_slots(),
                                    component_->transfer(), coarse.team());
    coarse.mark_modified();
  }
  for (int l = 0; l < level_count(); ++l) level(l).mark_modified();
}

// With subcycling the coarser level's limit holds for the cells that a finer level gains: their
// values lie between those of coarse cells, their steps and spacings shrink alike. In lockstep,
// with diffusion, and for a level that did not exist, rates must be measured.
void Hierarchy::measure_rates(int levels_before) {
  const bool all = scene_->refinement.lock_step || component_->diffusive();
  const int first = all ? 0 : levels_before;
  for (int l = first; l < level_count(); ++l) {
    if (component_->diffusive()) fill(l, time_);  // coefficients may depend on gradients
    maxima_[l] = level(l).initial_rates();
  }
  if (particles_ == nullptr || !component_->particles()->in_stages()) return;
  for (int l = 0; l < level_count(); ++l) {
    std::vector<double>& maxima = maxima_[l];
    const std::vector<double> own = particles_->rates(l);
    maxima.resize(std::max(maxima.size(), own.size()));
    std::copy(own.begin(), own.end(), maxima.begin());
  }
}

void Hierarchy::initialise() {
  time_ = scene_->time.initial_time;
  for (int l = 0; l < level_count(); ++l) component_->initialise(level(l).state());
  const auto start_particles = [this] {
    if (particles_ != nullptr) particles_->start(existing_levels(), time_);
  };
  start_particles();
  // Each pass may add one level; one more for every level finds that nothing changes.
  for (int pass = 0; regridder_ && pass < 2 * possible_levels(); ++pass) {
    std::vector<FlagField> wanted = flags();
    add_start_boxes(scene_->refinement, wanted);
    if (!regridder_->regrid_at_start(wanted)) break;
    lay_out(true);
    start_particles();
  }
  restrict_all();
  measure_rates(0);
}

// Memory follows the cells, but is not returned and asked for again with every regrid.
void Hierarchy::return_memory() {
  std::size_t bytes = 0;
  for (int l = 0; l < level_count(); ++l) bytes += level(l).memory_bytes();
  max_bytes_ = std::max(max_bytes_, bytes);
  if (bytes > max_bytes_ / 2) return;
  return_freed_memory();
  max_bytes_ = bytes;
}

bool Hierarchy::regrid(int step) {
  if (!regridder_ || !regridder_->looks_at(step)) return false;
  // Ghost cells that are filled to look at flags are those of the next step, except of levels that
  // are laid anew.
  using Clock = std::chrono::steady_clock;
  std::vector<Clock::time_point> filled = {Clock::now()};  // before the first, and after each level
  for (int l = 0; l < read_levels(); ++l) {
    fill(l, time_);
    filled.push_back(Clock::now());
  }
  const int levels_before = level_count();
  auto start = filled.back();
  const bool changed = regridder_->regrid(step, flags());
  if (changed) {
    start = filled[std::min(static_cast<std::size_t>(lay_out(false)), filled.size() - 1)];
    if (particles_ != nullptr) particles_->follow(existing_levels());  // rates are those of levels
    measure_rates(levels_before);
    return_memory();
    ++regrids_;
  }
  regrid_seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
  return changed;
}

bool Hierarchy::balance(int step) {
  constexpr int interval = 50;  // coarse steps: enough to measure, rare enough to cost nothing
  if (communicator_->size() == 1 || step - last_balance_ < interval) return false;
  last_balance_ = step;
  const auto start = std::chrono::steady_clock::now();
  int moved = level_count();  // the first level with boxes that moved
  for (int l = 0; l < level_count(); ++l) {
    std::vector<GridBox> boxes =
        rebalanced(level(l), particles_.get(), scene_->refinement.balance_gain, *communicator_);
    if (boxes.empty()) continue;
    lay_out_level(l, std::move(boxes), false);
    moved = std::min(moved, l);
  }
  const bool any = moved < level_count();
  if (any) {
    for (int l = std::max(0, moved - 1); l + 1 < level_count(); ++l) make_joint(l);
    join_levels(moved);
    if (particles_ != nullptr) particles_->follow(existing_levels());
    ++balances_;
  }
  balance_seconds_ +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return any;
}

std::string Hierarchy::regrid_state() const {
  return regridder_ ? to_json_text(regridder_->state()) : std::string();
}

namespace {

// A checkpoint continues on its own grid only, level by level.
void check_same_grid(const Level& now, const Level& then, const std::string& where) {
  const std::string level = now.index == 0 ? "" : fmt::format(" on level {}", now.index);
  auto differs = [&](const char* what) {
    throw InputError(
        fmt::format("{} contains a grid of [{}, {}, {}] cells{} with another {} than the deck's "
                    "[{}, {}, {}]: a restart continues with the same grid; leave {} out of --set",
                    where, then.domain.size().x, then.domain.size().y, then.domain.size().z, level,
                    what, now.domain.size().x, now.domain.size().y, now.domain.size().z,
                    now.index == 0 ? "Grid" : "Grid and AMR"));
  };
  if (!(then.domain == now.domain)) differs("number of cells");
  if (!(then.anchor == now.anchor)) differs("lower corner");
  if (!(then.spacing == now.spacing)) differs("spacing");
  if (then.periodic != now.periodic) differs("periodicity");
}

// Tiles of another size may lie elsewhere. That no cell is missing is seen when cells are read.
void check_same_cells(const Level& now, const Level& then, const std::string& where) {
  if (now.cell_count() == then.cell_count()) return;
  throw InputError(
      fmt::format("{} contains {} cells on level {}, where this deck has {}: a restart continues "
                  "with the same boxes and tiles; leave Grid and AMR out of --set",
                  where, then.cell_count(), now.index, now.cell_count()));
}

void read_level(LevelSolver& solver, const Component& component, const ArchiveStep& checkpoint) {
  Warehouse& state = solver.state();
  const std::vector<SlotInfo> slots = component.state_slots();
  const std::vector<std::vector<Label>> labels = component.checkpoint_labels();
  const int index = solver.level().index;
  for (std::size_t s = 0; s < slots.size(); ++s)
    for (std::size_t c = 0; c < labels[s].size(); ++c) {
      const FieldInfo* field = checkpoint.find(labels[s][c].name(), slots[s].material, index);
      if (field == nullptr)
        throw InputError(
            fmt::format("{} contains no {} on level {}: it cannot be restarted with this deck",
                        checkpoint.folder().string(), labels[s][c].name(), index));
      for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
        checkpoint.read_into(*field, 0, state.local_boxes()[b].cells,
                             state.view(solver.state_slots()[s], static_cast<int>(c), b));
    }
}

}  // namespace

void Hierarchy::restore(const ArchiveStep& checkpoint) {
  const std::vector<Level>& then = checkpoint.grid().levels;
  for (std::size_t l = 0; l < std::min(then.size(), solvers_.size()); ++l)
    check_same_grid(solvers_[l]->level(), then[l], checkpoint.folder().string());
  time_ = checkpoint.info().time;
  if (regridder_) {
    const auto& kept = checkpoint.info().state;
    const auto found = kept.find("regrid");
    if (found == kept.end())
      throw InputError(
          fmt::format("{} has no data of adaptive levels: it was written by a run without them; "
                      "leave AMR out of --set",
                      checkpoint.folder().string()));
    regridder_->restore(regrid_state_from_json_text(found->second));
    for (int l = 1; l < possible_levels(); ++l) {
      level(l).lay_out(regridder_->boxes(l));
      make_joint(l - 1);
    }
    join_levels();
  }
  if (static_cast<int>(checkpoint.grid().levels.size()) != level_count())
    throw InputError(fmt::format(
        "{} contains {} levels, but the deck has {}: a restart continues with the same levels",
        checkpoint.folder().string(), checkpoint.grid().levels.size(), level_count()));
  for (int l = 0; l < level_count(); ++l) {
    check_same_cells(level(l).level(), then[l], checkpoint.folder().string());
    read_level(level(l), *component_, checkpoint);
    level(l).mark_modified();
  }
  if (particles_ != nullptr) particles_->restore(checkpoint, existing_levels());
}

void Hierarchy::succeed(const Hierarchy& earlier) {
  time_ = earlier.time_;
  previous_dt_ = earlier.previous_dt_;
  costs_ = earlier.costs_;
  last_balance_ = earlier.last_balance_;
  balances_ = earlier.balances_;
  balance_seconds_ = earlier.balance_seconds_;
  if (particles_ == nullptr) return measure_rates(0);
  particles_->succeed(*earlier.particles_, existing_levels());
  // A state alone does not tell all that the last step knew of its rates: this goes on where both
  // find the same in the state.
  bool alike = true;
  for (int l = 0; l < level_count(); ++l)
    alike = alike && particles_->rates(l) == earlier.particles_->rates(l);
  if (alike)
    maxima_ = earlier.maxima_;
  else
    measure_rates(0);
}

}  // namespace sluice
