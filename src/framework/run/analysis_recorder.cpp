// Sampling and writing what analyses ask for.
#include "framework/run/analysis_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/deck/nearest_name.hpp"

namespace sluice {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t most_pending_lines = 50000;  // in memory before they are written

// The indices of a label in a box: a face label also has the closing face of the domain.
IndexBox indices_in(const IndexBox& cells, Label label, const Level& level) {
  IndexBox box = cells;
  const int d = face_direction(label.info().centring);
  if (d >= 0 && level.active[static_cast<std::size_t>(d)] &&
      cells.upper[d] == level.domain.upper[d])
    box.upper[d] += 1;
  return box;
}

std::string bracketed(const std::vector<double>& v) {
  if (v.size() == 1) return fmt::format("{:.17g}", v.front());
  return fmt::format("[{:.17g}]", fmt::join(v, " "));
}

// Names in an archive's folder that belong to others.
bool is_reserved(const std::string& name) {
  return name == "MinMax" || name == "checkpoints" ||
         (name.size() > 1 && name[0] == 't' &&
          name.find_first_not_of("0123456789", 1) == name.npos);
}

}  // namespace

bool sample_is_due(const AnalysisModule& m, std::optional<double> last, double time) {
  if (time < m.time_start || time > m.time_stop) return false;
  if (!last || m.sampling_frequency <= 0) return true;
  return time >= *last + 1.0 / m.sampling_frequency;
}

bool AnalysisRecorder::Sampler::due(double time) const {
  return sample_is_due(*module, last, time);
}

AnalysisRecorder::AnalysisRecorder(const Scene& scene, LevelSolver& solver,
                                   Communicator& communicator)
    : scene_(&scene), solver_(&solver), communicator_(&communicator) {
  std::set<std::string> lines;
  for (const AnalysisModule& m : scene.analysis.modules) {
    if (m.name != "minMax" && m.name != "lineExtract") continue;
    Sampler sampler;
    sampler.module = &m;
    for (const AnalysedVariable& v : m.variables)
      if (v.levels.contains(0, static_cast<int>(scene.grid.levels.size())))
        sampler.quantities.push_back(find_quantity(v));
    if (m.name == "lineExtract")
      add_points(sampler, lines);
    else
      add_minmax_files(sampler);
    if (!sampler.quantities.empty() && !sampler.files.empty())
      samplers_.push_back(std::move(sampler));
  }
}

AnalysisRecorder::Quantity AnalysisRecorder::find_quantity(const AnalysedVariable& v) const {
  const std::optional<Label> label = find_label(v.label);
  if (label && (solver_->is_step_label(*label) || solver_->is_diagnostic_label(*label)))
    return {*label, v.material, component_count(label->info().type)};
  std::vector<std::string> names;
  for (Label l : all_labels())
    if (solver_->is_step_label(l) || solver_->is_diagnostic_label(l)) names.push_back(l.name());
  throw InputError(fmt::format("{}: <analyze label=\"{}\"> names no field of this run ({})",
                               to_string(v.where), v.label, suggest_name(v.label, names)));
}

void AnalysisRecorder::add_minmax_files(Sampler& sampler) const {
  std::set<std::string> names;
  std::vector<Quantity> distinct;
  for (const Quantity& q : sampler.quantities) {
    const std::string name = fmt::format("MinMax/L-0/{}_{}", q.label.name(), q.material);
    if (!names.insert(name).second) continue;
    distinct.push_back(q);
    sampler.files.emplace_back(name,
                               fmt::format("# time[s] minimum maximum of {} [{}], material {}\n",
                                           q.label.name(), q.label.info().unit, q.material),
                               0);
  }
  sampler.quantities = distinct;
}

