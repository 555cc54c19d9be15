// Numbering, starting, emitting and moving tracers.
#include "ice/tracers/tracers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/base/error.hpp"
#include "framework/geometry/sampling.hpp"
#include "framework/particle/cell_points.hpp"
#include "ice/tracers/flow_at_points.hpp"

namespace sluice::ice {
namespace {

// coefficient: index of a cell beyond any level, where bounds may be infinite; unit: 1
constexpr double far = 1e9;

IndexBox cells_of(const GeometryPiece& piece, const Level& level, const IndexBox& cells) {
  const Bounds inside = with_margin(piece.bounds());
  IndexBox found = cells;
  for (int d = 0; d < 3; ++d) {
    // Bounds may be infinite: no integers before they are cut.
    const double low = (inside.lower[d] - level.anchor[d]) / level.spacing[d] - 1;
    const double high = (inside.upper[d] - level.anchor[d]) / level.spacing[d] + 2;
    if (low > cells.lower[d]) found.lower[d] = static_cast<int>(std::min(low, far));
    if (high < cells.upper[d]) found.upper[d] = static_cast<int>(std::max(high, -far));
  }
  return intersection(found, cells);
}

// How many particles each cell of a source has got up to a time.
std::int64_t emitted(const models::TracerParticles& t, const models::TracerRegion& source,
                     double time) {
  const double lasted = std::min(time, t.window.stop) - t.window.start;
  return lasted > 0 ? static_cast<std::int64_t>(std::floor(source.number * lasted + 0.5)) : 0;
}

// The flow between two states of a box.
class FlowInTime {
 public:
  FlowInTime(const ParticleStep& step, int material, const FlowStorage& flow)
      : step_(step),
        before_(*step.old_state, step.box, material, flow, *step.old_state),
        after_(*step.new_state, step.box, material, flow, *step.old_state) {}

  bool velocity(Vec3 point, double time, Vec3& u) const {
    const double share = (time - step_.old_time) / (step_.new_time - step_.old_time);
    if (share <= 0) return before_.velocity(point, u);
    if (share >= 1) return after_.velocity(point, u);
    Vec3 later{};
    if (!before_.velocity(point, u) || !after_.velocity(point, later)) return false;
    u += share * (later - u);
    return true;
  }

 private:
  const ParticleStep& step_;
  FlowAtPoints before_, after_;
};

// Heun's method; false: the flow leads further than the cells around the box.
bool move(const FlowInTime& flow, double begin, double end, Vec3& x) {
  Vec3 u1{}, u2{};
  const double dt = end - begin;
  if (!flow.velocity(x, begin, u1) || !flow.velocity(x + dt * u1, end, u2)) return false;
  x += 0.5 * dt * (u1 + u2);
  return true;
}

}  // namespace

Tracers::Tracers(const std::vector<models::TracerParticles>& list,
                 const std::vector<models::TransportedScalar>& scalars, const Grid& grid,
                 const Boundaries& boundaries, FlowStorage flow, double max_time)
    : list_(&list),
      scalars_(&scalars),
      grid_(&grid),
      boundaries_(&boundaries),
      flow_(std::move(flow)) {
  for (const models::TracerParticles& t : list) {
    ParticleKind kind;
    kind.name = t.name;
    kind.material = flow_.places.material_of(t.material);
    kind.refine_distance = t.refine_distance;
    kinds_.push_back(std::move(kind));
    add_attributes(t);
    ids_.push_back(number(t));
    check_ids(t, ids_.back(), max_time);
  }
}

void Tracers::add_attributes(const models::TracerParticles& t) {
  std::vector<ParticleAttribute>& attributes = kinds_.back().attributes;
  Columns& c = columns_.emplace_back();
  const auto add = [&](Label label) {
    attributes.emplace_back(label);
    return static_cast<int>(attributes.size()) - 1;
  };
  if (t.scalar) c.scalar = add(t.scalar->label());
  if (t.scalar && t.scalar->decay.any) {
    c.coefficient = add(t.scalar->coefficient());
    c.total = add(t.scalar->total());
  }
  c.first_clone = static_cast<int>(attributes.size());
  for (const std::string& name : t.clones)
    for (const models::TransportedScalar& s : *scalars_)
      if (s.variable() == name) {
        add(models::clone_label(name));
        c.clones.push_back(&s);
      }
}

void Tracers::check_ids(const models::TracerParticles& t, const Ids& ids, double max_time) {
  double most = static_cast<double>(ids.first_of_sources);
  for (const models::TracerRegion& source : t.sources) {
    const double lasts = std::min(max_time, t.window.stop) - t.window.start;
    most = std::max(
        most, static_cast<double>(ids.first_of_sources) +
                  (source.number * std::max(lasts, 0.0) + 1) * static_cast<double>(ids.stride));
  }
  if (most < static_cast<double>(most_particle_id)) return;
  throw InputError(
      fmt::format("{}: <TracerParticles>: {:g} numbers are needed for all particles of '{}' that "
                  "may appear until t = {:g}, but only 2^53 exist; ask for fewer particles per "
                  "cell or second, or for an earlier <timeStop>",
                  to_string(t.where), most, t.name, max_time));
}

Tracers::Ids Tracers::number(const models::TracerParticles& t) const {
  Ids ids;
  const auto count = [&](const std::vector<models::TracerRegion>& regions, auto&& most) {
    std::vector<std::vector<std::int64_t>> first;
    std::int64_t next = 0;
    for (const models::TracerRegion& region : regions) {
      auto& of_levels = first.emplace_back();
      for (const Level& level : grid_->levels) {
        of_levels.push_back(next);
        next += cell_count_of_domain(level) * most(level, region);
      }
    }
    return std::pair(first, next);
  };
  std::tie(ids.start, ids.first_of_sources) =
      count(t.start, [](const Level& level, const models::TracerRegion& region) {
        return std::int64_t{CellPoints(level, region.number).most()};
      });
  std::tie(ids.source, ids.stride) =
      count(t.sources, [](const Level&, const models::TracerRegion&) { return std::int64_t{1}; });
  return ids;
}

// Scalars begin as their cells do.
void Tracers::add(int kind, const Level& level, Vec3 point, std::int64_t id,
                  ParticleSet& particles) const {
  const models::TracerParticles& t = (*list_)[kind];
  const Columns& c = columns_[kind];
  particles.add(point, id);
  const std::size_t last = particles.size() - 1;
  const auto put = [&](int column, double value) {
    if (column >= 0) particles.attribute(column, last) = value;
  };
  if (t.scalar) {
    put(c.scalar, t.scalar->initial);
    put(c.coefficient, t.scalar->decay.coefficient(point));
  }
  for (std::size_t n = 0; n < c.clones.size(); ++n)
    put(c.first_clone + static_cast<int>(n),
        c.clones[n]->at_start(level.centre(cell_at(level, point))));
}

void Tracers::take_clones(int kind, const ParticleStep& step, ParticleSet& particles) const {
  const Columns& c = columns_[kind];
  const Level& level = step.new_state->level();
  for (std::size_t n = 0; n < c.clones.size(); ++n) {
    const models::TransportedScalar& s = *c.clones[n];
    const int slot = step.new_state->find(s.state(), flow_.places.material_of(s.material));
    const ConstRealView q = step.new_state->view(slot, 0, step.box);
    const std::size_t column = c.first_clone + n;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const IntVec3 cell = cell_at(level, particles.position(p));
      if (q.box.contains(cell)) particles.attribute(column, p) = q(cell);
    }
  }
}

