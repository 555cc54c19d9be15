#include "mpm/step/cohesive_zones.hpp"

#include <algorithm>
#include <cmath>

#include "framework/particle/particle_map.hpp"
#include "mpm/nodes/node_sums.hpp"
#include "mpm/shape/weights.hpp"

namespace sluice::mpm {
namespace {

// Columns of a set of points.
enum Column : std::size_t {
  normal = 0,
  tangent = 3,
  area = 6,
  below = 7,
  above = 8,
  number = 9,
  way_above = 10,
  way_below = 13,
  separation = 16,
  force = 19,  // on the material below, N
  failed = 22,
  work = 23
};

std::vector<ParticleAttribute> attributes() {
  using enum ValueType;
  const auto label = [](const char* name, ValueType type, const char* unit, const char* text) {
    return declare_label({name, type, Centring::particle, unit, text});
  };
  return {
      {label("cz.norm", vector, "1", "Normal of a cohesive point, from below to above.")},
      {label("cz.tang", vector, "1", "Tangent of a cohesive point.")},
      {label("cz.area", real, "m^2", "Area for which a cohesive point stands.")},
      {label("cz.BotMat", integer, "1", "Number of the material below a cohesive point.")},
      {label("cz.TopMat", integer, "1", "Number of the material above a cohesive point.")},
      {label("cz.CZID", long_integer, "1", "Number of a cohesive point: its row in the file.")},
      {label("cz.disptop", vector, "m", "Way of the material above a cohesive point."), true},
      {label("cz.dispbottom", vector, "m", "Way of the material below a cohesive point."), true},
      {label("cz.separation", vector, "m", "Way of the material above against that below."), true},
      {label("cz.force", vector, "N", "Force of a cohesive point on the material below."), true},
      {label("cz.failed", integer, "1",
             "Steps in which a failed cohesive point has opened, at most 1000; 0: it is sound."),
       true},
      {label("cz.energy", real, "J", "Work that opening a cohesive point has taken."), true}};
}

Vec3 vector_of(const ParticleSet& set, Column first, std::size_t p) {
  return {set.column(first)[p], set.column(first + 1)[p], set.column(first + 2)[p]};
}
void put(ParticleSet& set, Column first, std::size_t p, Vec3 v) {
  for (int d = 0; d < 3; ++d) set.column(first + static_cast<std::size_t>(d))[p] = v[d];
}
int material_of(const ParticleSet& set, Column which, std::size_t p) {
  return static_cast<int>(set.column(which)[p]);
}

// Lane of the stiffness; forces stand behind it, where those of nodes do.
constexpr int stiffness_lane = 0, force_lane = 4;

}  // namespace

ParticleKind cohesive_kind(const MpmScene& solids, std::size_t zone) {
  ParticleKind kind;
  kind.name = "cohesive zone " + std::to_string(zone + 1);
  kind.material = static_cast<int>(solids.materials.size() + zone);
  kind.attributes = attributes();
  return kind;
}

void start_cohesive(const MpmScene& solids, std::size_t zone, const Level& level,
                    const IndexBox& cells, ParticleSet& set) {
  const std::vector<CohesivePoint>& points = solids.cohesive_zones[zone].points;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const CohesivePoint& point = points[n];
    if (!cells.contains(cell_at(level, point.place))) continue;
    set.add(point.place, static_cast<std::int64_t>(n));
    const std::size_t p = set.size() - 1;
    const CohesiveFrame frame = cohesive_frame(point.normal, point.tangent);
    put(set, normal, p, frame.normal);
    put(set, tangent, p, frame.first);
    set.attribute(area, p) = point.area;
    set.attribute(below, p) = point.below;
    set.attribute(above, p) = point.above;
    set.attribute(number, p) = static_cast<double>(n);
  }
}

void add_cohesive_energy(const ParticleStore& points, Totals& to) {
  for (int l = 0; l < points.level_count(); ++l)
    for (int b = 0; b < points.box_count(l); ++b) {
      const ParticleSet& set = points.set(l, b);
      for (std::size_t p = 0; p < set.size(); ++p) to.internal_energy.add(set.column(work)[p]);
    }
}

CohesiveZones::CohesiveZones(const MpmScene& solids, const std::vector<ParticleKind>& kinds,
                             const LevelNodes& nodes, std::vector<Body>& bodies)
    : solids_(&solids),
      kinds_(&kinds),
      nodes_(&nodes),
      bodies_(&bodies),
      most_(solids.materials.size()),
      lanes_(solids.materials.size()) {
  for (int d = 0; d < 3; ++d) axes_[static_cast<std::size_t>(d)] = axis_of(nodes.level, d);
  double stiffest = 0;  // of all points of all ranks: what stands in the deck
  for (const CohesiveZone& zone : solids.cohesive_zones)
    for (const CohesivePoint& point : zone.points)
      stiffest = std::max(stiffest, point.area * cohesive_stiffness(zone));
  stiffness_scale_ = scale_for(stiffest);
}

