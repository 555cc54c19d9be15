// Gathering flags: rows of diagnostics become rows of bits; regions and seeds join them; all ranks.
#include "framework/run/levels/refinement_flags.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sluice {
namespace {

using Word = std::uint64_t;
constexpr int word_bits = 64;

// Range of a variable below this share of its largest magnitude: round-off, nothing to resolve.
constexpr double min_range = 1e-10;

// Numbers that are compared at a time: the compiler unrolls a loop over lanes and then compares
// number by number.
constexpr int lanes = 8;
using Lanes = double __attribute__((vector_size(lanes * sizeof(double))));
using Words = Word __attribute__((vector_size(lanes * sizeof(Word))));

// Bits of the values above `most`, at most as many as a word has.
Word bits_of(const double* values, int count, double most) {
  Words found{}, bit{1, 2, 4, 8, 16, 32, 64, 128};
  int i = 0;
  for (; i + lanes <= count; i += lanes, bit <<= lanes) {
    Lanes v;
    std::memcpy(&v, values + i, sizeof v);
    found |= reinterpret_cast<Words>(v > most) & bit;
  }
  Word bits = 0;
  for (int k = 0; k < lanes; ++k) bits |= found[k];
  for (; i < count; ++i) bits |= values[i] > most ? Word{1} << i : 0;
  return bits;
}

// Ors a row of values above `most` into the bits of a row of flags, the first of them at bit `at`.
void add_row(const double* values, int count, double most, int at, Word* row) {
  while (count > 0) {
    const int n = std::min(count, word_bits - at % word_bits);
    row[at / word_bits] |= bits_of(values, n, most) << (at % word_bits);
    values += n;
    count -= n;
    at += n;
  }
}

// Calls f(values, count, first cell) for each row of one component of a label in the local boxes.
template <class F>
void for_each_row(const Warehouse& outputs, int slot, int component, F&& f) {
  for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b) {
    const RealView v = outputs.view(slot, component, b);
    const IndexBox& cells = outputs.local_boxes()[b].cells;
    IntVec3 first = cells.lower;
    for (first.z = cells.lower.z; first.z < cells.upper.z; ++first.z)
      for (first.y = cells.lower.y; first.y < cells.upper.y; ++first.y)
        f(v.data + v.offset(first), cells.size().x, first);
  }
}

// Flags cells whose value exceeds `most`.
void add_flagged(const Warehouse& outputs, Label label, int material, double most,
                 FlagField& flags) {
  const IndexBox& domain = flags.domain();
  if (outputs.find(label, material) < 0) return;  // a component without such a field
  for_each_row(outputs, outputs.find(label, material), 0,
               [&](const double* values, int count, IntVec3 first) {
                 const IntVec3 at = first - domain.lower;
                 add_row(values, count, most, at.x, flags.row(at.y, at.z));
               });
}

// Smallest and largest of many values.
class Extremes {
 public:
  void add(const double* values, int count) {
    int i = 0;
    for (; i + lanes <= count; i += lanes) {
      Lanes v;
      std::memcpy(&v, values + i, sizeof v);
      low_ = v < low_ ? v : low_;
      high_ = v > high_ ? v : high_;
    }
    for (; i < count; ++i) {
      low_[0] = std::min(low_[0], values[i]);
      high_[0] = std::max(high_[0], values[i]);
    }
  }
  double least() const {
    double least = low_[0];
    for (int k = 1; k < lanes; ++k) least = std::min(least, low_[k]);
    return least;
  }
  double most() const {
    double most = high_[0];
    for (int k = 1; k < lanes; ++k) most = std::max(most, high_[k]);
    return most;
  }

 private:
  static constexpr double huge = 1e300;
  Lanes low_ = huge - Lanes{}, high_ = Lanes{} - huge;
};

void merge_ranks(FlagField& flags, Communicator& communicator) {
  if (communicator.size() == 1) return;
  std::vector<Word>& words = flags.words();
  const std::string mine(reinterpret_cast<const char*>(words.data()), words.size() * sizeof(Word));
  for (const std::string& text : communicator.gather_to_all(mine))
    for (std::size_t w = 0; w < words.size(); ++w) {
      Word word;
      text.copy(reinterpret_cast<char*>(&word), sizeof word, w * sizeof word);
      words[w] |= word;
    }
}

}  // namespace

