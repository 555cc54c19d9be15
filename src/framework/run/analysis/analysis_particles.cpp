// Finding the particles that are followed, and what a sample holds of them.
#include "framework/run/analysis/analysis_particles.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/analysis/sampler.hpp"
#include "framework/deck/faults.hpp"
#include "framework/field/component_name.hpp"
#include "framework/particle/domain_ends.hpp"
#include "framework/run/component/refuse_label.hpp"
#include "framework/run/levels/particle_archive.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr const char* folder_name = "particleExtract";
constexpr const char* colour_name = "p.color";
constexpr std::size_t place_numbers = 5;  // of a row, before the values: level, id, x, y, z

// The number of the kind of particles that a module looks at.
int kind_of(const AnalysisModule& m, const ParticleMethod* method) {
  std::vector<std::string> names;
  if (method != nullptr)
    for (std::size_t k = 0; k < method->kinds().size(); ++k) {
      if (method->kinds()[k].material == m.material) return static_cast<int>(k);
      names.push_back(method->kinds()[k].name);
    }
  throw DeckError(
      m.where,
      fmt::format("<Module name=\"{}\">: material {} has no particles", m.name, m.material),
      names.empty() ? "no material of this run has particles"
                    : fmt::format("materials with particles: {}", fmt::join(names, ", ")));
}

std::size_t column_of_colour(const AnalysisModule& m, const ParticleKind& kind) {
  std::size_t column = 0;
  for (const ParticleAttribute& a : kind.attributes) {
    if (a.label.name() == colour_name) return column;
    column += a.columns();
  }
  throw DeckError(m.where,
                  fmt::format("<Module name=\"{}\"> selects the particles with {} above "
                              "colorThreshold, but the particles of '{}' do not have it",
                              m.name, colour_name, kind.name),
                  "write <withColor>true</withColor> in <MPM>");
}

}  // namespace

bool follows_particles(const AnalysisModule& m) {
  return m.name == folder_name;
}

ParticleHistories::ParticleHistories(const AnalysisModule& m, const ParticleMethod* method)
    : module_(&m), method_(method), kind_(kind_of(m, method)) {
  const ParticleKind& kind = method->kinds()[kind_];
  colour_ = column_of_colour(m, kind);
  for (const AnalysedVariable& v : m.variables) add_source(v, kind);
  header_ += '\n';
}

void ParticleHistories::add_source(const AnalysedVariable& v, const ParticleKind& kind) {
  Source source;
  std::vector<std::string> names;
  std::optional<Label> label;
  std::size_t column = 0;
  for (const ParticleAttribute& a : kind.attributes) {
    names.push_back(a.label.name());
    if (a.label.name() == v.label) {
      label = a.label;
      for (int c = 0; c < component_count(a.label.info().type); ++c)
        source.columns.push_back(column + column_of_component(a, c));
    }
    column += a.columns();
  }
  for (const DerivedAttribute& d : kind.derived) {
    names.push_back(d.label.name());
    if (d.label.name() != v.label) continue;
    label = d.label;
    source.derived = &d;
  }
  if (!label) refuse_label(v.where, LabelUse::analyse, v.label, names);
  const int count = component_count(label->info().type);
  for (int c = 0; c < count; ++c)
    header_ += fmt::format(" {}{}{}", v.label, count > 1 ? "." : "", component_name(count, c));
  components_ += count;
  sources_.push_back(std::move(source));
}

void ParticleHistories::pack_box(const ParticleSet& set, const ParticleMap& map, int level,
                                 std::vector<double>& rows) const {
  const double* colour = set.column(colour_);
  std::vector<std::size_t> chosen;
  for (std::size_t p = 0; p < set.size(); ++p)
    if (colour[p] > module_->colour_threshold) chosen.push_back(p);
  if (chosen.empty()) return;
  std::vector<std::vector<std::vector<double>>> derived(sources_.size());  // by source, component
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const DerivedAttribute* d = sources_[s].derived;
    if (d == nullptr) continue;
    derived[s].assign(component_count(d->label.info().type), std::vector<double>(set.size()));
    d->compute(set, derived[s]);
  }
  std::vector<std::vector<double>> present;
  if (const auto& how = method_->kinds()[kind_].present) {
    present.assign(3, std::vector<double>(set.size()));
    how->compute(set, present);
  }
  const Reflects reflects = [&](Side side, IntVec3 cell) {
    return method_->reflects(kind_, level, side, cell);
  };
  for (const std::size_t p : chosen) {
    // It may lag behind in the set of a box that it has left.
    Vec3 place = set.position(p);
    if (!bring_inside(map.levels()[level], reflects, place)) continue;
    const int home = map.find(place).level;
    if (!present.empty()) place = {present[0][p], present[1][p], present[2][p]};
    rows.insert(rows.end(), {static_cast<double>(home),
                             static_cast<double>(set.id(p)), place.x, place.y, place.z});
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      for (const std::size_t c : sources_[s].columns) rows.push_back(set.column(c)[p]);
      for (const std::vector<double>& values : derived[s]) rows.push_back(values[p]);
    }
  }
}

void ParticleHistories::sample(const ParticleCloud& particles, double time,
                               Communicator& communicator) {
  const ParticleStore& store = particles.store(kind_);
  std::vector<Level> levels;
  for (int l = 0; l < store.level_count(); ++l) levels.push_back(particles.level(l));
  const ParticleMap map(std::move(levels));
  std::vector<double> mine;
  for (int l = 0; l < store.level_count(); ++l)
    for (int b = 0; b < store.box_count(l); ++b) pack_box(store.set(l, b), map, l, mine);
  const std::size_t row = place_numbers + components_;
  Reduction reduction;
  const auto count = reduction.add_count(static_cast<std::int64_t>(mine.size() / row));
  communicator.reduce(reduction);
  lines_ = reduction.count(count);
  if (lines_ == 0) return;
  const std::vector<std::string> all = communicator.gather(
      std::string(reinterpret_cast<const char*>(mine.data()), mine.size() * sizeof(double)));
  if (!communicator.is_root()) return;
  RankNumbers numbers(all);
  for (int rank = 0; rank < numbers.ranks(); ++rank)
    for (std::size_t left = all[rank].size() / (row * sizeof(double)); left > 0; --left) {
      const double* first = numbers.take(rank, row);
      file_of(static_cast<int>(first[0]), static_cast<std::int64_t>(first[1]))
          .append(fmt::format("{:.17g} {:.17g}", time, fmt::join(first + 2, first + row, " ")));
    }
}

AnalysisFile& ParticleHistories::file_of(int level, std::int64_t id) {
  const std::pair key{level, id};
  auto file = files_.find(key);
  if (file == files_.end())
    file = files_
               .emplace(key,
                        AnalysisFile(fmt::format("{}/L-{}/{}", folder_name, level, id), header_, 0))
               .first;
  return file->second;
}

void ParticleHistories::flush(const fs::path& folder) {
  for (auto& [key, file] : files_) file.flush(folder);
}

// Whichever particles the earlier run has followed: materials have no id in common.
void ParticleHistories::adopt(const fs::path& earlier, const fs::path& folder, double time) const {
  std::error_code none;
  for (const auto& level : fs::directory_iterator(earlier / folder_name, none))
    for (const auto& file : fs::directory_iterator(level.path(), none))
      if (file.is_regular_file(none))
        AnalysisFile(fs::relative(file.path(), earlier), header_, 0).adopt(earlier, folder, time);
}

}  // namespace sluice
