// When samples are taken, of which labels on which levels; their files to disk.
#include "framework/run/analysis/analysis_recorder.hpp"

#include <algorithm>

#include "framework/base/json.hpp"
#include "framework/run/analysis/analysis_nodes.hpp"

namespace sluice {
namespace {

constexpr std::size_t max_pending_lines = 50000;  // in memory before they are written

void sort_once(std::vector<Label>& labels) {
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
}

}  // namespace

void AnalysisRecorder::open(const std::filesystem::path& folder) {
  folder_ = folder;
}

void AnalysisRecorder::adopt(const std::filesystem::path& earlier, double time) {
  on_root([&] {
    for (const Module& m : modules_)
      for (const auto& sampler : m.levels)
        if (sampler != nullptr) sampler->adopt(earlier, folder_, time);
    for (const Module& m : modules_) {
      if (m.budgets != nullptr) m.budgets->adopt(earlier, folder_, time);
      if (m.particles != nullptr) m.particles->adopt(earlier, folder_, time);
    }
  });
}

std::vector<Label> AnalysisRecorder::step_labels(double end) const {
  std::vector<Label> labels;
  for (const Module& m : modules_) {
    if (!m.due(end)) continue;
    for (const auto& sampler : m.levels)
      if (sampler != nullptr)
        for (const AnalysedQuantity& q : sampler->quantities())
          if (hierarchy_->level(0).graphs().is_step_label(q.label)) labels.push_back(q.label);
    if (m.statistics != nullptr)
      for (const AnalysedQuantity& q : m.statistics->quantities())
        if (hierarchy_->level(0).graphs().is_step_label(q.label)) labels.push_back(q.label);
  }
  sort_once(labels);
  return labels;
}

void AnalysisRecorder::visit(const std::vector<Module*>& modules, const Visit& work) const {
  for (const Module* m : modules)
    for (int l = 0; l < hierarchy_->level_count(); ++l)
      if (LevelSampler* sampler = m->levels[l].get()) work(l, *sampler);
}

// Where the cells of lines lie now.
void AnalysisRecorder::lay_out() {
  if (layouts_ == hierarchy_->levels().layouts()) return;
  layouts_ = hierarchy_->levels().layouts();
  for (const Module& m : modules_)
    for (std::size_t l = 0; l < m.levels.size(); ++l)
      if (m.levels[l] != nullptr)
        m.levels[l]->lay_out(hierarchy_->level(static_cast<int>(l)).level());
  for (const Module& m : modules_)
    if (m.budgets != nullptr) m.budgets->lay_out();
  for (const Module& m : modules_)
    if (m.statistics != nullptr) m.statistics->follow_levels();
}

// Labels that are functions of the state, on the levels that are asked for them.
bool AnalysisRecorder::compute_labels(const std::vector<Module*>& due, double time) {
  std::vector<std::vector<Label>> labels(hierarchy_->level_count());
  visit(due, [&](int l, LevelSampler& sampler) {
    for (const AnalysedQuantity& q : sampler.quantities())
      if (!hierarchy_->level(l).graphs().is_step_label(q.label) &&
          !is_of_nodes(*hierarchy_, q.label))
        labels[l].push_back(q.label);
  });
  for (const Module* m : due)
    if (m->statistics != nullptr)
      for (const AnalysedQuantity& q : m->statistics->quantities())
        if (!hierarchy_->level(0).graphs().is_step_label(q.label))
          for (std::vector<Label>& of_level : labels) of_level.push_back(q.label);
  if (std::all_of(labels.begin(), labels.end(), [](auto& of_level) { return of_level.empty(); }))
    return false;
  hierarchy_->fill_ghosts(time);
  for (std::size_t l = 0; l < labels.size(); ++l) {
    sort_once(labels[l]);
    hierarchy_->level(static_cast<int>(l)).compute_diagnostics(time, labels[l]);
  }
  return true;
}

void AnalysisRecorder::record(double dt, const std::vector<double>& sums) {
  for (const Module& m : modules_)
    if (m.budgets != nullptr) m.budgets->record(dt, sums);
  if (heat_.any()) heat_.record(dt, sums);
}

std::optional<double> AnalysisRecorder::history(Label label) const {
  if (!heat_.any() || label != total_heat_rate()) return std::nullopt;
  return heat_.rate();
}

bool AnalysisRecorder::sample(int step, double time) {
  std::vector<Module*> due;
  for (Module& m : modules_)
    if (m.due(time)) due.push_back(&m);
  if (due.empty()) return false;
  lay_out();
  const bool filled = compute_labels(due, time);
  std::vector<AnalysedQuantity> sampled;
  visit(due, [&](int, LevelSampler& sampler) {
    sampled.insert(sampled.end(), sampler.quantities().begin(), sampler.quantities().end());
  });
  store_node_quantities(*hierarchy_, sampled);
  std::vector<double> mine;
  visit(due, [&](int l, LevelSampler& sampler) {
    sampler.pack(hierarchy_->level(l).outputs(), communicator_->rank(), mine);
    pending_lines_ += sampler.lines();
  });
  RankNumbers numbers(communicator_->gather(
      std::string(reinterpret_cast<const char*>(mine.data()), mine.size() * sizeof(double))));
  if (communicator_->is_root())
    visit(due, [&](int, LevelSampler& sampler) { sampler.write(numbers, step, time); });
  if (communicator_->is_root())
    visit(due, [&](int, LevelSampler& sampler) { sampler.end_sample(step, time); });
  for (Module* m : due) {
    m->last = time;
    if (m->statistics != nullptr) m->statistics->sample();
    if (m->particles != nullptr) {
      m->particles->sample(*hierarchy_->particles(), time, *communicator_);
      pending_lines_ += m->particles->lines();
    }
    if (m->budgets == nullptr) continue;
    m->budgets->sample(time);
    pending_lines_ += m->budgets->lines();
  }
  if (pending_lines_ > max_pending_lines) flush();
  return filled;
}

void AnalysisRecorder::flush() {
  if (!any()) return;
  pending_lines_ = 0;
  on_root([&] {
    for (const Module& m : modules_)
      for (const auto& sampler : m.levels)
        if (sampler != nullptr) sampler->flush(folder_);
    for (const Module& m : modules_) {
      if (m.budgets != nullptr) m.budgets->flush(folder_);
      if (m.particles != nullptr) m.particles->flush(folder_);
    }
  });
}

void AnalysisRecorder::on_root(const std::function<void()>& work) const {
  std::string problem;
  if (communicator_->is_root()) try {
      work();
    } catch (const SystemError& e) {
      problem = e.what();
    }
  problem = communicator_->broadcast(problem);
  if (!problem.empty()) throw SystemError(problem);
}

std::vector<Label> AnalysisRecorder::field_labels() const {
  std::vector<Label> labels;
  for (const Module& m : modules_)
    for (const std::vector<Label>& own :
         {m.statistics != nullptr ? m.statistics->labels() : std::vector<Label>{},
          m.averages != nullptr ? m.averages->labels() : std::vector<Label>{}})
      labels.insert(labels.end(), own.begin(), own.end());
  return labels;
}

void AnalysisRecorder::store_fields(const std::vector<Label>& wanted, double time) {
  lay_out();
  for (const Module& m : modules_) {
    if (m.statistics != nullptr) m.statistics->store(wanted);
    if (m.averages != nullptr) m.averages->store(wanted, time);
  }
}

std::vector<Label> AnalysisRecorder::sources_of(const std::vector<Label>& wanted) const {
  std::vector<Label> labels;
  for (const Module& m : modules_) {
    if (m.averages == nullptr) continue;
    const std::vector<Label> own = m.averages->sources(wanted);
    labels.insert(labels.end(), own.begin(), own.end());
  }
  sort_once(labels);
  return labels;
}

void AnalysisRecorder::add_checkpoint_pieces(std::vector<FieldPiece>& pieces) const {
  for (const Module& m : modules_)
    if (m.statistics != nullptr) m.statistics->add_checkpoint_pieces(pieces);
}

std::string AnalysisRecorder::state() const {
  Json kept = Json::array();
  for (const Module& m : modules_) {
    Json last = m.last ? Json(*m.last) : Json(nullptr);
    if (m.budgets != nullptr)
      kept.push_back({{"last", last}, {"passed", m.budgets->state()}});
    else if (m.statistics != nullptr)
      kept.push_back({{"last", last}, {"samples", m.statistics->samples()}});
    else
      kept.push_back(last);
  }
  return kept.dump();
}

void AnalysisRecorder::restore(const std::string& json_text, const ArchiveStep* checkpoint) {
  lay_out();
  const Json kept = Json::parse(json_text);
  for (std::size_t n = 0; n < modules_.size() && n < kept.size(); ++n) {
    Module& m = modules_[n];
    const bool more = kept.at(n).is_object();
    const Json& last = more ? kept.at(n).at("last") : kept.at(n);
    if (last.is_number()) m.last = last.get<double>();
    if (more && m.budgets != nullptr && kept.at(n).contains("passed"))
      m.budgets->restore(kept.at(n).at("passed").get<std::vector<std::vector<double>>>());
    if (more && m.statistics != nullptr && kept.at(n).contains("samples") && checkpoint != nullptr)
      m.statistics->restore(*checkpoint, kept.at(n).at("samples").get<int>());
  }
}

}  // namespace sluice