RefinementFlags::RefinementFlags(const RefinementSettings& settings, const Component& component,
                                 const std::vector<Level>& levels)
    : component_(&component),
      flag_(component.levels().refine_flag()),
      estimates_(settings.adaptive ? component.levels().error_estimates()
                                   : std::vector<ErrorEstimate>()) {
  for (const Level& level : levels) regions_.emplace_back(settings.regions, level);
  for (const ErrorEstimate& e : estimates_) values_.push_back(e.value);
  all_ = values_;
  all_.push_back(flag_);
  for (const ErrorEstimate& e : estimates_) all_.push_back(e.estimate);
  for (std::vector<Label>* labels : {&values_, &all_}) {
    std::sort(labels->begin(), labels->end());
    labels->erase(std::unique(labels->begin(), labels->end()), labels->end());
  }
}

int RefinementFlags::levels_read(int existing, int flagging) const {
  return estimates_.empty() ? flagging : existing;
}

void RefinementFlags::compute(const std::vector<LevelSolver*>& levels, int flagging,
                              double time) const {
  for (std::size_t l = 0; l < levels.size(); ++l)
    levels[l]->compute_diagnostics(time, static_cast<int>(l) < flagging ? all_ : values_);
}

// The tolerated error of each estimate. The range of a vector is the largest of its components'.
std::vector<double> RefinementFlags::largest_errors(const std::vector<LevelSolver*>& levels,
                                                    Communicator& communicator) const {
  Reduction extremes;
  std::vector<std::vector<Reduction::Maximum>> high, low;
  for (const ErrorEstimate& e : estimates_) {
    high.emplace_back();
    low.emplace_back();
    for (int c = 0; c < component_count(e.value.info().type); ++c) {
      Extremes mine;
      for (const LevelSolver* level : levels)
        for_each_row(level->outputs(), level->outputs().find(e.value, e.material), c,
                     [&](const double* row, int count, IntVec3) { mine.add(row, count); });
      high.back().push_back(extremes.add_maximum(mine.most()));
      low.back().push_back(extremes.add_maximum(-mine.least()));
    }
  }
  communicator.reduce(extremes);
  std::vector<double> errors;
  for (std::size_t n = 0; n < estimates_.size(); ++n) {
    double range = 0, magnitude = 0;
    for (std::size_t c = 0; c < high[n].size(); ++c) {
      const double most = extremes.maximum(high[n][c]), least = -extremes.maximum(low[n][c]);
      range = std::max(range, most - least);
      magnitude = std::max({magnitude, most, -least});
    }
    errors.push_back(estimates_[n].tolerance * std::max(range, min_range * magnitude));
  }
  return errors;
}

void RefinementFlags::add_seeds(const LevelSolver& solver, Communicator& communicator,
                                const ParticleCloud* particles, FlagField& flags) const {
  const Level& level = solver.level();
  std::vector<FlagSeeds> all = component_->levels().flag_seeds(solver.state());
  if (particles != nullptr)
    for (FlagSeeds& seeds : particles->flag_seeds(level.index)) all.push_back(std::move(seeds));
  for (const FlagSeeds& seeds : all) {
    FlagField found(level.domain);
    for (const IntVec3& cell : seeds.cells) found.set(cell);
    merge_ranks(found, communicator);
    IntVec3 reach{};
    for (int d = 0; d < 3; ++d)
      if (level.active[d])
        reach[d] = static_cast<int>(
            std::ceil(std::min(seeds.distance / level.spacing[d], 1.0 * level.domain.size()[d])));
    flags |= found.dilated(reach, level.periodic);
  }
}

std::vector<FlagField> RefinementFlags::of(const std::vector<LevelSolver*>& levels, int flagging,
                                           double time, Communicator& communicator,
                                           const ParticleCloud* particles) {
  compute(levels, flagging, time);
  const std::vector<double> most = largest_errors(levels, communicator);
  std::vector<FlagField> all;
  for (int l = 0; l < flagging; ++l) {
    const LevelSolver& solver = *levels[l];
    FlagField& flags = all.emplace_back(solver.level().domain);
    add_flagged(solver.outputs(), flag_, 0, 0.0, flags);
    for (std::size_t n = 0; n < estimates_.size(); ++n)
      add_flagged(solver.outputs(), estimates_[n].estimate, estimates_[n].material, most[n], flags);
    for (const GridBox& box : solver.state().local_boxes()) regions_[l].add(box.cells, flags);
    merge_ranks(flags, communicator);
    add_seeds(solver, communicator, particles, flags);
  }
  return all;
}

}  // namespace sluice
