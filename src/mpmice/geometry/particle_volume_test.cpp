// Volumes of particles against determinants and tetrahedra, their gradients against differences.
#include "mpmice/geometry/particle_volume.hpp"

#include <gtest/gtest.h>

#include "mpmice/geometry/bodies_test_support.hpp"

namespace sluice::mpmice::particle_volume {
namespace {

constexpr double of_sums = 1e-15;         // 1.1e-16
constexpr double of_volume = 2e-15;       // 2.8e-16
constexpr double of_differences = 1e-14;  // 1.2e-15

// The signed volume inside all facets of a particle: sum of determinants with the origin.
template <int D>
double volume_by_facets(const std::array<Point<D>, corners_of_particle<D>>& x) {
  double sum = 0;
  for (int f = 0; f < faces_of_particle<D>; ++f) {
    const auto& order = face_corners<D>[static_cast<std::size_t>(f)];
    if constexpr (D == 1) {
      sum += f == 1 ? x[order[0]][0] : -x[order[0]][0];
    } else if constexpr (D == 2) {
      const auto &a = x[order[0]], &b = x[order[1]];
      sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    } else {
      Point<3> m{};
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t d = 0; d < 3; ++d) m[d] += 0.25 * x[order[k]][d];
      for (std::size_t k = 0; k < 4; ++k) {
        const auto &a = x[order[k]], &b = x[order[(k + 1) % 4]];
        for (std::size_t d = 0; d < 3; ++d) {
          const std::size_t u = (d + 1) % 3, v = (d + 2) % 3;
          sum += m[d] * (a[u] * b[v] - a[v] * b[u]) / 6;
        }
      }
    }
  }
  return sum;
}

template <int D>
void check() {
  const Body<D> body = block<D>("", 4, {}, 0.4);
  const auto columns = Body<D>::columns(body.start);
  VolumeGradients<D> chunk;
  double worst_sum = 0, worst_volume = 0, worst_difference = 0;
  for (std::size_t at = 0; at < body.size(); at += chunk_size) {
    const int n = static_cast<int>(std::min<std::size_t>(chunk_size, body.size() - at));
    volume_gradients<D>(columns, at, n, chunk);
    for (int q = 0; q < n; ++q) {
      const std::size_t p = at + static_cast<std::size_t>(q);
      std::array<Point<D>, corners_of_particle<D>> x;
      for (std::size_t k = 0; k < x.size(); ++k)
        for (std::size_t d = 0; d < D; ++d) x[k][d] = body.start[k][d][p];
      worst_volume = std::max(worst_volume, std::abs(chunk.volume[q] - volume_by_facets<D>(x)));
      for (std::size_t d = 0; d < D; ++d) {
        double sum = 0;
        std::array<double, D> moment{};
        for (std::size_t k = 0; k < x.size(); ++k) {
          sum += chunk.b[k][d][q];
          for (std::size_t e = 0; e < D; ++e) moment[e] += chunk.b[k][d][q] * (x[k][e] - x[0][e]);
          auto moved = x;  // V is linear in each coordinate alone: any step gives the gradient
          moved[k][d] += 0.25;
          const double high = volume_by_facets<D>(moved);
          moved[k][d] -= 0.5;
          worst_difference =
              std::max(worst_difference,
                       std::abs(chunk.b[k][d][q] - 2 * (high - volume_by_facets<D>(moved))));
        }
        worst_sum = std::max(worst_sum, std::abs(sum));
        for (std::size_t e = 0; e < D; ++e)
          worst_sum = std::max(worst_sum, std::abs(moment[e] - (e == d ? chunk.volume[q] : 0)));
      }
    }
  }
  EXPECT_LT(worst_sum, of_sums) << D;
  EXPECT_LT(worst_volume, of_volume) << D;
  EXPECT_LT(worst_difference, of_differences) << D;
  ::testing::Test::RecordProperty("worst" + std::to_string(D),
                                  std::to_string(worst_sum * 1e16) + ", " +
                                      std::to_string(worst_volume * 1e16) + ", " +
                                      std::to_string(worst_difference * 1e16) + " e-16");
}

TEST(ParticleVolume, GradientsAreDifferencesOfVolumes) {
  check<1>();
  check<2>();
  check<3>();
}

TEST(ParticleVolume, OfASkewedBoxIsItsDeterminant) {
  Body<3> body = block<3>("", 1, {});
  body.move([](const Point<3>& x) -> Point<3> {
    return {2 * x[0] + 0.5 * x[1], x[1] - 0.25 * x[2] + x[0], 3 * x[2] + 7};
  });
  VolumeGradients<3> chunk;
  volume_gradients<3>(Body<3>::columns(body.end), 0, 1, chunk);
  // det [2 .5 0; 1 1 -.25; 0 0 3] / 8
  EXPECT_NEAR(chunk.volume[0], 4.5 / 8, 1e-15);
}

}  // namespace
}  // namespace sluice::mpmice::particle_volume