void Tracers::start(int kind, const Level& level, const IndexBox& cells,
                    ParticleSet& particles) const {
  const models::TracerParticles& t = (*list_)[kind];
  for (std::size_t r = 0; r < t.start.size(); ++r) {
    const models::TracerRegion& region = t.start[r];
    const CellPoints points(level, region.number);
    const std::int64_t first = ids_[kind].start[r][level.index];
    for_each_cell(cells_of(*region.piece, level, cells), [&](IntVec3 cell) {
      const int count = points.count(cell);
      for (int n = 0; n < count; ++n) {
        const Vec3 point = points.point(cell, n);
        if (region.piece->inside(point))
          add(kind, level, point, first + cell_number(level, cell) * points.most() + n, particles);
      }
    });
  }
}

void Tracers::emit(int kind, const ParticleStep& step, std::vector<double>& born,
                   ParticleSet& particles) const {
  const models::TracerParticles& t = (*list_)[kind];
  const Ids& ids = ids_[kind];
  const Level& level = step.new_state->level();
  for (std::size_t r = 0; r < t.sources.size(); ++r) {
    const models::TracerRegion& source = t.sources[r];
    const std::int64_t end = emitted(t, source, step.end);
    for (std::int64_t n = emitted(t, source, step.begin); n < end; ++n) {
      const double time = t.window.start + (static_cast<double>(n) + 0.5) / source.number;
      const std::int64_t first = ids.first_of_sources + n * ids.stride + ids.source[r][level.index];
      for (const IndexBox& part : step.cells)
        for_each_cell(cells_of(*source.piece, level, part), [&](IntVec3 cell) {
          const Vec3 point = spread_point(level, cell, n);
          if (!source.piece->inside(point)) return;
          add(kind, level, point, first + cell_number(level, cell), particles);
          born.push_back(std::clamp(time, step.begin, step.end));
        });
    }
  }
}

void Tracers::advance(int kind, const ParticleStep& step, ParticleSet& particles) const {
  const models::TracerParticles& t = (*list_)[kind];
  const std::size_t earlier = particles.size();
  std::vector<double> born;
  emit(kind, step, born, particles);
  if (particles.empty()) return;
  const FlowInTime flow(step, t.material, flow_);
  const Columns& c = columns_[kind];
  const auto column = [&](int n) { return particles.column(n); };
  const models::Decay decay = t.scalar ? t.scalar->decay : models::Decay{};
  for (std::size_t n = 0; n < particles.size(); ++n) {
    const double begin = n < earlier ? step.begin : born[n - earlier], dt = step.end - begin;
    Vec3 x = particles.position(n);
    const double before = decay.any ? decay.rate(decay.coefficient(x)) : 0.0;
    if (!move(flow, begin, step.end, x))
      throw std::logic_error(fmt::format(
          "tracer particle {} at [{:g}, {:g}, {:g}] would cross more cells in a step than a box "
          "has ghost cells around it: the step is longer than the scheme allows",
          particles.id(n), x.x, x.y, x.z));
    particles.move_to(n, x);
    if (!decay.any) continue;
    const double c2 = decay.coefficient(x);
    const double lost = 0.5 * (before + decay.rate(c2)) * dt;
    column(c.scalar)[n] *= std::exp(-lost);
    column(c.coefficient)[n] = c2;
    column(c.total)[n] += lost;
  }
  take_clones(kind, step, particles);
}

bool Tracers::reflects(int /*kind*/, int level, Side side, IntVec3 cell) const {
  return (*boundaries_)[level]->is_wall(side, cell);
}

}  // namespace sluice::ice
