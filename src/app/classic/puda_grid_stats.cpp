// puda -gridstats: levels and patches of each output.
#include <fmt/format.h>

#include "app/classic/puda.hpp"

namespace sluice {
namespace {

// Digits are eight until the first patch is printed, then four, as in the suite's own output.
class GridPrinter {
 public:
  void print(std::size_t output, double time, const ArchiveStep& step) {
    fmt::print("__________________________________\n");
    fmt::print("Timestep {}: {}\n", output, number_text(time, digits_));
    print_counts(step);
    const Level& coarsest = step.grid().levels.front();
    const IndexBox inner = interior_of(step, 0), all = outer_of(step, 0);
    const Vec3 low = corner(coarsest, inner.lower), high = corner(coarsest, inner.upper);
    fmt::print("Domain Length:        {}\n", vector_text(high - low, digits_));
    fmt::print("\nInterior Spatial Range: {}\n", range_text(coarsest, inner));
    fmt::print("Spatial Range:          {}\n\n", range_text(coarsest, all));
    for (const Level& level : step.grid().levels) print_level(step, level);
  }

 private:
  void print_counts(const ArchiveStep& step) const {
    std::size_t patches = 0;
    std::int64_t cells = 0;
    const auto& levels = step.patches();
    fmt::print("Grid statistics:\nNumber of levels:\t\t{}\n", levels.size());
    for (std::size_t l = 0; l < levels.size(); ++l) {
      std::int64_t of_level = 0;
      for (const PatchRecord& p : levels[l]) of_level += p.outer.volume();
      fmt::print("Level {}:\n  Number of patches:\t\t{}\n", l, levels[l].size());
      fmt::print("  Total number of cells:\t{} ({} avg. per patch)\n", of_level,
                 mean_text(of_level, levels[l].size()));
      patches += levels[l].size();
      cells += of_level;
    }
    fmt::print("Total patches in grid:\t\t{}\n", patches);
    fmt::print("Total cells in grid:\t\t{} ({} avg. per patch)\n\n", cells,
               mean_text(cells, patches));
  }

  void print_level(const ArchiveStep& step, const Level& level) {
    const IndexBox inner = interior_of(step, level.index), all = outer_of(step, level.index);
    fmt::print("Level: index {}, id {}\n", level.index, step.level_id(level.index));
    fmt::print("       refinement ratio: {}\n", index_text(level.ratio));
    fmt::print("       Interior Spatial Range: {}\n", range_text(level, inner));
    fmt::print("       Spatial Range:          {}\n\n", range_text(level, all));
    fmt::print("Total Number of Cells:{}\n", index_text(inner.size()));
    fmt::print("dx:                   {}\n", vector_text(level.spacing, digits_));
    for (const PatchRecord& p : step.patches().at(level.index)) print_patch(step, level, p);
  }

  void print_patch(const ArchiveStep& step, const Level& level, const PatchRecord& p) {
    digits_ = 4;
    // The extents are those of the patch's nodes, which close it where no patch follows.
    IntVec3 end = p.outer.upper;
    std::string sides;
    for (int d = 0; d < 3; ++d) {
      const int high = side_kind(step, level, p, d, true);
      end[d] += high == neighbour ? 0 : 1;
      sides += fmt::format("{}{}- {}, {}+ {}", d > 0 ? ", " : "", "xyz"[d],
                           side_kind(step, level, p, d, false), "xyz"[d], high);
    }
    fmt::print("(Patch {}, lowIndex={}, highIndex={})\n", p.id, index_text(p.outer.lower),
               index_text(p.outer.upper));
    fmt::print("\t   Spatial extents (including extra cells): {} {}\n",
               point_text(corner(level, p.outer.lower), digits_),
               point_text(corner(level, end), digits_));
    fmt::print("\t   BC types: {}\n", sides);
  }

  static constexpr int boundary = 0, coarser = 2, neighbour = 3;
  // What lies beyond a side of a patch.
  static int side_kind(const ArchiveStep& step, const Level& level, const PatchRecord& p, int d,
                       bool high) {
    IndexBox beyond = p.interior;
    if (high) {
      beyond.lower[d] = p.interior.upper[d];
      beyond.upper[d] = beyond.lower[d] + 1;
    } else {
      beyond.upper[d] = p.interior.lower[d];
      beyond.lower[d] = beyond.upper[d] - 1;
    }
    const bool outside = intersection(beyond, level.domain).empty();
    if (outside && level.periodic[d]) {
      IntVec3 period;
      period[d] = (high ? -1 : 1) * level.domain.size()[d];
      beyond = beyond.shifted(period);
    }
    for (const PatchRecord& other : step.patches().at(level.index))
      if (!intersection(other.interior, beyond).empty()) return neighbour;
    return level.index > 0 && (!outside || level.periodic[d]) ? coarser : boundary;
  }

  static IndexBox interior_of(const ArchiveStep& step, int level) {
    IndexBox all = step.patches().at(level).front().interior;
    for (const PatchRecord& p : step.patches()[level]) all = bounding(all, p.interior);
    return all;
  }
  static IndexBox outer_of(const ArchiveStep& step, int level) {
    IndexBox all = step.patches().at(level).front().outer;
    for (const PatchRecord& p : step.patches()[level]) all = bounding(all, p.outer);
    return all;
  }
  static Vec3 corner(const Level& level, IntVec3 i) {
    return level.anchor + to_real(i) * level.spacing;
  }
  std::string range_text(const Level& level, const IndexBox& box) const {
    return point_text(corner(level, box.lower), digits_) + ".." +
           point_text(corner(level, box.upper), digits_);
  }
  std::string mean_text(std::int64_t cells, std::size_t patches) const {
    return number_text(static_cast<double>(cells) / static_cast<double>(patches), digits_);
  }

  int digits_ = 8;
};

}  // namespace

void puda_grid_stats(const Archive& archive, const PudaRequest& request) {
  GridPrinter printer;
  const OutputRange& range = request.outputs;
  for (std::size_t t = range.first; t <= range.last; t += range.step) {
    const StepEntry& entry = archive.outputs()[t];
    printer.print(t, entry.time, archive.read_output(entry));
  }
}

}  // namespace sluice
