// Filling ghost cells outside the domain.
#include "ice/boundary/boundary_fill.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "ice/boundary/layer_copy.hpp"

namespace sluice::ice {

BoundaryFill::BoundaryFill(const Scene& scene, std::span<const IceMaterial> materials,
                           const StateSlots& slots, int level, const FlowConditions& conditions,
                           std::span<const models::TransportedScalar> scalars,
                           const models::MixedGas* mixed)
    : slots_(slots), level_(&scene.grid.levels[level]), scalars_(scalars) {
  for (const IceMaterial& material : materials) {
    setting_.fluids.push_back(material.fluid);
    setting_.viscous = setting_.viscous || material.viscous();
    setting_.rubs.push_back(material.viscous());
  }
  if (materials.size() == 1) {
    setting_.viscosity = materials.front().viscosity;
    setting_.sutherland = materials.front().viscosity_models.sutherland;
  }
  setting_.mixed = mixed;
  setting_.directions = slots.directions;
  setting_.gravity = scene.constants.gravity;
  setting_.level = level_;
  setting_.conditions = conditions;
  for (Side side : all_sides) {
    const int d = direction_of(side);
    const std::size_t n = index_of(side);
    if (!level_->active[d] || level_->periodic[d]) continue;
    for (const BoundaryRegion& region : scene.boundary.side(side).regions)
      add_region(side, region, materials);
    has_walls_[n] = std::any_of(rules_[n].begin(), rules_[n].end(),
                                [](const GhostRule& r) { return r.mirrored(); });
    has_waves_[n] =
        std::any_of(rules_[n].begin(), rules_[n].end(), [](const GhostRule& r) { return r.waves; });
    holds_[n] = std::any_of(rules_[n].begin(), rules_[n].end(),
                            [](const GhostRule& r) { return r.holds_velocity(); });
    has_heat_slip_ = has_heat_slip_ || std::any_of(rules_[n].begin(), rules_[n].end(),
                                                   [](const GhostRule& r) { return r.heat.slip; });
    regions_[n] = std::make_unique<RegionMap>(scene.boundary.side(side), side, *level_);
  }
}

void BoundaryFill::add_region(Side side, const BoundaryRegion& region,
                              std::span<const IceMaterial> materials) {
  const std::size_t n = index_of(side);
  // As decks count: solids come before the fluids.
  std::vector<models::TransportedScalar> numbered(scalars_.begin(), scalars_.end());
  for (models::TransportedScalar& s : numbered) s.material = materials[s.material].number();
  scalar_rules_[n].push_back(scalars::make_rules(region, numbered));
  if (materials.size() == 1) {
    rules_[n].push_back(
        make_gas_rule(region, materials.front().number(), direction_of(side), setting_.conditions));
    return number_open_face(side);
  }
  mixtures_[n].push_back(
      make_mixture_rule(region, materials, direction_of(side), setting_.conditions));
  rules_[n].push_back(mixtures_[n].back().common);
  number_open_face(side);
}

int BoundaryFill::wave_directions() const {
  int directions = 0;
  for (std::size_t d = 0; d < 3; ++d) directions += has_waves_[2 * d] || has_waves_[2 * d + 1];
  return directions;
}

Vec3 BoundaryFill::wall_velocity(Side side, IntVec3 cell) const {
  const GhostRule& here = rule(side, cell);
  return here.velocity_kind == GhostRule::Velocity::wall ? here.velocity : Vec3{};
}

bool BoundaryFill::holds_velocities() const {
  return std::any_of(holds_.begin(), holds_.end(), [](bool holds) { return holds; });
}

double BoundaryFill::held_velocity(Side side, IntVec3 cell, double in_ghost, double time) const {
  const GhostRule& here = rule(side, cell);
  if (here.velocity_flow == nullptr) return in_ghost;
  return here.velocity_flow->on_face(direction_of(side), here.velocity, in_ghost, time);
}

const WallHeat& BoundaryFill::wall_heat(Side side, IntVec3 cell, int material) const {
  const std::size_t n = index_of(side);
  const std::size_t r = region(side, cell);
  return mixtures_[n].empty() ? rules_[n][r].heat : mixtures_[n][r].parts[material].rule.heat;
}

bool BoundaryFill::copies(Side side, std::size_t region) const {
  const std::size_t n = index_of(side);
  return setting_.gravity[direction_of(side)] == 0 &&
         (mixtures_[n].empty() ? rules_[n][region].plain() : mixtures_[n][region].plain);
}

BoundaryViews BoundaryFill::views(const Warehouse& state, int box) const {
  BoundaryViews v;
  const int several = static_cast<int>(setting_.fluids.size());
  for (int m = slots_.material; m < slots_.material + several; ++m) {
    const int at = slots_.places.material_of(m);
    v.mass.push_back(state.view(state.find(slots_.mass, at), 0, box));
    v.energy.push_back(state.view(state.find(slots_.energy, at), 0, box));
    if (several > 1) v.volume.push_back(state.view(state.find(slots_.volume, at), 0, box));
    if (!(slots_.slip != Label{})) continue;
    const int slip = state.find(slots_.slip, at);
    for (int c = 0; c < state.info(slip).components; ++c)
      v.slip.push_back(state.view(slip, c, box));
  }
  const int momentum = state.find(slots_.momentum, slots_.places.material_of(slots_.material));
  for (int c = 0; c < state.info(momentum).components; ++c)
    v.momentum.push_back(state.view(momentum, c, box));
  for (const models::TransportedScalar& s : scalars_)
    if (setting_.mixed != nullptr && setting_.mixed->is_fraction(s.name))
      v.composition.push_back(
          state.view(state.find(s.state(), slots_.places.material_of(s.material)), 0, box));
  return v;
}

std::vector<scalars::GhostViews> BoundaryFill::scalar_views(const Warehouse& state, int box) const {
  std::vector<scalars::GhostViews> views;
  for (const models::TransportedScalar& s : scalars_)
    views.push_back(
        {state.view(state.find(s.state(), slots_.places.material_of(s.material)), 0, box),
         state.view(state.find(slots_.mass, slots_.places.material_of(s.material)), 0, box)});
  return views;
}

std::size_t BoundaryFill::region(Side side, IntVec3 cell) const {
  const int d = direction_of(side);
  const IndexBox& domain = level_->domain;
  for (int e = 0; e < 3; ++e) {
    if (e == d) continue;
    const int size = domain.size()[e];
    if (level_->periodic[e])
      cell[e] = domain.lower[e] + ((cell[e] - domain.lower[e]) % size + size) % size;
    else
      cell[e] = std::clamp(cell[e], domain.lower[e], domain.upper[e] - 1);
  }
  const int a = d == 0 ? 1 : 0, b = d == 2 ? 1 : 2;
  const std::size_t n = index_of(side);
  return regions_[n]->region(cell[a], cell[b]);
}

IndexBox BoundaryFill::ghost_region(const Warehouse& state, int box, int ghost_width,
                                    Side side) const {
  const IndexBox cells = state.local_boxes()[box].cells;
  const int d = direction_of(side);
  IndexBox region = cells.grown(level_->ghosts(ghost_width));
  // Later directions have not been filled yet: stay inside the domain there.
  for (int e = d + 1; e < 3; ++e) {
    if (level_->periodic[e]) continue;
    region.lower[e] = std::max(region.lower[e], level_->domain.lower[e]);
    region.upper[e] = std::min(region.upper[e], level_->domain.upper[e]);
  }
  if (is_plus(side))
    region.lower[d] = std::max(region.lower[d], level_->domain.upper[d]);
  else
    region.upper[d] = std::min(region.upper[d], level_->domain.lower[d]);
  return region;
}

void BoundaryFill::fill_scalars(Warehouse& state, int box, const IndexBox& ghosts, Side side,
                                bool everywhere) const {
  if (scalars_.empty()) return;
  const std::size_t n = index_of(side);
  const int d = direction_of(side);
  const std::vector<scalars::GhostViews> views = scalar_views(state, box);
  for_each_cell(ghosts, [&](IntVec3 ghost) {
    const std::size_t r = region(side, ghost);
    const bool mirrored = rules_[n][r].mirrored();
    const IntVec3 source = source_cell(ghost, d, is_plus(side), mirrored, level_->domain);
    const double distance = std::abs(ghost[d] - source[d]) * level_->spacing[d];
    for (std::size_t k = 0; k < views.size(); ++k) {
      const scalars::GhostRule& rule = scalar_rules_[n][r][k];
      if (rule.kind == scalars::GhostRule::Kind::of_fraction) {
        views[k].scalar(ghost) = setting_.mixed->heat(views[k - 1].scalar(ghost));
        continue;
      }
      const bool there = everywhere || views[k].mass(ghost) > 0.0;
      scalars::fill(rule, views[k].scalar, there, ghost, source, mirrored, distance);
    }
  });
}

void BoundaryFill::fill_side(Warehouse& state, int box, const IndexBox& ghosts, Side side,
                             const Moment& moment) const {
  // A gas may depend on its scalar; where there are several, the scalar on what there is of them.
  const bool one = setting_.fluids.size() == 1;
  if (one || setting_.mixed != nullptr) fill_scalars(state, box, ghosts, side, true);
  fill_flow(state, box, ghosts, side, moment);
  if (!one) fill_scalars(state, box, ghosts, side, false);
  if (slots_.offset.valid()) fill_offset(state, box, ghosts, side, moment);
}

// X - p of the work pressure X, which beside a velocity that is given goes on as inside whatever
// pressure density and temperature of the ghost make: else what a solve left of the equation of
// state in the cell would be a gradient of X, and feed itself by C/8 a step.
void BoundaryFill::fill_offset(Warehouse& state, int box, const IndexBox& ghosts, Side side,
                               const Moment& moment) const {
  const RealView offset = offset_view(state, box);
  fill_like_pressure(offset, ghosts, side);
  const std::size_t n = index_of(side);
  const auto made = [](const GhostRule& r) {
    return r.side_kind() == SideKind::velocity && r.fixed_density && r.fixed_temperature;
  };
  if (std::none_of(rules_[n].begin(), rules_[n].end(), made)) return;
  const BoundaryViews v = views(state, box);
  const int d = direction_of(side);
  const GhostStates states(setting_, v, d, is_plus(side), moment);
  for_each_cell(ghosts, [&](IntVec3 ghost) {
    const GhostRule& here = rules_[n][region(side, ghost)];
    if (!made(here)) return;
    const IntVec3 source = source_cell(ghost, d, is_plus(side), here.mirrored(), level_->domain);
    offset(ghost) += states.pressure(source) - states.pressure(ghost);
  });
}

RealView BoundaryFill::offset_view(const Warehouse& state, int box) const {
  return state.view(state.find(slots_.offset, slots_.places.material_of(slots_.material)), 0, box);
}

void BoundaryFill::fill_like_pressure(const RealView& view, const IndexBox& ghosts,
                                      Side side) const {
  const int d = direction_of(side);
  for_each_cell(ghosts, [&](IntVec3 ghost) {
    const GhostRule& here = rules_[index_of(side)][region(side, ghost)];
    const IntVec3 source = source_cell(ghost, d, is_plus(side), here.mirrored(), level_->domain);
    view(ghost) = here.side_kind() == SideKind::pressure ? 0.0 : view(source);
  });
}

void BoundaryFill::fill_increment(Warehouse& state, int slot, const ThreadTeam& team) const {
  const int width = state.info(slot).ghosts;
  team.for_each(state.local_boxes().size(), [&](std::size_t n, int) {
    const int box = static_cast<int>(n);
    for (const Side side : all_sides)
      if (regions_[index_of(side)] != nullptr)
        if (const IndexBox ghosts = ghost_region(state, box, width, side); !ghosts.empty())
          fill_like_pressure(state.view(slot, 0, box), ghosts, side);
  });
}

BoundaryFill::FarPressure BoundaryFill::far_pressure(Side side, IntVec3 cell) const {
  const GhostRule& here = rule(side, cell);
  const LodiSettings& lodi = *setting_.conditions.lodi;
  const int d = direction_of(side);
  return {here.fixed_pressure ? here.pressure : lodi.press_infinity, lodi.sigma,
          level_->domain.size()[d] * level_->spacing[d]};
}

void BoundaryFill::fill_flow(Warehouse& state, int box, const IndexBox& ghosts, Side side,
                             const Moment& moment) const {
  const std::size_t n = index_of(side);
  const int d = direction_of(side);
  const bool plus = is_plus(side);
  const BoundaryViews v = views(state, box);
  const GhostRule& first = rules_[n].front();
  if (regions_[n]->uniform() && copies(side, 0)) {
    KeptArray<int> source;
    IntVec3 ghost = ghosts.lower;
    for (; ghost[d] < ghosts.upper[d]; ++ghost[d])
      source.push_back(source_cell(ghost, d, plus, first.mirrored(), level_->domain)[d]);
    for (const auto* views : {&v.mass, &v.energy, &v.volume})
      for (const RealView& view : *views) copy_layers(view, ghosts, d, source, 1.0);
    for (const auto* vectors : {&v.momentum, &v.slip})
      for (std::size_t c = 0; c < vectors->size(); ++c)
        copy_layers((*vectors)[c], ghosts, d, source,
                    first.mirrored() && slots_.directions[c % v.momentum.size()] == d ? -1.0 : 1.0);
    return;
  }
  GhostStates states(setting_, v, d, plus, moment);
  if (has_waves_[n]) return fill_open_side(states, ghosts, side);
  // From the boundary outward, so that hydrostatic sums find the nearer ghosts filled.
  const int layers = ghosts.size()[d];
  for (int layer = 0; layer < layers; ++layer) {
    IndexBox slice = ghosts;
    slice.lower[d] = plus ? ghosts.lower[d] + layer : ghosts.upper[d] - 1 - layer;
    slice.upper[d] = slice.lower[d] + 1;
    for_each_cell(slice,
                  [&](IntVec3 ghost) { fill_ghost(states, side, region(side, ghost), ghost); });
  }
}

void BoundaryFill::fill_ghost(GhostStates& states, Side side, std::size_t region,
                              IntVec3 ghost) const {
  const std::size_t n = index_of(side);
  const GhostRule& rule = rules_[n][region];
  const IntVec3 source =
      source_cell(ghost, direction_of(side), is_plus(side), rule.mirrored(), level_->domain);
  if (copies(side, region))
    states.plain(rule, ghost, source);
  else if (mixtures_[n].empty())
    states.gas(rule, ghost, source);
  else
    states.mixture(mixtures_[n][region], ghost, source);
}

bool BoundaryFill::commute(std::span<const Side> sides) const {
  return std::all_of(sides.begin(), sides.end(), [&](Side side) {
    const std::size_t regions = rules_[index_of(side)].size();
    for (std::size_t r = 0; r < regions; ++r)
      if (!copies(side, r) || !scalars::all_copied(scalar_rules_[index_of(side)][r])) return false;
    return true;
  });
}

void BoundaryFill::fill_meeting(Warehouse& state, int box, const IndexBox& ghosts,
                                std::span<const Side> sides, const Moment& moment) const {
  const BoundaryViews v = views(state, box);
  std::vector<RealView> all;
  for (const auto* some : {&v.mass, &v.energy, &v.volume, &v.momentum, &v.slip})
    all.insert(all.end(), some->begin(), some->end());
  for (const scalars::GhostViews& s : scalar_views(state, box)) all.push_back(s.scalar);
  if (slots_.offset.valid()) all.push_back(offset_view(state, box));
  std::vector<double> sums(ghosts.volume() * all.size(), 0.0);
  const auto each = [&](auto&& f) {
    std::size_t n = 0;
    for (const RealView& view : all)
      for_each_cell(ghosts, [&](IntVec3 cell) { f(view(cell), sums[n++]); });
  };
  for (const Side side : sides) {
    fill_side(state, box, ghosts, side, moment);
    each([](double value, double& sum) { sum += value; });
  }
  const auto count = static_cast<double>(sides.size());
  each([&](double& value, double sum) { value = sum / count; });
}

void BoundaryFill::even_out_edges(Warehouse& state, int box, int width,
                                  const Moment& moment) const {
  const IndexBox cells = state.local_boxes()[box].cells;
  const IndexBox all = cells.grown(level_->ghosts(width));
  const auto beyond = [&](std::span<const Side> sides) {
    IndexBox region = all;
    for (int d = 0; d < 3; ++d) {
      if (level_->periodic[d]) continue;
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
      if (regions_[index_of(side)] == nullptr) return;
    const IndexBox region = beyond(sides);
    if (!region.empty() && !commute(sides)) fill_meeting(state, box, region, sides, moment);
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
void BoundaryFill::fill_direction(Warehouse& state, int width, int d, const ThreadTeam& team,
                                  const Moment& moment) const {
  if (regions_[index_of(side_of(d, false))] == nullptr) return;
  constexpr std::int64_t fewest_cells = 4096;  // of a piece: worth waking a thread for
  struct Piece {
    int box;
    std::array<IndexBox, 2> ghosts;
  };
  int across = 2;
  while (across >= 0 && (across == d || !level_->active[across])) --across;
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
        fill_side(state, pieces[n].box, ghosts, side_of(d, plus), moment);
  });
}

void BoundaryFill::fill(Warehouse& state, const ThreadTeam& team, double time,
                        std::span<const double> sums) const {
  const Moment moment{time, carriers(sums)};
  const int width =
      state.info(state.find(slots_.mass, slots_.places.material_of(slots_.material))).ghosts;
  for (int d = 0; d < 3; ++d) fill_direction(state, width, d, team, moment);
  team.for_each(state.local_boxes().size(), [&](std::size_t box, int) {
    even_out_edges(state, static_cast<int>(box), width, moment);
  });
}

}  // namespace sluice::ice
