// Filling ghost cells outside the domain.
#include "ice/boundary_fill.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sluice::ice {

BoundaryFill::BoundaryFill(const Scene& scene, const IceMaterial& material, const StateSlots& slots,
                           int level)
    : gravity_(scene.constants.gravity),
      fluid_(material.fluid),
      viscous_(material.viscosity > 0),
      slots_(slots),
      level_(&scene.grid.levels[static_cast<std::size_t>(level)]) {
  for (Side side : all_sides) {
    const int d = direction_of(side);
    const auto n = static_cast<std::size_t>(side);
    if (!level_->active[static_cast<std::size_t>(d)] ||
        level_->periodic[static_cast<std::size_t>(d)])
      continue;
    for (const BoundaryRegion& region : scene.boundary.side(side).regions)
      rules_[n].push_back(make_rule(region, material.index, d));
    has_walls_[n] = std::any_of(rules_[n].begin(), rules_[n].end(),
                                [](const GhostRule& r) { return r.mirrored(); });
    regions_[n] = std::make_unique<RegionMap>(scene.boundary.side(side), side, *level_);
  }
}

const GhostRule& BoundaryFill::rule(Side side, IntVec3 cell) const {
  const int d = direction_of(side);
  const IndexBox& domain = level_->domain;
  for (int e = 0; e < 3; ++e) {
    if (e == d) continue;
    const int size = domain.size()[e];
    if (level_->periodic[static_cast<std::size_t>(e)])
      cell[e] = domain.lower[e] + ((cell[e] - domain.lower[e]) % size + size) % size;
    else
      cell[e] = std::clamp(cell[e], domain.lower[e], domain.upper[e] - 1);
  }
  const int a = d == 0 ? 1 : 0, b = d == 2 ? 1 : 2;
  const auto n = static_cast<std::size_t>(side);
  return rules_[n][static_cast<std::size_t>(regions_[n]->region(cell[a], cell[b]))];
}

IndexBox BoundaryFill::ghost_region(const Warehouse& state, int box, int ghost_width,
                                    Side side) const {
  const IndexBox cells = state.local_boxes()[static_cast<std::size_t>(box)].cells;
  const int d = direction_of(side);
  IndexBox region = cells.grown(level_->ghosts(ghost_width));
  // Later directions have not been filled yet: stay inside the domain there.
  for (int e = d + 1; e < 3; ++e) {
    if (level_->periodic[static_cast<std::size_t>(e)]) continue;
    region.lower[e] = std::max(region.lower[e], level_->domain.lower[e]);
    region.upper[e] = std::min(region.upper[e], level_->domain.upper[e]);
  }
  if (is_plus(side))
    region.lower[d] = std::max(region.lower[d], level_->domain.upper[d]);
  else
    region.upper[d] = std::min(region.upper[d], level_->domain.lower[d]);
  return region;
}

namespace {

// The interior cell that a ghost cell looks at: its mirror image or the nearest one.
IntVec3 source_cell(IntVec3 ghost, int d, bool plus, bool mirrored, const IndexBox& domain) {
  IntVec3 s = ghost;
  if (plus)
    s[d] = mirrored ? 2 * domain.upper[d] - 1 - ghost[d] : domain.upper[d] - 1;
  else
    s[d] = mirrored ? 2 * domain.lower[d] - 1 - ghost[d] : domain.lower[d];
  // A domain narrower than the ghost layers is mirrored once more.
  s[d] = std::clamp(s[d], domain.lower[d], domain.upper[d] - 1);
  return s;
}

// State arrays of one box.
struct StateViews {
  RealView mass, energy;
  std::vector<RealView> momentum;
};

// A few ghosts at the end of each row, all layers together: they share a cache line. Nearly every
// row is another line and every few rows another page, so they are fetched ahead of their use.
void copy_row_ends(double* row, std::ptrdiff_t stride, int rows, const std::vector<int>& source,
                   int low, double sign) {
  constexpr std::ptrdiff_t ahead = 32;  // rows, measured best
  const auto [first, last] = std::minmax_element(source.begin(), source.end());
  const std::ptrdiff_t layers = static_cast<std::ptrdiff_t>(source.size());
  const std::ptrdiff_t begin = std::min<std::ptrdiff_t>(0, *first - low);
  const std::ptrdiff_t end = std::max<std::ptrdiff_t>(layers - 1, *last - low);
  for (int n = 0; n < rows; ++n, row += stride) {
    // As numbers: past the last row there is no such pointer.
    const auto here = reinterpret_cast<std::uintptr_t>(row);
    const auto to = [&](std::ptrdiff_t x) {
      return reinterpret_cast<const void*>(
          here +
          static_cast<std::uintptr_t>((ahead * stride + x) * std::ptrdiff_t{sizeof(double)}));
    };
    __builtin_prefetch(to(begin), 1);
    __builtin_prefetch(to(end), 1);
    for (std::ptrdiff_t layer = 0; layer < layers; ++layer)
      row[layer] = sign * row[source[static_cast<std::size_t>(layer)] - low];
  }
}

// data = sign * data of the layer source[n] of direction d, for the n-th ghost layer.
void copy_layers(const RealView& v, const IndexBox& ghosts, int d, const std::vector<int>& source,
                 double sign) {
  int a = d == 0 ? 1 : 0, b = d == 2 ? 1 : 2;  // inner and outer of the other directions
  if (v.stride[b] == 1) std::swap(a, b);
  const IntVec3 n = ghosts.size();
  for (int outer = 0; outer < n[b]; ++outer) {
    double* row = v.data + v.offset(ghosts.lower) + outer * v.stride[b];
    if (v.stride[d] == 1) {
      copy_row_ends(row, v.stride[a], n[a], source, ghosts.lower[d], sign);
      continue;
    }
    for (int layer = 0; layer < n[d]; ++layer) {
      double* to = row + layer * v.stride[d];
      const double* from =
          row + (source[static_cast<std::size_t>(layer)] - ghosts.lower[d]) * v.stride[d];
      // Along unit stride, or a single cell of a direction that is not active.
      for (int inner = 0; inner < n[a]; ++inner) to[inner] = sign * from[inner];
    }
  }
}

}  // namespace

