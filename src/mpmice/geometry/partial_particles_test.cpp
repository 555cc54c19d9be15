// Particles that are solid in part: sums are those of each particle alone times its part, and what
// is swept stays what theta changes by.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mpmice/geometry/found_geometry_test_support.hpp"

namespace sluice::mpmice::partial_particles {
namespace {

// Measured: 2e-15, 7e-16.
constexpr double of_single_particles = 2e-14;
constexpr double of_identity = 4e-15;

// All faces of particles first to end - 1; part p of each.
template <int D>
OuterFaces<D> all_faces(const Body<D>& body, std::size_t first, std::size_t end,
                        const KeptArray<double>& part) {
  std::vector<std::uint8_t> bits(body.size(), 0);
  for (std::size_t p = first; p < end; ++p) bits[p] = (1 << faces_of_particle<D>)-1;
  OuterFaces<D> f;
  const auto to = Body<D>::columns(body.end);
  f.add(Body<D>::columns(body.start), &to, bits.data(), bits.size());
  for (std::size_t i = 0; i < f.size(); ++i) f.weight.push_back(part[f.particle[i]]);
  return f;
}

template <int D>
KeptArray<double> parts_of(std::size_t n) {
  KeptArray<double> part(n);
  for (std::size_t p = 0; p < n; ++p) part[p] = 0.5 + 0.5 * hashed(p, D);
  return part;
}

// Particle p of a body as a body of its own.
template <int D>
Body<D> single(const Body<D>& body, std::size_t p) {
  Body<D> one;
  for (std::size_t k = 0; k < Body<D>::corners; ++k)
    for (std::size_t d = 0; d < D; ++d) one.start[k][d] = {body.start[k][d][p]};
  one.end = one.start;
  one.outer = {(1 << faces_of_particle<D>)-1};
  return one;
}

template <int D>
void check_theta() {
  const Body<D> body = block<D>("block", 4, {});
  const KeptArray<double> part = parts_of<D>(body.size()), whole(body.size(), 1.0);
  KeptArray<double> sum(test_cells<D>().size(), 0.0);
  for (std::size_t p = 0; p < body.size(); ++p) {
    const auto one = GeometryOf<D>{}.at(When::start, single(body, p));
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[p] * one.theta[i];
  }
  GeometryOf<D> of_parts;
  of_parts.parts = &part;
  const auto all = of_parts.at(When::start, body, all_faces(body, 0, body.size(), part));
  double worst = 0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    worst = std::max(worst, std::fabs(sum[i] - all.theta[i]));
  EXPECT_LT(worst, of_single_particles) << D;
  // Whole particles: what their outer faces alone say.
  const auto outer = GeometryOf<D>{}.at(When::start, body),
             full = GeometryOf<D>{}.at(When::start, body, all_faces(body, 0, body.size(), whole));
  for (std::size_t i = 0; i < sum.size(); ++i)
    EXPECT_NEAR(outer.theta[i], full.theta[i], of_single_particles);
}

TEST(PartialParticles, CountByTheirPart) {
  check_theta<1>();
  check_theta<2>();
  check_theta<3>();
}

template <int D>
void check_identity() {
  Body<D> body = block<D>("block", 4, {});
  body.move([](const Point<D>& x) {
    Point<D> to = x;
    for (std::size_t d = 0; d < D; ++d) to[d] += 0.3 + 0.1 * std::sin(x[(d + 1) % D]);
    return to;
  });
  const KeptArray<double> parts = parts_of<D>(body.size());
  const OuterFaces<D> faces = all_faces(body, 0, body.size(), parts);
  GeometryOf<D> of_parts;
  of_parts.parts = &parts;
  const auto before = of_parts.at(When::start, body, faces),
             after = of_parts.at(When::end, body, faces);
  const SweptVolumes<D> s = of_parts.swept(body, faces);
  const KeptArray<double> gain = added_by_surface<D>(faces);
  for_cells<D>(cells_of(s), [&](const Cell<D>& c, std::size_t at) {
    double sum = gain[at];
    for (std::size_t d = 0; d < D; ++d) {
      Cell<D> above = c;
      if (++above[d] == cells_of(s).upper[d]) return;
      sum += s.C[d][at] - s.C[d][cells_of(s).index(above)];
    }
    EXPECT_NEAR(after.theta[at] - before.theta[at], sum, of_identity) << D;
  });
}

TEST(PartialParticles, SweepWhatThetaChangesBy) {
  check_identity<1>();
  check_identity<2>();
  check_identity<3>();
}

// At rest what faces cover in the mean is what they cover, in planes of the grid too.
template <int D>
void check_rest() {
  Point<D> on;
  on.fill(2);
  const Body<D> body = block<D>("on grid planes", 4, on);
  const KeptArray<double> parts = parts_of<D>(body.size());
  OuterFaces<D> faces = all_faces(body, 0, body.size(), parts);
  for (std::size_t i = 0; i < faces.size(); ++i)
    faces.inner.push_back((body.outer[faces.particle[i]] >> faces.face[i] & 1) == 0 ? 1 : 0);
  GeometryOf<D> of_parts;
  of_parts.parts = &parts;
  const auto covered = of_parts.at(When::start, body, faces);
  const SweptVolumes<D> s = of_parts.swept(body, faces);
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t i = 0; i < s.A[d].size(); ++i) {
      EXPECT_NEAR(s.A[d][i], covered.a[d][i], of_identity) << D;
      EXPECT_EQ(s.C[d][i], 0) << D;
    }
}

TEST(PartialParticles, AtRestCoverInTheMeanWhatTheyCover) {
  check_rest<1>();
  check_rest<2>();
  check_rest<3>();
}

}  // namespace
}  // namespace sluice::mpmice::partial_particles
