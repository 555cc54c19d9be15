// Collecting pieces and handing them to the archive.
#include "framework/run/simulation/output_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "framework/run/component/refuse_label.hpp"

namespace sluice {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

SavedLabels sort_saves(const OutputSettings& output, const Hierarchy& hierarchy,
                       const std::vector<Label>& analysed) {
  const LevelSolver& solver = hierarchy.level(0);
  std::vector<Label> of_particles;
  if (hierarchy.particles() != nullptr) of_particles = hierarchy.particles()->labels();
  const auto is_of_particles = [&](Label l) {
    return std::find(of_particles.begin(), of_particles.end(), l) != of_particles.end();
  };
  std::vector<Label> on_grid;
  if (const ParticleMethod* method = hierarchy.component().particles())
    on_grid = method->grid_labels();
  const auto is_on_grid = [&](Label l) {
    return std::find(on_grid.begin(), on_grid.end(), l) != on_grid.end();
  };
  const auto is_analysed = [&](Label l) {
    return std::find(analysed.begin(), analysed.end(), l) != analysed.end();
  };
  SavedLabels saved;
  for (const SaveRequest& request : output.saves) {
    const std::optional<Label> label = find_label(request.label);
    auto add = [&](std::vector<Label>& list) {
      if (std::find(list.begin(), list.end(), *label) == list.end()) list.push_back(*label);
    };
    if (label && label->info().centring == Centring::reduction) {
      add(saved.histories);
    } else if (label && is_of_particles(*label)) {
      add(saved.particles);
    } else if (label && is_on_grid(*label)) {
      add(saved.on_grid);
    } else if (label && is_analysed(*label)) {
      add(saved.analysed);
    } else if (label && (solver.graphs().is_step_label(*label) ||
                         solver.graphs().is_diagnostic_label(*label))) {
      // Of some materials the one, of others the other.
      if (solver.graphs().is_step_label(*label)) add(saved.step);
      if (solver.graphs().is_diagnostic_label(*label)) add(saved.diagnostic);
    } else if (const ParticleMethod* method = hierarchy.component().particles();
               method != nullptr && method->is_absent(request.label)) {
      continue;
    } else {
      std::vector<std::string> names;
      for (Label l : all_labels())
        if (solver.graphs().is_step_label(l) || solver.graphs().is_diagnostic_label(l) ||
            is_analysed(l) || is_of_particles(l) || is_on_grid(l) ||
            l.info().centring == Centring::reduction)
          names.push_back(l.name());
      refuse_label(request.where, LabelUse::save, request.label, names);
    }
  }
  std::sort(saved.step.begin(), saved.step.end());
  std::sort(saved.diagnostic.begin(), saved.diagnostic.end());
  return saved;
}

OutputWriter::OutputWriter(const Scene& scene, const Component& component, Hierarchy& hierarchy,
                           ArchiveWriter archive, AnalysisRecorder* analysis)
    : scene_(&scene),
      component_(&component),
      hierarchy_(&hierarchy),
      analysis_(analysis),
      archive_(std::move(archive)),
      saved_(sort_saves(scene.output, hierarchy,
                        analysis != nullptr ? analysis->field_labels() : std::vector<Label>())) {}

void OutputWriter::follow(const Scene& scene, const Component& component, Hierarchy& hierarchy,
                          AnalysisRecorder* analysis) {
  scene_ = &scene;
  component_ = &component;
  hierarchy_ = &hierarchy;
  analysis_ = analysis;
  saved_ = sort_saves(scene.output, hierarchy, analysis->field_labels());
}

bool OutputWriter::wants(Label label, int material, int level, const SaveRequest*& request) const {
  const int materials = component_->material_count();
  const int levels = hierarchy_->level_count();
  for (const SaveRequest& r : scene_->output.saves)
    if (r.label == label.name() && r.materials.contains(material, materials) &&
        r.levels.contains(level, levels)) {
      request = &r;
      return true;
    }
  return false;
}

void OutputWriter::add_output_pieces(LevelSolver& solver, bool initial,
                                     std::vector<FieldPiece>& pieces) const {
  const int level = solver.level().index;
  Warehouse& outputs = solver.outputs();
  std::vector<Label> labels = saved_.diagnostic;
  std::erase_if(labels, [&](Label l) {
    return std::find(saved_.step.begin(), saved_.step.end(), l) != saved_.step.end();
  });
  if (!initial) labels.insert(labels.end(), saved_.step.begin(), saved_.step.end());
  const int materials = component_->material_count();
  for (std::size_t n = 0; n < labels.size() * materials; ++n) {
    const Label label = labels[n / materials];
    const int material = static_cast<int>(n % materials);
    const SaveRequest* request = nullptr;
    const int slot = outputs.find(label, material);
    if (slot < 0 || !wants(label, material, level, request)) continue;
    for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b)
      for (int c = 0; c < outputs.info(slot).components; ++c) {
        const GridBox& box = outputs.local_boxes()[b];
        FieldPiece piece;
        piece.label = label;
        piece.material = material;
        piece.level = level;
        piece.box_id = box.id;
        piece.component = c;
        piece.cells = piece_cells(box.cells, label, outputs.level());
        piece.view = outputs.view(slot, c, b);
        piece.gzip = request->compression == "gzip" || scene_->output.compression == "gzip";
        pieces.push_back(piece);
      }
  }
}