void CohesiveZones::begin(const StageScope& scope) {
  work_.clear();
  most_.assign(solids_->materials.size(), 0.0);
  for (std::size_t z = 0; z < solids_->cohesive_zones.size(); ++z) {
    const std::size_t kind = solids_->materials.size() + z;
    ParticleStore& store = scope.particles->store(static_cast<int>(kind));
    const std::vector<std::size_t> advanced = (*kinds_)[kind].advanced_columns();
    for (int b = 0; b < store.box_count(nodes_->level.index); ++b) {
      const ParticleSet& set = store.set(nodes_->level.index, b);
      ParticleSet& next = store.next(nodes_->level.index, b);
      next.make_room(set, advanced);
      add_points(z, set, next);
    }
  }
}

void CohesiveZones::add_points(std::size_t zone, const ParticleSet& set, ParticleSet& next) {
  work_.push_back({&solids_->cohesive_zones[zone], &set, &next});
  for (std::size_t p = 0; p < set.size(); ++p)
    for (const Column side : {below, above}) {
      double& most = most_[static_cast<std::size_t>(material_of(set, side, p))];
      const Vec3 f = vector_of(set, force, p);
      for (int d = 0; d < 3; ++d) most = std::max(most, std::fabs(f[d]));
    }
}

template <class Act>
void CohesiveZones::around(Vec3 place, int material, Act&& act) const {
  AxisWeights<2> weights[3];
  IntVec3 first = nodes_->level.domain.lower, size{1, 1, 1};
  for (int d = 0; d < 3; ++d) {
    if (!nodes_->level.active[static_cast<std::size_t>(d)]) continue;
    const double x = place[d];
    Linear::weights<false>(axes_[static_cast<std::size_t>(d)], &x, 0, 1, weights[d]);
    first[d] = weights[d].first[0];
    size[d] = 2;
  }
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const IntVec3 at = first + IntVec3{i, j, k};
        double S = 1;
        for (int d = 0; d < 3; ++d)
          if (size[d] == 2) S *= weights[d].w[at[d] - first[d]][0];
        act(nodes_->boundary->image(at, material).of, S);
      }
}

void CohesiveZones::add_nodes() {
  for (const Work& w : work_)
    for (std::size_t p = 0; p < w.set->size(); ++p)
      for (const Column side : {below, above}) {
        const int m = material_of(*w.set, side, p);
        BlockTable& table = (*bodies_)[static_cast<std::size_t>(m)].table;
        around(w.set->position(p), m,
               [&](IntVec3 node, double) { table.find_or_add(nodes_->shape.block_of(node)); });
      }
}

// mass(lanes of a node) in any unit: nodes, S M, and the sum of these.
template <class Mass>
CohesiveZones::Shares CohesiveZones::shares_of(Vec3 place, int material, Mass&& mass) const {
  const Body& body = (*bodies_)[static_cast<std::size_t>(material)];
  Shares s;
  around(place, material, [&](IntVec3 node, double S) {
    const int block = body.table.find(nodes_->shape.block_of(node));
    if (block < 0) return;
    const int lane = nodes_->shape.place(node) * lanes;
    const double share = S * mass(body.nodes.sums(block) + lane);
    if (!(share > 0)) return;
    const auto n = static_cast<std::size_t>(s.count++);
    s.block[n] = block;
    s.lane[n] = lane;
    s.share[n] = share;
    s.sum += share;
  });
  return s;
}

void CohesiveZones::push(const Work& w, std::size_t p, const Shares& s, double sign, int material) {
  const auto m = static_cast<std::size_t>(material);
  const Body& body = (*bodies_)[m];
  const Vec3 f = (sign * body.units.force) * vector_of(*w.set, force, p);
  const double k = stiffness_scale_ * w.set->column(area)[p] * cohesive_stiffness(*w.zone);
  for (std::size_t n = 0; n < static_cast<std::size_t>(s.count); ++n) {
    const double share = s.share[n] / s.sum;
    std::int64_t* node = lanes_[m].sums(s.block[n]) + s.lane[n];
    add_rounded(node, Four{share * k, 0.0, 0.0, 0.0});
    add_rounded(node + force_lane, Four{share * f.x, share * f.y, share * f.z, 0.0});
  }
}

// Cohesive forces follow the masses of nodes, so that these are shared before.
void CohesiveZones::on_sums() {
  give_all();
  for (std::size_t m = 0; m < lanes_.size(); ++m) {
    NodeLanes* const group = &lanes_[m];
    nodes_->exchange->share((*bodies_)[m].table, std::span(&group, 1));
  }
  take();
}

void CohesiveZones::give_all() {
  for (std::size_t m = 0; m < lanes_.size(); ++m) {
    lanes_[m].clear();
    lanes_[m].fit((*bodies_)[m].table);
  }
  const auto mass = [](const std::int64_t* node) {
    return node[count_lane] != 0 ? sum_in(node, 0) : 0.0;
  };
  for (const Work& w : work_)
    for (std::size_t p = 0; p < w.set->size(); ++p) {
      const int b = material_of(*w.set, below, p), a = material_of(*w.set, above, p);
      const Vec3 place = w.set->position(p);
      const Shares sb = shares_of(place, b, mass), sa = shares_of(place, a, mass);
      if (sb.count == 0 || sa.count == 0) continue;
      push(w, p, sb, 1, b);
      push(w, p, sa, -1, a);
    }
}

