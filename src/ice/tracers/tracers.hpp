// Tracer particles in the flow: dx/dt = u(x, t), by Heun's method.
//
//   x* = x + dt u(x, t),   x' = x + dt/2 (u(x, t) + u(x*, t + dt))
//
// u is linear between cell centres and between the states before and after the step: second order
// in time and space. Where a wall is, the ghost cells mirror the flow, so that u leads along it. In
// cells that solids fill u is that of the solid: a tracer that one runs over goes with it.
//
// A number that a tracer carries decays by exp(-(c1 c2 + c3) dt), with the mean of c2 where the
// tracer was and is; copies of scalars are those of the cell in which it is.
//
// Ids: those at the start are numbered by region, level, cell and place in the cell; then come, one
// number after the other for all cells of all sources, the particles that appear n-th in their
// cell. They depend on neither boxes nor ranks nor time steps.
#pragma once
#include <memory>
#include <vector>

#include "framework/run/component/particle_method.hpp"
#include "framework/scene/scene.hpp"
#include "ice/boundary/boundary_fill.hpp"
#include "ice/tracers/flow_at_points.hpp"
#include "models/scalars/tracer_particles.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice::ice {

class Tracers : public ParticleMethod {
 public:
  using Boundaries = std::vector<std::unique_ptr<BoundaryFill>>;  // by level

  // Keeps references to the list, the grid's levels and the boundaries.
  Tracers(const std::vector<models::TracerParticles>& list,
          const std::vector<models::TransportedScalar>& scalars, const Grid& grid,
          const Boundaries& boundaries, FlowStorage flow, double max_time);

  const std::vector<ParticleKind>& kinds() const override { return kinds_; }
  void start(int kind, const Level& level, const IndexBox& cells,
             ParticleSet& particles) const override;
  void advance(int kind, const ParticleStep& step, ParticleSet& particles) const override;
  bool reflects(int kind, int level, Side side, IntVec3 cell) const override;

 private:
  // First ids by region and level.
  struct Ids {
    std::vector<std::vector<std::int64_t>> start, source;
    std::int64_t first_of_sources = 0;
    std::int64_t stride = 0;  // cells of all sources
  };
  // Columns of a kind; below 0: it has none.
  struct Columns {
    int scalar = -1, coefficient = -1, total = -1, first_clone = 0;
    std::vector<const models::TransportedScalar*> clones;
  };
  void add_attributes(const models::TracerParticles& t);
  void take_clones(int kind, const ParticleStep& step, ParticleSet& particles) const;
  Ids number(const models::TracerParticles& t) const;
  static void check_ids(const models::TracerParticles& t, const Ids& ids, double max_time);
  void add(int kind, const Level& level, Vec3 point, std::int64_t id, ParticleSet& particles) const;
  void emit(int kind, const ParticleStep& step, std::vector<double>& born,
            ParticleSet& particles) const;

  const std::vector<models::TracerParticles>* list_;
  const std::vector<models::TransportedScalar>* scalars_;
  const Grid* grid_;
  const Boundaries* boundaries_;
  FlowStorage flow_;
  std::vector<ParticleKind> kinds_;
  std::vector<Columns> columns_;
  std::vector<Ids> ids_;
};

}  // namespace sluice::ice
