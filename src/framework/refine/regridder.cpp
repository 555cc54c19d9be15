// The Tiled regridder: which tiles there are after a look at the flags.
#include "framework/refine/regridder.hpp"

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/grid/box_list.hpp"
#include "framework/refine/tile_boxes.hpp"

namespace sluice {

namespace {

// Looks without a flag nearby before a tile may go: flags that come and go keep their tiles.
constexpr int looks_idle = 4;

template <class F>
void for_each_tile(const FlagField& tiles, F&& f) {
  const IntVec3 n = tiles.domain().empty() ? IntVec3{} : tiles.domain().size();
  for (int z = 0; z < n.z; ++z)
    for (int y = 0; y < n.y; ++y)
      for (int x = next_flag(tiles.row(y, z), 0, n.x); x < n.x;
           x = next_flag(tiles.row(y, z), x + 1, n.x))
        f(IntVec3{x, y, z});
}

int largest(IntVec3 v) {
  return std::max({v.x, v.y, v.z});
}

}  // namespace

Regridder::Regridder(const RefinementSettings& settings, const std::vector<Level>& levels,
                     int ranks, int threads, double courant)
    : settings_(settings), levels_(levels), courant_(courant), ranks_(ranks), threads_(threads) {
  state_.tiles.resize(levels.size());
  state_.idle.resize(levels.size());
  cells_.resize(levels.size());
  if (!settings.adaptive) return;
  layouts_.resize(levels.size());
  for (std::size_t l = 1; l < levels.size(); ++l)
    layouts_[l] = TileLayout(levels[l], settings.tile[l]);
  find_present();
}

void Regridder::restore(const RegridState& state) {
  bool good = state.tiles.size() == levels_.size() && state.idle.size() == levels_.size();
  for (std::size_t l = 0; good && l < levels_.size(); ++l) {
    const std::vector<IntVec3>& tiles = state.tiles[l].tiles;
    good = state.idle[l].size() == tiles.size() && (tiles.empty() || (l > 0 && adaptive()));
    for (const IntVec3& t : tiles) good = good && layouts_[l].all().contains(t);
  }
  if (!good)
    throw InputError(
        "the checkpoint's tiles do not fit the levels of the deck; restart with the regridder that "
        "the run began with");
  state_ = state;
  if (adaptive()) find_present();
}

void Regridder::find_present() {
  present_.resize(levels_.size());
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    present_[l] = FlagField(layouts_[l].all());
    for (const IntVec3& t : state_.tiles[l].tiles) present_[l].set(t);
  }
  count_cells();
}

void Regridder::count_cells() {
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    cells_[l] = 0;
    for (const IndexBox& block : merged_tiles(present_[l]))
      cells_[l] += layouts_[l].cells(block).volume();
  }
}

bool Regridder::looks_at(int step) const {
  return adaptive() && !settings_.once && step > state_.last_step &&
         step - state_.last_step >= settings_.min_interval;
}

// Levels whose flags count: the finest that may exist has nothing to ask for.
std::size_t Regridder::flagged_levels(const Flags& flags) const {
  return std::min(flags.size(), levels_.size() - 1);
}

IntVec3 Regridder::stability_reach(std::size_t level) const {
  IntVec3 reach = settings_.stability_dilation;
  if (settings_.lock_step) return reach;
  int steps = 1;
  for (std::size_t l = 1; l <= level; ++l)
    steps *= std::max({levels_[l].ratio.x, levels_[l].ratio.y, levels_[l].ratio.z});
  for (int d = 0; d < 3; ++d)
    if (levels_[level].active[d]) reach[d] = std::max(reach[d], static_cast<int>(courant_ * steps));
  return reach;
}

IntVec3 Regridder::regrid_reach(std::size_t level, const Flags& flags) const {
  IntVec3 reach = settings_.regrid_dilation;
  if (settings_.lock_step)
    for (int d = 0; d < 3; ++d) {
      int ratio = 1;
      for (std::size_t l = level + 1; l < flagged_levels(flags); ++l) ratio *= levels_[l].ratio[d];
      reach[d] = (reach[d] + ratio - 1) / ratio;
    }
  return stability_reach(level) + reach;
}

// Cells of the level two coarser that must be refined so that the tiles of `level` keep a margin.
FlagField Regridder::asked_by_margin(std::size_t level, const FlagField& tiles) const {
  const Level& around = levels_[level - 1];
  FlagField cells(levels_[level - 2].domain);
  const IntVec3 n = around.domain.size();
  IntVec3 images{};
  for (int d = 0; d < 3; ++d) images[d] = around.periodic[d] ? 1 : 0;
  for (const IndexBox& block : merged_tiles(tiles)) {
    const IndexBox margin = coarsen(layouts_[level].cells(block), levels_[level].ratio)
                                .grown(settings_.min_boundary_cells);
    for_each_cell({images * -1, images + IntVec3::all(1)}, [&](IntVec3 image) {
      const IndexBox part = intersection(margin.shifted(image * n), around.domain);
      if (!part.empty()) cells.fill(coarsen(part, around.ratio));
    });
  }
  return cells;
}

