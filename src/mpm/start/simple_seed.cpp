#include "mpm/start/simple_seed.hpp"
namespace sluice::mpm {
SeededParticles seed_simply(const SolidMaterial& material, const Level& level, const IndexBox& cells) {
  SeededParticles s;
  std::int64_t object = 0;
  for (const SeedObject& o : material.objects) {
    const IntVec3 n = o.per_cell;
    for (int k = cells.lower.z; k < cells.upper.z; ++k)
      for (int j = cells.lower.y; j < cells.upper.y; ++j)
        for (int i = cells.lower.x; i < cells.upper.x; ++i)
          for (int c = 0; c < n.z; ++c)
            for (int b = 0; b < n.y; ++b)
              for (int a = 0; a < n.x; ++a) {
                const Vec3 x{level.anchor.x + (i + (a + 0.5) / n.x) * level.spacing.x,
                             level.anchor.y + (j + (b + 0.5) / n.y) * level.spacing.y,
                             level.anchor.z + (k + (c + 0.5) / n.z) * level.spacing.z};
                if (!o.piece->inside(x)) continue;
                s.x.push_back(x.x); s.y.push_back(x.y); s.z.push_back(x.z);
                for (int d = 0; d < 3; ++d) s.velocity[d].push_back(o.velocity[d]);
                const double V = level.cell_volume() / (n.x * n.y * n.z);
                s.volume.push_back(V);
                s.mass.push_back(material.constants.density * V);
                for (int e = 0; e < 9; ++e) s.edges[e].push_back(e % 4 == 0 ? 1.0 / n[e / 4] : 0.0);
                s.temperature.push_back(o.temperature);
                s.colour.push_back(o.colour);
                const IntVec3 size = level.domain.size();
                const IntVec3 l = level.domain.lower;
                s.id.push_back((((std::int64_t{i - l.x} + size.x * (std::int64_t{j - l.y} + std::int64_t{size.y} * (k - l.z))) * n.x * n.y * n.z + a + n.x * (b + n.y * c)) << 4) + object);
                bool at_surface = false;
                for (int d = 0; d < 3; ++d)
                  for (const double sign : {-1.0, 1.0}) {
                    if (!level.active[d]) continue;
                    Vec3 beside = x;
                    beside[d] += sign * level.spacing[d] / n[d];
                    at_surface |= !o.piece->inside(beside);
                  }
                s.surface.push_back(at_surface);
              }
    ++object;
  }
  return s;
}
}
