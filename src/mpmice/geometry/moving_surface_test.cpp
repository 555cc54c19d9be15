// One pass over moving surfaces against facet by facet; bits of bodies moved by whole cells.
#include "mpmice/geometry/moving_surface.hpp"

#include <gtest/gtest.h>

#include "mpmice/geometry/found_geometry_test_support.hpp"

namespace sluice::mpmice::moving_surface {
namespace {

// Measured: 1.1e-15 of theta and covered parts, 4e-16 of what is swept.
constexpr double of_facets = 4e-15;

template <int D>
struct Sums {
  SolidInCells<D> end;
  SweptVolumes<D> swept;
};

template <int D>
Sums<D> found(const Body<D>& body, const OuterFaces<D>& faces, bool in_one_pass,
              const KeptArray<double>* parts = nullptr,
              const CellBlocks<D>& blocks = test_cells<D>().blocks) {
  SolidSums<D> end;
  SweptSums<D> swept;
  FreeCells<D> free;
  free.begin(blocks, {});
  end.begin(blocks);
  swept.begin(blocks);
  if (in_one_pass) {
    MovingSurface<D> surface;
    surface.add(faces, end, swept, free);
  } else {
    end.add(faces, When::end, 0, faces.size(), nullptr);
    swept.add(faces, 0, faces.size(), free);
  }
  const SolidParticles<D> particles = particles_of(body, parts);
  free.add(particles, When::end);
  free.finish();
  ReferenceCells<D> at_end, mean;
  at_end.begin(free);
  at_end.add(particles, When::end);
  mean.begin(free);
  mean.add_mean(particles);
  Sums<D> to;
  end.finish(free, at_end.values(), to.end);
  swept.finish(free, mean.values(), to.swept);
  return to;
}

double difference(const KeptArray<double>& a, const KeptArray<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

template <int D>
double difference(const Sums<D>& a, const Sums<D>& b) {
  double worst = difference(a.end.theta, b.end.theta);
  for (std::size_t d = 0; d < D; ++d)
    for (const double more :
         {difference(a.end.a[d], b.end.a[d]), difference(a.end.n[d], b.end.n[d]),
          difference(a.swept.A[d], b.swept.A[d]), difference(a.swept.C[d], b.swept.C[d])})
      worst = std::max(worst, more);
  return worst;
}

template <int D>
void check_bodies(double& worst) {
  for_each_body<D>([&](const Body<D>& body) {
    for (const NamedMotion<D>& motion : motions<D>()) {
      Body<D> moving = body;
      moving.move(motion.to);
      const OuterFaces<D> faces = moving.faces();
      const double error = difference(found(moving, faces, true), found(moving, faces, false));
      EXPECT_LT(error, of_facets) << body.name << ", " << motion.name << ", " << D;
      worst = std::max(worst, error);
    }
  });
}

TEST(MovingSurface, OnePassGivesWhatFacetsGive) {
  double worst = 0;
  check_bodies<1>(worst);
  check_bodies<2>(worst);
  check_bodies<3>(worst);
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
}

// Particles that are solid in part, with all their faces.
TEST(MovingSurface, FacesCountByWhatIsLeftOfTheirParticles) {
  Body<3> body = block<3>("", 4, {2.3, 2.1, 2.6}, 0.2);
  body.move(deformation<3>());
  std::vector<std::uint8_t> bits(body.size(), (1 << faces_of_particle<3>)-1);
  OuterFaces<3> faces;
  const auto to = Body<3>::columns(body.end);
  faces.add(Body<3>::columns(body.start), &to, bits.data(), bits.size());
  KeptArray<double> parts;
  for (std::size_t p = 0; p < body.size(); ++p) parts.push_back(0.5 + 0.5 * hashed(p, 3));
  for (std::size_t i = 0; i < faces.size(); ++i) {
    faces.weight.push_back(parts[faces.particle[i]]);
    faces.inner.push_back((body.outer[faces.particle[i]] >> faces.face[i] & 1) == 0 ? 1 : 0);
  }
  EXPECT_LT(difference(found(body, faces, true, &parts), found(body, faces, false, &parts)),
            of_facets);
}

// Lanes that hold no facet add nothing, and the order of faces does not show.
TEST(MovingSurface, NoBitDependsOnTheOrderOfFaces) {
  Body<3> body = block<3>("", 5, {2.6, 2.7, 2.8}, 0.3);
  body.move(deformation<3>());
  std::vector<std::uint8_t> first(body.size(), 0), second(body.size(), 0);
  for (std::size_t p = 0; p < body.size(); ++p) (p % 3 == 0 ? first : second)[p] = body.outer[p];
  const auto to = Body<3>::columns(body.end);
  OuterFaces<3> turned;
  for (const auto* bits : {&second, &first})
    turned.add(Body<3>::columns(body.start), &to, bits->data(), bits->size());
  const Sums<3> whole = found(body, body.faces(), true), other = found(body, turned, true);
  EXPECT_EQ(whole.end.theta, other.end.theta);
  EXPECT_EQ(whole.end.a, other.end.a);
  EXPECT_EQ(whole.swept.A, other.swept.A);
  EXPECT_EQ(whole.swept.C, other.swept.C);
}

// Places are counted from a facet's own cells, and rows begin in blocks, which are four cells wide.
TEST(MovingSurface, ABodyMovedByWholeCellsKeepsItsBits) {
  const auto shifted = [](int by) {
    // Corners are multiples of 2^-20, so that places far from the origin are exact.
    Body<3> body = block<3>("", 5, {2.6, 2.7, 2.8}, 0.3, 0x1p-20);
    body.move([](const Point<3>& x) {
      Point<3> y = deformation<3>()(x);
      for (double& e : y) e = std::round(e * 0x1p20) * 0x1p-20;
      return y;
    });
    for (auto* places : {&body.start, &body.end})
      for (auto& corner : *places)
        for (auto& column : corner)
          for (double& x : column) x += by;
    const auto blocks = CellBlocks<3>::around({all<3>(-6 + by), all<3>(16 + by)});
    const Sums<3> sums = found(body, body.faces(), true, nullptr, blocks);
    const SolidInCells<3>& g = sums.end;
    const SweptVolumes<3>& s = sums.swept;
    KeptArray<double> values;
    for_each_cell_of<3>({all<3>(-6 + by), all<3>(16 + by)}, [&](const Cell<3>& c) {
      const std::size_t i = blocks.index(c);
      values.insert(values.end(),
                    {g.theta[i], g.a[0][i], g.a[1][i], s.A[2][i], s.C[0][i], s.C[1][i]});
    });
    return values;
  };
  const KeptArray<double> here = shifted(0);
  EXPECT_EQ(here, shifted(500));
  EXPECT_EQ(here, shifted(-204));
}

}  // namespace
}  // namespace sluice::mpmice::moving_surface