void AnalysisRecorder::add_points(Sampler& sampler, std::set<std::string>& lines) {
  std::string columns = "# X Y Z Timestep Time";
  for (const Quantity& q : sampler.quantities)
    for (int c = 0; c < q.components; ++c)
      columns += fmt::format(" {}_{}{}", q.label.name(), q.material,
                             q.components == 1 ? "" : std::string(".") + "xyz"[c]);
  for (const AnalysedLine& line : sampler.module->lines) {
    if (is_reserved(line.name) || !lines.insert(line.name).second)
      throw InputError(
          fmt::format("{}: <line name=\"{}\">: another line or a part of the archive "
                      "has this name; choose another one",
                      to_string(line.where), line.name));
    const LineCells found = cells_on_line(line, scene_->grid.levels.front());
    if (found.cells.empty())
      warnings_.push_back(fmt::format("{}: line '{}' lies outside the domain: nothing is taken",
                                      to_string(line.where), line.name));
    else if (found.clipped)
      warnings_.push_back(
          fmt::format("{}: line '{}' leaves the domain: only the part inside is "
                      "taken",
                      to_string(line.where), line.name));
    for (IntVec3 c : found.cells) {
      sampler.points.push_back(find_point(c));
      sampler.files.emplace_back(fmt::format("{}/L-0/i{}_j{}_k{}", line.name, c.x, c.y, c.z),
                                 columns + "\n", 4);
    }
  }
}

void AnalysisRecorder::open(const std::filesystem::path& folder) {
  folder_ = folder;
}

void AnalysisRecorder::adopt(const std::filesystem::path& earlier, double time) {
  on_root([&] {
    for (const Sampler& s : samplers_)
      for (const AnalysisFile& f : s.files) f.adopt(earlier, folder_, time);
  });
}

std::vector<Label> AnalysisRecorder::step_labels(double end) const {
  std::vector<Label> labels;
  for (const Sampler& s : samplers_)
    if (s.due(end))
      for (const Quantity& q : s.quantities)
        if (solver_->is_step_label(q.label)) labels.push_back(q.label);
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

bool AnalysisRecorder::sample(int step, double time) {
  std::vector<Label> computed;
  std::vector<Sampler*> due;
  for (Sampler& s : samplers_) {
    if (!s.due(time)) continue;
    due.push_back(&s);
    for (const Quantity& q : s.quantities)
      if (solver_->is_diagnostic_label(q.label) && !solver_->is_step_label(q.label))
        computed.push_back(q.label);
  }
  if (due.empty()) return false;
  std::sort(computed.begin(), computed.end());
  computed.erase(std::unique(computed.begin(), computed.end()), computed.end());
  if (!computed.empty()) {
    solver_->fill_ghosts(time);
    solver_->compute_diagnostics(time, computed);
  }
  std::vector<double> mine;
  for (const Sampler* s : due) pack(*s, mine);
  std::vector<std::vector<double>> ranks;
  for (const std::string& text : communicator_->gather(
           std::string(reinterpret_cast<const char*>(mine.data()), mine.size() * sizeof(double)))) {
    std::vector<double>& numbers = ranks.emplace_back(text.size() / sizeof(double));
    std::memcpy(numbers.data(), text.data(), text.size());
  }
  std::vector<std::size_t> next(ranks.size(), 0);
  for (Sampler* s : due) {
    if (communicator_->is_root()) write(*s, ranks, next, step, time);
    s->last = time;
    pending_lines_ += s->files.size();
  }
  if (pending_lines_ > most_pending_lines) flush();
  return !computed.empty();
}

AnalysisRecorder::Point AnalysisRecorder::find_point(IntVec3 cell) const {
  Point point{cell};
  std::vector<int> boxes(static_cast<std::size_t>(communicator_->size()), 0);
  for (const GridBox& b : scene_->grid.levels.front().boxes) {
    int& local = boxes[static_cast<std::size_t>(b.owner)];
    if (b.cells.contains(cell)) {
      point.owner = b.owner;
      point.box = local;
    }
    ++local;
  }
  return point;
}

void AnalysisRecorder::pack(const Sampler& s, std::vector<double>& numbers) const {
  if (s.points.empty()) {
    for (const Quantity& q : s.quantities) pack_extremes(q, numbers);
    return;
  }
  const Warehouse& outputs = solver_->outputs();
  for (const Point& p : s.points) {
    if (p.owner != communicator_->rank()) continue;
    for (const Quantity& q : s.quantities)
      for (int c = 0; c < q.components; ++c)
        numbers.push_back(outputs.view(outputs.find(q.label, q.material), c, p.box)(p.cell));
  }
}

void AnalysisRecorder::pack_extremes(const Quantity& q, std::vector<double>& numbers) const {
  const Warehouse& outputs = solver_->outputs();
  const int slot = outputs.find(q.label, q.material);
  for (int c = 0; c < q.components; ++c) {
    double least = infinity, most = -infinity;
    for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b) {
      const RealView v = outputs.view(slot, c, b);
      for_each_cell(indices_in(outputs.local_boxes()[static_cast<std::size_t>(b)].cells, q.label,
                               outputs.level()),
                    [&](IntVec3 i) {
                      const double x = v(i) + 0.0;  // -0 becomes 0: their order would show
                      least = std::min(least, x);
                      most = std::max(most, x);
                    });
    }
    numbers.push_back(least);
    numbers.push_back(most);
  }
}