// Also what the points ask of the time step, dt <= 2/omega. By Gershgorin's circles in the sum over
// two materials, omega^2 <= 2 max_i k_i/M_i, with k_i = sum over points of K A w_i.
void CohesiveZones::take() {
  double largest = 0;  // k/M
  for (std::size_t m = 0; m < lanes_.size(); ++m) {
    Body& body = (*bodies_)[m];
    for (int b = 0; b < body.table.count(); ++b)
      for (int n = 0; n < block_nodes; ++n) {
        const std::int64_t* from = lanes_[m].sums(b) + n * lanes;
        if (from[count_lane] == 0) continue;
        std::int64_t* node = body.nodes.sums(b) + n * lanes;
        for (int d = 0; d < 3; ++d)
          node[force_lane + d] = wrapped_sum(
              node[force_lane + d], wrapped_difference(from[force_lane + d], from[count_lane]));
        const double mass = sum_in(node, 0) / body.units.mass;
        largest = std::max(largest, sum_in(from, stiffness_lane) / stiffness_scale_ / mass);
      }
  }
  rate_ = 0.5 * std::sqrt(2 * largest);
}

// v* of a material around a place; false: the material is not there.
bool CohesiveZones::read(Vec3 place, int material, Vec3& velocity) const {
  const Body& body = (*bodies_)[static_cast<std::size_t>(material)];
  const Shares s = shares_of(place, material, [](const std::int64_t* node) {
    return node[count_lane] != 0 ? as_real(node[3]) : 0.0;
  });
  velocity = body.units.reference;
  for (std::size_t n = 0; n < static_cast<std::size_t>(s.count); ++n) {
    const std::int64_t* node = body.nodes.sums(s.block[n]) + s.lane[n];
    for (int d = 0; d < 3; ++d) velocity[d] += s.share[n] / s.sum * as_real(node[d]);
  }
  return s.count > 0;
}

void CohesiveZones::advance_point(const Work& w, std::size_t p, Vec3 way_b, Vec3 way_a, bool held) {
  const ParticleSet& set = *w.set;
  ParticleSet& next = *w.next;
  const Vec3 middle = 0.5 * (way_a + way_b);
  for (int d = 0; d < 3; ++d) {
    const double x = set.coordinate(d)[p];
    next.coordinate(d)[p] = x + middle[d];
    travel_ = std::max(travel_, std::fabs(middle[d]) / nodes_->level.spacing[d]);
    const double low =
        nodes_->level.anchor[d] + nodes_->level.domain.lower[d] * nodes_->level.spacing[d];
    const double high =
        nodes_->level.anchor[d] + nodes_->level.domain.upper[d] * nodes_->level.spacing[d];
    left_ |= !(x + middle[d] >= low && x + middle[d] < high);
  }
  put(next, way_above, p, vector_of(set, way_above, p) + way_a);
  put(next, way_below, p, vector_of(set, way_below, p) + way_b);
  const Vec3 before = vector_of(set, separation, p), after = before + (way_a - way_b);
  put(next, separation, p, after);
  const CohesiveFrame frame = cohesive_frame(vector_of(set, normal, p), vector_of(set, tangent, p));
  double steps = set.column(failed)[p];
  if (steps > 0)
    steps = std::min(failure_steps, steps + (dot(after, after) >= dot(before, before) ? 1 : 0));
  else if (cohesive_failure(*w.zone, frame, after))
    steps = 1;
  next.column(failed)[p] = steps;
  const double holds = held ? set.column(area)[p] * (1 - steps / failure_steps) : 0;
  const Vec3 f = holds * cohesive_traction(*w.zone, frame, after);
  put(next, force, p, f);
  next.column(work)[p] =
      set.column(work)[p] + 0.5 * dot(vector_of(set, force, p) + f, after - before);
}

void CohesiveZones::after_nodes(const NodeStep& step, NodeBooks& /*books*/) {
  travel_ = 0;
  left_ = false;
  for (const Work& w : work_)
    for (std::size_t p = 0; p < w.set->size(); ++p) {
      Vec3 v[2]{};
      bool held = true;
      for (const Column side : {below, above}) {
        const int m = material_of(*w.set, side, p);
        held &= read(w.set->position(p), m, v[side - below]);
      }
      if (!held) v[0] = v[1] = Vec3{};
      for (int d = 0; d < 3; ++d)
        if (!nodes_->level.active[static_cast<std::size_t>(d)]) v[0][d] = v[1][d] = 0;
      advance_point(w, p, step.dt * v[0], step.dt * v[1], held);
    }
}

void CohesiveZones::limit(StepReport& report) const {
  report.rate = std::max(report.rate, rate_);
  report.travel = std::max(report.travel, travel_);
  report.left |= left_;
}

}  // namespace sluice::mpm