template <class Change>
Regridder::Fields Regridder::asked(const Flags& flags, IntVec3 further, Change&& change) const {
  Fields tiles(levels_.size());
  FlagField margin;
  for (std::size_t l = levels_.size() - 1; l >= 1; --l) {
    FlagField cells = std::move(margin);
    if (l - 1 < flagged_levels(flags)) {
      FlagField wide =
          flags[l - 1].dilated(regrid_reach(l - 1, flags) + further, levels_[l - 1].periodic);
      if (cells.words().empty())
        cells = std::move(wide);
      else
        cells |= wide;
    }
    tiles[l] = layouts_[l].holding(cells);
    change(l, tiles[l]);
    margin = l >= 2 && tiles[l].any() ? asked_by_margin(l, tiles[l]) : FlagField();
  }
  return tiles;
}

bool Regridder::lacks(const Flags& flags) const {
  for (std::size_t l = 0; l < flagged_levels(flags); ++l)
    if (!layouts_[l + 1]
             .holding(flags[l].dilated(stability_reach(l), levels_[l].periodic))
             .within(present_[l + 1]))
      return true;
  return false;
}

void Regridder::count_idle(const Fields& living) {
  for (std::size_t l = 1; l < levels_.size(); ++l)
    for (std::size_t t = 0; t < state_.idle[l].size(); ++t)
      state_.idle[l][t] = living[l].get(state_.tiles[l].tiles[t]) ? 0 : state_.idle[l][t] + 1;
}

// Tiles that were asked for at one of the last looks.
Regridder::Fields Regridder::lasting() const {
  Fields fields(levels_.size());
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    fields[l] = FlagField(layouts_[l].all());
    for (std::size_t t = 0; t < state_.idle[l].size(); ++t)
      if (state_.idle[l][t] < looks_idle) fields[l].set(state_.tiles[l].tiles[t]);
  }
  return fields;
}

// Whether tiles that may go have cost, since they were last asked for, as much as one coarse step.
// Laying the hierarchy anew costs at most about that, so neither waiting nor hurrying can cost much
// more than the better of the two.
bool Regridder::wasteful() const {
  double idle = 0, step = static_cast<double>(levels_[0].domain.volume()), substeps = 1;
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    if (!settings_.lock_step) substeps *= largest(levels_[l].ratio);
    step += substeps * static_cast<double>(cells_[l]);
    for (std::size_t t = 0; t < state_.idle[l].size(); ++t)
      if (state_.idle[l][t] >= looks_idle)
        idle += state_.idle[l][t] * substeps *
                static_cast<double>(layouts_[l].cells(state_.tiles[l].tiles[t]).volume());
  }
  return idle >= step && idle > 0;
}

bool Regridder::take(Fields tiles) {
  bool changed = false;
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    const std::vector<IntVec3> old = std::move(state_.tiles[l].tiles);
    const std::vector<int> old_idle = std::move(state_.idle[l]);
    state_.tiles[l].tiles.clear();
    state_.idle[l].clear();
    std::size_t at = 0;  // both lists are sorted by (z, y, x)
    const auto before = [](IntVec3 a, IntVec3 b) {
      return a.z != b.z ? a.z < b.z : a.y != b.y ? a.y < b.y : a.x < b.x;
    };
    const std::size_t count = tiles[l].count();
    state_.tiles[l].tiles.reserve(count);
    state_.idle[l].reserve(count);
    for_each_tile(tiles[l], [&](IntVec3 tile) {
      while (at < old.size() && before(old[at], tile)) ++at;
      const bool known = at < old.size() && old[at] == tile;
      state_.tiles[l].tiles.push_back(tile);
      state_.idle[l].push_back(known ? old_idle[at] : 0);
    });
    changed = changed || state_.tiles[l].tiles != old;
  }
  if (!changed) return false;
  present_ = std::move(tiles);
  count_cells();
  return true;
}

bool Regridder::regrid(int step, const Flags& flags) {
  // What the stability dilation asks for is among what wider ones ask for.
  bool covered = false;
  if (std::any_of(present_.begin(), present_.end(), [](const FlagField& f) { return f.any(); })) {
    covered = true;
    count_idle(asked(flags, settings_.deletion_dilation, [&](std::size_t l, FlagField& tiles) {
      covered = covered && tiles.within(present_[l]);
      tiles &= present_[l];
    }));
  }
  const bool due = settings_.max_interval > 0 && step - state_.last_step > settings_.max_interval;
  if (!due && (covered || !lacks(flags)) && !wasteful()) return false;
  const Fields stay = lasting();
  const bool changed =
      take(asked(flags, {}, [&](std::size_t l, FlagField& tiles) { tiles |= stay[l]; }));
  if (changed || due) state_.last_step = step;
  return changed;
}

bool Regridder::regrid_at_start(const Flags& flags) {
  if (!adaptive()) return false;
  return take(asked(flags, {}, [&](std::size_t l, FlagField& tiles) { tiles |= present_[l]; }));
}

std::vector<GridBox> Regridder::boxes(int level) const {
  if (level == 0 || !adaptive()) return levels_[level].boxes;
  return boxes_of_tiles(layouts_[level], present_[level], ranks_, threads_, max_cells_);
}

std::int64_t Regridder::cells(int level) const {
  return level == 0 || !adaptive() ? levels_[level].cell_count() : cells_[level];
}

IndexBox Regridder::tile_cells(int level, IntVec3 tile) const {
  return layouts_[level].cells(tile);
}

}  // namespace sluice