void AnalysisRecorder::write_extremes(Sampler& s, const std::vector<std::vector<double>>& ranks,
                                      std::vector<std::size_t>& next, double time) const {
  for (std::size_t n = 0; n < s.quantities.size(); ++n) {
    const auto components = static_cast<std::size_t>(s.quantities[n].components);
    std::vector<double> least(components, infinity), most(components, -infinity);
    for (std::size_t r = 0; r < ranks.size(); ++r)
      for (std::size_t c = 0; c < components; ++c) {
        least[c] = std::min(least[c], ranks[r][next[r]++]);
        most[c] = std::max(most[c], ranks[r][next[r]++]);
      }
    s.files[n].append(fmt::format("{:.17g} {} {}", time, bracketed(least), bracketed(most)));
  }
}

void AnalysisRecorder::write(Sampler& s, const std::vector<std::vector<double>>& ranks,
                             std::vector<std::size_t>& next, int step, double time) const {
  if (s.points.empty()) {
    write_extremes(s, ranks, next, time);
    return;
  }
  std::size_t columns = 0;
  for (const Quantity& q : s.quantities) columns += static_cast<std::size_t>(q.components);
  for (std::size_t n = 0; n < s.points.size(); ++n) {
    const auto owner = static_cast<std::size_t>(s.points[n].owner);
    const double* first = ranks[owner].data() + next[owner];
    next[owner] += columns;
    const Vec3 x = scene_->grid.levels.front().centre(s.points[n].cell);
    s.files[n].append(fmt::format("{:.17g} {:.17g} {:.17g} {} {:.17g} {:.17g}", x.x, x.y, x.z, step,
                                  time, fmt::join(first, first + columns, " ")));
  }
}

void AnalysisRecorder::flush() {
  if (!any()) return;
  pending_lines_ = 0;
  on_root([&] {
    for (Sampler& s : samplers_)
      for (AnalysisFile& f : s.files) f.flush(folder_);
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

std::string AnalysisRecorder::state() const {
  nlohmann::json last = nlohmann::json::array();
  for (const Sampler& s : samplers_)
    last.push_back(s.last ? nlohmann::json(*s.last) : nlohmann::json(nullptr));
  return last.dump();
}

void AnalysisRecorder::restore(const std::string& json_text) {
  const nlohmann::json last = nlohmann::json::parse(json_text);
  for (std::size_t n = 0; n < samplers_.size() && n < last.size(); ++n)
    if (last[n].is_number()) samplers_[n].last = last[n].get<double>();
}

}  // namespace sluice