struct BoundaryFill::SideRules {
  const BoundaryFill& fill;
  const GhostRule& rule;
  int d;
  bool plus;

  // Hydrostatic difference of pressure from the source cell out to the ghost cell: the sum of
  // g dx (rho + rho)/2 over the steps between them. Ghost densities closer in are filled already.
  double hydrostatic(const StateViews& v, IntVec3 source, IntVec3 ghost, double rho_ghost) const {
    const double g = fill.gravity_[d];
    if (g == 0) return 0;
    const int outward = plus ? 1 : -1;
    double change = 0;
    IntVec3 c = source;
    while (c[d] != ghost[d]) {
      IntVec3 next = c;
      next[d] += outward;
      const double rho_next = next[d] == ghost[d] ? rho_ghost : v.mass(next);
      change += outward * 0.5 * g * fill.level_->spacing[d] * (v.mass(c) + rho_next);
      c = next;
    }
    return change;
  }

  void plain(const StateViews& v, IntVec3 ghost, IntVec3 source) const {
    v.mass(ghost) = v.mass(source);
    v.energy(ghost) = v.energy(source);
    const bool mirrored = rule.velocity_kind == GhostRule::Velocity::mirror;
    for (std::size_t c = 0; c < v.momentum.size(); ++c)
      v.momentum[c](ghost) = mirrored && fill.slots_.directions[c] == d ? -v.momentum[c](source)
                                                                        : v.momentum[c](source);
  }

  double velocity(const StateViews& v, IntVec3 source, std::size_t c, double distance) const {
    const int direction = fill.slots_.directions[c];
    const double u = v.momentum[c](source) / v.mass(source);
    switch (rule.velocity_kind) {
      case GhostRule::Velocity::copy:
        return u - rule.velocity_gradient[direction] * distance;
      case GhostRule::Velocity::mirror:
        return direction == d ? -u : u;
      case GhostRule::Velocity::wall:
        if (direction == d) return -u;
        return fill.viscous_ ? 2.0 * rule.velocity[direction] - u : u;
      case GhostRule::Velocity::prescribed:
        return rule.velocity[direction];
    }
    return u;
  }

  void general(const StateViews& v, IntVec3 ghost, IntVec3 source) const {
    const Fluid& fluid = fill.fluid_;
    const double distance = std::abs(ghost[d] - source[d]) * fill.level_->spacing[d];
    const double source_rho = v.mass(source), source_E = v.energy(source);
    double rho = rule.fixed_density ? rule.density : source_rho - rule.density_gradient * distance;
    const double p_source = fluid.pressure(source_rho, source_E);
    const bool given_T = rule.fixed_temperature || rule.temperature_gradient != 0;
    const double T = rule.fixed_temperature ? rule.temperature
                                            : fluid.temperature(source_rho, source_E) -
                                                  rule.temperature_gradient * distance;
    double p;
    if (rule.fixed_pressure) {
      p = rule.pressure;
    } else if (rule.fixed_density && given_T) {
      p = fluid.pressure(rho, fluid.energy_from_temperature(rho, T));
    } else {
      p = p_source - rule.pressure_gradient * distance;
      if (given_T && !rule.fixed_density) rho = fluid.density(p, T);
      p += hydrostatic(v, source, ghost, rho);
    }
    if (given_T && !rule.fixed_density) rho = fluid.density(p, T);
    v.mass(ghost) = rho;
    v.energy(ghost) = fluid.energy_from_pressure(rho, p, T);
    for (std::size_t c = 0; c < v.momentum.size(); ++c)
      v.momentum[c](ghost) = rho * velocity(v, source, c, distance);
  }
};