// Of the materials that have them.
void OutputWriter::add_analysed_pieces(LevelSolver& solver, std::vector<FieldPiece>& pieces) const {
  const Warehouse& outputs = solver.outputs();
  const int level = solver.level().index;
  for (int s = 0; s < outputs.slot_count(); ++s) {
    const SlotInfo& slot = outputs.info(s);
    if (std::find(saved_.analysed.begin(), saved_.analysed.end(), slot.label) ==
        saved_.analysed.end())
      continue;
    const SaveRequest* request = nullptr;
    if (!wants(slot.label, slot.material, level, request)) continue;
    for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b)
      for (int c = 0; c < slot.components; ++c) {
        const GridBox& box = outputs.local_boxes()[b];
        FieldPiece piece;
        piece.label = slot.label;
        piece.material = slot.material;
        piece.level = level;
        piece.box_id = box.id;
        piece.component = c;
        piece.cells = box.cells;
        piece.view = outputs.view(s, c, b);
        piece.gzip = request->compression == "gzip" || scene_->output.compression == "gzip";
        pieces.push_back(piece);
      }
  }
}

void OutputWriter::add_checkpoint_pieces(LevelSolver& solver,
                                         std::vector<FieldPiece>& pieces) const {
  const Warehouse& state = solver.state();
  const std::vector<SlotInfo> slots = component_->state().slots();
  const std::vector<std::vector<Label>> labels = component_->state().checkpoint_labels();
  for (std::size_t s = 0; s < slots.size(); ++s) {
    const int slot = state.find(slots[s].label, slots[s].material);
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      for (std::size_t c = 0; c < labels[s].size(); ++c) {
        const GridBox& box = state.local_boxes()[b];
        FieldPiece piece;
        piece.label = labels[s][c];
        piece.material = slots[s].material;
        piece.level = solver.level().index;
        piece.box_id = box.id;
        piece.cells = box.cells;
        piece.view = state.view(slot, static_cast<int>(c), b);
        pieces.push_back(piece);
      }
  }
}

void OutputWriter::write_output(const StepInfo& info, bool initial) {
  const auto start = Clock::now();
  hierarchy_->settle_particles();
  std::vector<Label> computed = saved_.diagnostic;
  if (!saved_.analysed.empty())
    for (const Label l : analysis_->sources_of(saved_.analysed))
      if (std::find(computed.begin(), computed.end(), l) == computed.end()) computed.push_back(l);
  hierarchy_->compute_diagnostics(info.time, computed);
  if (!saved_.analysed.empty()) analysis_->store_fields(saved_.analysed, info.time);
  std::vector<FieldPiece> pieces;
  for (int l = 0; l < hierarchy_->level_count(); ++l)
    add_output_pieces(hierarchy_->level(l), initial, pieces);
  for (int l = 0; l < hierarchy_->level_count() && !saved_.analysed.empty(); ++l)
    add_analysed_pieces(hierarchy_->level(l), pieces);
  ParticlePieces particles;
  if (!saved_.particles.empty()) {
    const SaveRequest* request = nullptr;
    hierarchy_->particles()->add_pieces(
        [&](Label label, int material, int level) {
          return wants(label, material, level, request);
        },
        particles);
    pieces.insert(pieces.end(), particles.pieces.begin(), particles.pieces.end());
  }
  std::vector<GridFields> on_grid;
  if (!saved_.on_grid.empty()) {
    const SaveRequest* request = nullptr;
    on_grid =
        hierarchy_->particle_fields(saved_.on_grid, [&](Label label, int material, int level) {
          return wants(label, material, level, request);
        });
    for (const GridFields& of_level : on_grid) {
      const std::vector<FieldPiece> more = of_level.pieces();
      pieces.insert(pieces.end(), more.begin(), more.end());
    }
  }
  archive_.write_output(info, hierarchy_->levels().grid(), pieces);
  seconds_ += seconds_since(start);
}

void OutputWriter::write_checkpoint(const StepInfo& info) {
  const auto start = Clock::now();
  hierarchy_->settle_particles();
  std::vector<FieldPiece> pieces;
  for (int l = 0; l < hierarchy_->level_count(); ++l)
    add_checkpoint_pieces(hierarchy_->level(l), pieces);
  if (analysis_ != nullptr) analysis_->add_checkpoint_pieces(pieces);
  ParticlePieces particles;
  if (hierarchy_->particles() != nullptr) {
    hierarchy_->particles()->add_pieces([](Label, int, int) { return true; }, particles);
    pieces.insert(pieces.end(), particles.pieces.begin(), particles.pieces.end());
  }
  archive_.write_checkpoint(info, hierarchy_->levels().grid(), pieces);
  seconds_ += seconds_since(start);
}

bool OutputWriter::writes_histories(int step) const {
  HistoryControl control;
  control.frequency = scene_->output.reduction_frequency;
  control.on_step = scene_->output.reduction_on_timestep;
  return !saved_.histories.empty() && control.selects(step);
}

void OutputWriter::write_histories(int step, double time, const Totals& totals) {
  for (Label label : saved_.histories) {
    const std::optional<double> analysed =
        analysis_ != nullptr ? analysis_->history(label) : std::nullopt;
    if (analysed)
      archive_.history(label.name(), -1, step, time, *analysed);
    else if (label.info().type == ValueType::vector)
      archive_.history(label.name(), -1, step, time,
                       component_->outputs().history_vector(label, totals));
    else
      archive_.history(label.name(), -1, step, time,
                       component_->outputs().history_value(label, totals));
  }
}

void OutputWriter::finish(const std::string& run_json) {
  archive_.write_text("run.json", run_json);
  archive_.finish();
}

}  // namespace sluice
