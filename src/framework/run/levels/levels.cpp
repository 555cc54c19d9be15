#include "framework/run/levels/levels.hpp"

#include <algorithm>
#include <utility>

namespace sluice {
namespace {

int substeps_of(const Level& level, bool lock_step) {
  return lock_step ? 1 : std::max({level.ratio.x, level.ratio.y, level.ratio.z});
}

}  // namespace

Levels::Levels(const Scene& scene, const Component& component, Communicator& communicator,
               SolverOptions options)
    : scene_(&scene), component_(&component), communicator_(&communicator) {
  const std::vector<Level>& levels = scene.grid.levels;
  options.joined = levels.size() > 1;
  options.substeps = 1;
  if (options.team == nullptr) options.team = std::make_shared<const ThreadTeam>(options.threads);
  StepShape shape;
  component.step().declare_stages(shape);
  const bool lock_step = scene.refinement.lock_step || !shape.plain();
  for (const Level& level : levels) {
    substeps_.push_back(level.index == 0 ? 1 : substeps_of(level, lock_step));
    options.substeps *= substeps_.back();
    in_coarse_step_.push_back(options.substeps);
    solvers_.push_back(std::make_unique<LevelSolver>(component, level, communicator, options));
  }
  ends_of_levels_.resize(levels.size());
  interfaces_.resize(levels.size());
  if (component.budgets().volume_sums())
    for (const ControlVolume& v : control_volumes(scene.analysis))
      volumes_.push_back(cells_of(v, levels.front()));
  for (int l = 0; l + 1 < count(); ++l) make_interface(l);
  connect();
}

int Levels::count() const {
  int n = 1;
  while (n < possible() && !solvers_[n]->level().boxes.empty()) ++n;
  return n;
}

std::vector<LevelSolver*> Levels::existing() {
  std::vector<LevelSolver*> levels;
  for (int l = 0; l < count(); ++l) levels.push_back(solvers_[l].get());
  return levels;
}

Grid Levels::grid() const {
  Grid grid;
  for (int l = 0; l < count(); ++l) grid.levels.push_back(solvers_[l]->level());
  return grid;
}

std::int64_t Levels::cell_count() const {
  std::int64_t n = 0;
  for (int l = 0; l < count(); ++l) n += solvers_[l]->level().cell_count();
  return n;
}

const Level* Levels::finer_than(int l) const {
  return l + 1 < count() ? &solvers_[l + 1]->level() : nullptr;
}

void Levels::make_interface(int coarser) {
  const int rank = communicator_->rank(), width = solvers_[coarser]->states().width();
  auto& interface = interfaces_[coarser];
  interface.reset();
  const Level& coarse = solvers_[coarser]->level();
  const Level& fine = solvers_[coarser + 1]->level();
  if (fine.boxes.empty()) return;
  interface = std::make_unique<LevelInterface>(LevelInterface{
      Interpolation::for_ghosts(coarse, width, fine, width, rank, LevelStates::arrays),
      FluxRegister(coarse, fine, component_->levels().transfer().flux_quantities(), rank),
      Restriction(coarse, fine, rank)});
}

void Levels::connect(int first) {
  ++layouts_;
  const int rank = communicator_->rank();
  for (int l = std::max(0, first - 1); l < possible() && possible() > 1; ++l) {
    const Level& level = solvers_[l]->level();
    FluxRecorder recorder;
    if (interfaces_[l] != nullptr) recorder.as_coarse = &interfaces_[l]->fluxes.coarse_faces();
    if (l > 0 && interfaces_[l - 1] != nullptr)
      recorder.as_fine = &interfaces_[l - 1]->fluxes.fine_faces();
    if (l >= first)
      ends_of_levels_[l] = InterfaceDistance(
          level, rank, component_->levels().interface_depth(level), solvers_[l]->states().width());
    if (!ends_of_levels_[l].empty()) recorder.ends = &ends_of_levels_[l];
    solvers_[l]->graphs().join(recorder, LevelCoverage(level, finer_than(l), rank));
  }
  watch_volumes(first);
}

void Levels::watch_volumes(int first) {
  if (volumes_.empty()) return;
  for (int l = std::max(0, first - 1); l < possible(); ++l)
    solvers_[l]->graphs().watch(VolumeFaces(volumes_, scene_->grid.levels.front(),
                                            solvers_[l]->level(), finer_than(l),
                                            communicator_->rank()));
}

void Levels::lay_out(int l, std::vector<GridBox> boxes, bool from_deck) {
  LevelSolver& solver = *solvers_[l];
  const Level earlier = solver.level();
  const Warehouse before = solver.lay_out(std::move(boxes));
  const Level& now = solver.level();
  if (now.boxes.empty()) return;
  if (from_deck) {
    component_->state().initialise(solver.state());
    return;
  }
  const int rank = communicator_->rank();
  if (!earlier.boxes.empty())
    LevelCopy(earlier, now, rank).run(before, solver.state(), solver.state_slots());
  if (l == 0 || solver.state_slots().empty()) return;  // cells of solids carry nothing
  LevelSolver& coarser = *solvers_[l - 1];
  Interpolation fresh = Interpolation::for_new_cells(coarser.level(), coarser.states().width(), now,
                                                     earlier.boxes, rank);
  fresh.run(nullptr, &coarser.state(), 1.0, solver.state(), solver.state_slots(),
            component_->levels().transfer(), scene_->refinement.interpolation_order, solver.team());
}

void Levels::restrict_all() {
  for (int l = count() - 2; l >= 0; --l) {
    LevelSolver& coarse = *solvers_[l];
    interfaces_[l]->restriction.run(solvers_[l + 1]->state(), coarse.state(), coarse.state_slots(),
                                    component_->levels().transfer(), coarse.team());
    coarse.mark_modified();
  }
  for (int l = 0; l < count(); ++l) solvers_[l]->mark_modified();
}

}  // namespace sluice