void BoundaryFill::fill_side(Warehouse& state, int box, const IndexBox& ghosts, Side side) const {
  const auto n = static_cast<std::size_t>(side);
  const int d = direction_of(side);
  const bool plus = is_plus(side);
  const int slot_m = state.find(slots_.momentum, slots_.material);
  StateViews v;
  v.mass = state.view(state.find(slots_.mass, slots_.material), 0, box);
  v.energy = state.view(state.find(slots_.energy, slots_.material), 0, box);
  for (int c = 0; c < state.info(slot_m).components; ++c)
    v.momentum.push_back(state.view(slot_m, c, box));
  auto one = [&](IntVec3 ghost) {
    const SideRules rules{*this, rule(side, ghost), d, plus};
    const IntVec3 source = source_cell(ghost, d, plus, rules.rule.mirrored(), level_->domain);
    if (rules.rule.plain() && gravity_[d] == 0)
      rules.plain(v, ghost, source);
    else
      rules.general(v, ghost, source);
  };
  const GhostRule& first = rules_[n].front();
  if (regions_[n]->uniform() && first.plain() && gravity_[d] == 0) {
    std::vector<int> source;
    IntVec3 ghost = ghosts.lower;
    for (; ghost[d] < ghosts.upper[d]; ++ghost[d])
      source.push_back(source_cell(ghost, d, plus, first.mirrored(), level_->domain)[d]);
    copy_layers(v.mass, ghosts, d, source, 1.0);
    copy_layers(v.energy, ghosts, d, source, 1.0);
    for (std::size_t c = 0; c < v.momentum.size(); ++c)
      copy_layers(v.momentum[c], ghosts, d, source,
                  first.mirrored() && slots_.directions[c] == d ? -1.0 : 1.0);
    return;
  }
  // From the boundary outward, so that hydrostatic sums find the nearer ghosts filled.
  const int layers = ghosts.size()[d];
  for (int layer = 0; layer < layers; ++layer) {
    IndexBox slice = ghosts;
    slice.lower[d] = plus ? ghosts.lower[d] + layer : ghosts.upper[d] - 1 - layer;
    slice.upper[d] = slice.lower[d] + 1;
    for_each_cell(slice, one);
  }
}

bool BoundaryFill::commute(std::span<const Side> sides) const {
  return std::all_of(sides.begin(), sides.end(), [&](Side side) {
    const auto& rules = rules_[static_cast<std::size_t>(side)];
    return gravity_[direction_of(side)] == 0 &&
           std::all_of(rules.begin(), rules.end(), [](const GhostRule& r) { return r.plain(); });
  });
}

void BoundaryFill::fill_meeting(Warehouse& state, int box, const IndexBox& ghosts,
                                std::span<const Side> sides) const {
  std::vector<RealView> views;
  for (const Label label : {slots_.mass, slots_.energy, slots_.momentum}) {
    const int slot = state.find(label, slots_.material);
    for (int c = 0; c < state.info(slot).components; ++c) views.push_back(state.view(slot, c, box));
  }
  std::vector<double> sums(static_cast<std::size_t>(ghosts.volume()) * views.size(), 0.0);
  const auto each = [&](auto&& f) {
    std::size_t n = 0;
    for (const RealView& v : views)
      for_each_cell(ghosts, [&](IntVec3 cell) { f(v(cell), sums[n++]); });
  };
  for (const Side side : sides) {
    fill_side(state, box, ghosts, side);
    each([](double value, double& sum) { sum += value; });
  }
  const auto count = static_cast<double>(sides.size());
  each([&](double& value, double sum) { value = sum / count; });
}

