// Gathering flags: the component's diagnostic, regions of the deck, all ranks.
#include "framework/run/refinement_flags.hpp"

#include <algorithm>

namespace sluice {
namespace {

using Word = std::uint64_t;
constexpr int word_bits = 64;

// Bits of the values that are not zero; most rows have none, which is found out fast.
Word bits_of(const double* values, int count) {
  int found = 0;
  for (int i = 0; i < count; ++i) found += values[i] != 0.0;
  if (found == 0) return 0;
  Word bits = 0;
  for (int i = 0; i < count; ++i) bits |= Word{values[i] != 0.0} << i;
  return bits;
}

// Ors a row of values into the bits of a row of flags, the first of them at bit `at`.
void add_row(const double* values, int count, int at, Word* row) {
  while (count > 0) {
    const int n = std::min(count, word_bits - at % word_bits);
    row[at / word_bits] |= bits_of(values, n) << (at % word_bits);
    values += n;
    count -= n;
    at += n;
  }
}

// Calls f(y, z) for the rows of a box, counted from the domain's low corner.
template <class F>
void for_each_row(const IndexBox& cells, const IndexBox& domain, F&& f) {
  const IntVec3 low = cells.lower - domain.lower, high = cells.upper - domain.lower;
  for (int z = low.z; z < high.z; ++z)
    for (int y = low.y; y < high.y; ++y) f(y, z);
}

void add_flagged(const Warehouse& outputs, Label label, FlagField& flags) {
  const int slot = outputs.find(label, 0);
  const IndexBox& domain = flags.domain();
  for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b) {
    const RealView v = outputs.view(slot, 0, b);
    const IndexBox& cells = outputs.local_boxes()[static_cast<std::size_t>(b)].cells;
    const int low = cells.lower.x - domain.lower.x, count = cells.size().x;
    for_each_row(cells, domain, [&](int y, int z) {
      const IntVec3 first{cells.lower.x, domain.lower.y + y, domain.lower.z + z};
      add_row(v.data + v.offset(first), count, low, flags.row(y, z));
    });
  }
}

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
    : flag_(component.refine_flag()) {
  for (const Level& level : levels) regions_.emplace_back(settings.regions, level);
}

FlagField RefinementFlags::of_level(LevelSolver& solver, double time, Communicator& communicator) {
  FlagField flags(solver.level().domain);
  solver.compute_diagnostics(time, {flag_});
  add_flagged(solver.outputs(), flag_, flags);
  RegionFlags& regions = regions_[static_cast<std::size_t>(solver.level().index)];
  for (const GridBox& box : solver.state().local_boxes()) regions.add(box.cells, flags);
  merge_ranks(flags, communicator);
  return flags;
}

}  // namespace sluice
