// The modules of <DataAnalysis> before a run: what each samples, on which levels, and whether the
// domain, the component and the archive can give what the deck asks for.
#include <fmt/format.h>

#include <algorithm>

#include "framework/analysis/line.hpp"
#include "framework/analysis/plane.hpp"
#include "framework/analysis/probe.hpp"
#include "framework/deck/faults.hpp"
#include "framework/run/analysis/analysis_nodes.hpp"
#include "framework/run/analysis/analysis_recorder.hpp"
#include "framework/run/component/refuse_label.hpp"

namespace sluice {
namespace {

// Names in an archive's folder that belong to others.
bool is_reserved(const std::string& name) {
  static const std::set<std::string> others = {
      "MinMax",    "planeAverage",    "planarAveTurbFluxes", "points",     "checkpoints",
      "index.xml", "particleExtract", "input.xml",           "levels.txt", "run.json"};
  return others.count(name) > 0 || (name.size() > 1 && name[0] == 't' &&
                                    name.find_first_not_of("0123456789", 1) == name.npos);
}

// InputError where what passes through surfaces is not summed.
void check_accounts(const AnalysisModule& m, const Component& component) {
  if (!component.budgets().volume_sums())
    throw DeckError(m.where,
                    fmt::format("<Module name=\"{}\">: {} does not record fluxes through control "
                                "volumes with this scheme or number of materials",
                                m.name, component.name()),
                    "planeAverage and lineExtract are supported");
}

}  // namespace

AnalysisRecorder::AnalysisRecorder(const Scene& scene, Hierarchy& hierarchy,
                                   Communicator& communicator)
    : hierarchy_(&hierarchy),
      communicator_(&communicator),
      heat_(hierarchy.component().budgets().volume_sums()) {
  std::set<std::string> names;
  std::vector<Level> levels;
  for (int l = 0; l < hierarchy.levels().possible(); ++l)
    levels.push_back(hierarchy.level(l).level());
  int volumes = 0;
  for (const AnalysisModule& m : scene.analysis.modules) {
    const int first_volume = volumes;
    volumes += static_cast<int>(m.volumes.size());
    if (takes_heat(m)) {
      check_places(m, names);
      add_planes_of_heat(m, first_volume, scene);
    }
    if (follows_particles(m)) add_particles(m);
    const bool fields = keeps_statistics(m) || averages_cells(m);
    if (!samples_levels(m) && !keeps_budgets(m) && !fields) continue;
    // Extremes are taken of what nodes have too.
    const FindQuantity find = [this, nodes = m.name == "minMax"](const AnalysedVariable& v) {
      const std::optional<Label> label = find_label(v.label);
      return nodes && label && is_of_nodes(*hierarchy_, *label)
                 ? node_quantity(*hierarchy_, v, *label)
                 : find_quantity(v);
    };
    check_fields(m, find);
    check_places(m, names);
    Module module;
    module.settings = &m;
    module.levels = make_samplers(m, levels, find);
    if (keeps_budgets(m)) module.budgets = make_budgets(m, first_volume);
    if (keeps_statistics(m)) {
      module.statistics = std::make_unique<Statistics>(m, find, hierarchy, communicator.rank());
      check_labels(module.statistics->labels(), m);
    }
    if (averages_cells(m)) {
      module.averages = std::make_unique<CellAverages>(m, find, hierarchy, communicator.rank());
      check_labels(module.averages->labels(), m);
    }
    if (module.budgets || fields ||
        std::any_of(module.levels.begin(), module.levels.end(), [](auto& s) { return !!s; }))
      modules_.push_back(std::move(module));
  }
}

// Two modules of a material would write the same files; materials have no id in common.
void AnalysisRecorder::add_particles(const AnalysisModule& m) {
  Module module;
  module.settings = &m;
  module.levels.resize(hierarchy_->levels().possible());
  module.particles = std::make_unique<ParticleHistories>(m, hierarchy_->component().particles());
  for (const Module& other : modules_)
    if (other.particles != nullptr && other.settings->material == m.material)
      throw DeckError(
          m.where,
          fmt::format("a second <Module name=\"{}\"> of this material would write the same files",
                      m.name),
          "put its variables into the first");
  modules_.push_back(std::move(module));
}

// The materials that have a field, as the component declares it.
std::vector<int> AnalysisRecorder::materials_of(Label label) const {
  const Component& component = hierarchy_->component();
  TaskList list;
  StepVariant general;
  general.kind = component.blocks().kinds() - 1;
  component.step().declare(list, general);
  component.outputs().declare_diagnostics(list, 0);
  std::vector<int> materials;
  for (const Variable& v : list.variables())
    if (v.storage == Storage::output && v.label == label) materials.push_back(v.material);
  return materials;
}

AnalysedQuantity AnalysisRecorder::find_quantity(const AnalysedVariable& v) const {
  const LevelSolver& solver = hierarchy_->level(0);  // labels are the same on all levels
  const std::optional<Label> label = find_label(v.label);
  if (label &&
      (solver.graphs().is_step_label(*label) || solver.graphs().is_diagnostic_label(*label))) {
    const std::vector<int> materials = materials_of(*label);
    if (std::find(materials.begin(), materials.end(), v.material) != materials.end())
      return {*label, v.material, component_count(label->info().type)};
    throw DeckError(
        v.where,
        fmt::format("<analyze label=\"{}\">: it does not exist for material {}, but for {}",
                    v.label, v.material, fmt::join(materials, ", ")),
        "select one with matl");
  }
  std::vector<std::string> names;
  for (Label l : all_labels())
    if (solver.graphs().is_step_label(l) || solver.graphs().is_diagnostic_label(l))
      names.push_back(l.name());
  refuse_label(v.where, LabelUse::analyse, v.label, names);
}

void AnalysisRecorder::check_place(const char* kind, const std::string& name, const Location& where,
                                   bool outside, bool clipped, std::set<std::string>& names) {
  if (is_reserved(name) || !names.insert(name).second)
    throw DeckError(
        where,
        fmt::format("<{} name=\"{}\">: another one or a part of the archive has this name", kind,
                    name),
        "choose another name");
  warn_of_place(kind, name, where, outside, clipped);
}

void AnalysisRecorder::warn_of_place(const char* kind, const std::string& name,
                                     const Location& where, bool outside, bool clipped) {
  if (outside)
    add_warning(warnings_, where,
                fmt::format("{} '{}' is outside the domain: nothing is sampled", kind, name));
  else if (clipped)
    add_warning(warnings_, where,
                fmt::format("{} '{}' extends beyond the domain: only the part inside is sampled",
                            kind, name));
}

void AnalysisRecorder::check_places(const AnalysisModule& m, std::set<std::string>& names) {
  const Level& level = hierarchy_->level(0).level();
  if (writes_one_set_of_files(m) && !names.insert(m.name).second)
    throw DeckError(m.where,
                    fmt::format("a second <Module name=\"{}\"> would write the same files", m.name),
                    "put its variables into the first");
  for (const AnalysedLine& line : m.lines) {
    const LineCells found = cells_on_line(line, level);
    check_place("line", line.name, line.where, found.cells.empty(), found.clipped, names);
  }
  const bool own_names = m.name == "controlVolFluxes";
  for (const ControlVolume& volume : m.volumes) {
    const VolumeCells found = cells_of(volume, level);
    const std::optional<Label> label = find_label(volume.name);
    if (own_names && label && label->info().centring == Centring::reduction)
      throw DeckError(
          volume.where,
          fmt::format("<box label=\"{0}\">: histories of this label have the file {0}.dat",
                      volume.name),
          "choose another name");
    if (volume.flat < 0)
      check_place("volume", volume.name, volume.where, found.cells.empty(), found.clipped, names);
    else
      warn_of_place("plane", volume.name, volume.where, found.cells.empty(), found.clipped);
  }
  for (const AnalysedPoint& p : m.points)
    check_place("point", p.name, p.where, stencil_around(p.position, level).cells.empty(), false,
                names);
  for (const AnalysedPlane& plane : m.planes) {
    const PlaneCells found = cells_in_plane(plane, level);
    check_place("plane", plane.name, plane.where, found.cells.empty(), found.clipped, names);
  }
}

void AnalysisRecorder::add_planes_of_heat(const AnalysisModule& m, int first, const Scene& scene) {
  check_accounts(m, hierarchy_->component());
  const Level& level = hierarchy_->level(0).level();
  for (std::size_t n = 0; n < m.volumes.size(); ++n) {
    const ControlVolume& plane = m.volumes[n];
    if (!level.active[plane.flat])
      throw DeckError(
          plane.where,
          fmt::format(
              "<plane>: there is no flux along {}, which is an inactive direction of this run",
              "xyz"[plane.flat]),
          "place it normal to another direction, or give this direction more than one cell");
    heat_.add(first + static_cast<int>(n), plane);
  }
  const Label label = total_heat_rate();
  const auto& saves = scene.output.saves;
  if (std::none_of(saves.begin(), saves.end(),
                   [&](const SaveRequest& r) { return r.label == label.name(); }))
    add_warning(
        warnings_, m.where,
        fmt::format("<Module name=\"{}\"> writes nothing: {} is not saved", m.name, label.name()));
}

std::unique_ptr<VolumeBudgets> AnalysisRecorder::make_budgets(const AnalysisModule& m, int first) {
  check_accounts(m, hierarchy_->component());
  if (m.material >= hierarchy_->component().material_count())
    throw DeckError(m.where,
                    fmt::format("<Module name=\"{}\">: material {} is not one of {}", m.name,
                                m.material, hierarchy_->component().name()),
                    "materials count from 0");
  return std::make_unique<VolumeBudgets>(m, first, *hierarchy_, *communicator_);
}

// Two modules may not both be the source of a label.
void AnalysisRecorder::check_labels(const std::vector<Label>& labels,
                                    const AnalysisModule& m) const {
  const std::vector<Label> others = field_labels();
  for (const Label l : labels)
    if (std::find(others.begin(), others.end(), l) != others.end())
      throw DeckError(
          m.where,
          fmt::format("<Module name=\"{}\">: another module already computes {}", m.name, l.name()),
          "analyse the variable in one module");
}

}  // namespace sluice