void BoundaryFill::even_out_edges(Warehouse& state, int box, int width) const {
  const IndexBox cells = state.local_boxes()[static_cast<std::size_t>(box)].cells;
  const IndexBox all = cells.grown(level_->ghosts(width));
  const auto beyond = [&](std::span<const Side> sides) {
    IndexBox region = all;
    for (int d = 0; d < 3; ++d) {
      if (level_->periodic[static_cast<std::size_t>(d)]) continue;
      region.lower[d] = std::max(region.lower[d], level_->domain.lower[d]);
      region.upper[d] = std::min(region.upper[d], level_->domain.upper[d]);
    }
    for (const Side side : sides) {
      const int d = direction_of(side);
      region.lower[d] = is_plus(side) ? level_->domain.upper[d] : all.lower[d];
      region.upper[d] = is_plus(side) ? all.upper[d] : level_->domain.lower[d];
    }
    return region;
  };
  const auto even_out = [&](std::initializer_list<Side> list) {
    const std::span<const Side> sides(list.begin(), list.size());
    for (const Side side : sides)
      if (regions_[static_cast<std::size_t>(side)] == nullptr) return;
    const IndexBox region = beyond(sides);
    if (!region.empty() && !commute(sides)) fill_meeting(state, box, region, sides);
  };
  for (const bool p : {false, true})
    for (const bool q : {false, true}) {
      even_out({side_of(0, p), side_of(1, q)});
      even_out({side_of(0, p), side_of(2, q)});
      even_out({side_of(1, p), side_of(2, q)});
    }
  for (const bool p : {false, true})
    for (const bool q : {false, true})
      for (const bool r : {false, true}) even_out({side_of(0, p), side_of(1, q), side_of(2, r)});
}

// Ghosts depend on cells along `d` only, and those of later directions on those of earlier ones:
// within one direction pieces cut across another may be filled in any order. Both sides of a piece
// together: where rows run along `d`, the end of one and the start of the next share a cache line.
void BoundaryFill::fill_direction(Warehouse& state, int width, int d,
                                  const ThreadTeam& team) const {
  if (regions_[static_cast<std::size_t>(side_of(d, false))] == nullptr) return;
  constexpr std::int64_t fewest_cells = 4096;  // of a piece: worth waking a thread for
  struct Piece {
    int box;
    std::array<IndexBox, 2> ghosts;
  };
  int across = 2;
  while (across >= 0 && (across == d || !level_->active[static_cast<std::size_t>(across)]))
    --across;
  std::vector<Piece> pieces;
  for (int box = 0; box < static_cast<int>(state.local_boxes().size()); ++box) {
    Piece whole{box, {}};
    std::int64_t cells = 0;
    int layers = 1;
    for (const bool plus : {false, true}) {
      IndexBox& region = whole.ghosts[plus];
      region = ghost_region(state, box, width, side_of(d, plus));
      if (region.empty()) continue;
      cells += region.volume();
      if (across >= 0) layers = region.size()[across];
    }
    if (cells == 0) continue;
    const int count = static_cast<int>(std::clamp<std::int64_t>(cells / fewest_cells, 1, layers));
    for (int n = 0; n < count; ++n) {
      Piece piece = whole;
      if (count > 1)
        for (IndexBox& region : piece.ghosts) {
          const int low = region.lower[across];
          region.lower[across] = low + layers * n / count;
          region.upper[across] = low + layers * (n + 1) / count;
        }
      pieces.push_back(piece);
    }
  }
  team.for_each(pieces.size(), [&](std::size_t n, int) {
    for (const bool plus : {false, true})
      if (const IndexBox& ghosts = pieces[n].ghosts[plus]; !ghosts.empty())
        fill_side(state, pieces[n].box, ghosts, side_of(d, plus));
  });
}

void BoundaryFill::fill(Warehouse& state, const ThreadTeam& team) const {
  const int width = state.info(state.find(slots_.mass, slots_.material)).ghosts;
  for (int d = 0; d < 3; ++d) fill_direction(state, width, d, team);
  team.for_each(state.local_boxes().size(),
                [&](std::size_t box, int) { even_out_edges(state, static_cast<int>(box), width); });
}

void BoundaryFill::copy_outward(Warehouse& state, Label label, int material) const {
  const int slot = state.find(label, material);
  const int width = state.info(slot).ghosts;
  for (int box = 0; box < static_cast<int>(state.local_boxes().size()); ++box)
    for (Side side : all_sides) {
      if (regions_[static_cast<std::size_t>(side)] == nullptr) continue;
      const RealView v = state.view(slot, 0, box);
      for_each_cell(ghost_region(state, box, width, side), [&](IntVec3 ghost) {
        v(ghost) = v(source_cell(ghost, direction_of(side), is_plus(side), false, level_->domain));
      });
    }
}

}  // namespace sluice::ice
