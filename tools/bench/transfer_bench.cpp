// Nanoseconds a particle that a transfer between particles and nodes takes.
//
// usage: sluice_transfer_bench [BASIS [DIRECTIONS [flip|apic]]]; default gimp, 3, flip. BASIS:
// linear, gimp, gimp_own, cpgimp, quadratic, cubic, cpdi, carried_corners. Two particles a cell and
// direction, in blocks, in a body of 2^15 cells. Prints a line that ends with "ns N", both ways
// together, the least of repetitions.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <string>
#include <vector>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/corners.hpp"
#include "mpm/transfer/from_grid.hpp"

namespace {

using namespace sluice;
using namespace sluice::mpm;

constexpr int repetitions = 15;

struct Particles {
  Level level;
  TransferGrid grid;
  BlockShape shape;
  std::vector<IntVec3> blocks;  // each with as many particles
  int a_block = 0;
  std::vector<std::vector<double>> columns;

  explicit Particles(int directions) {
    const int cells = directions == 3 ? 32 : directions == 2 ? 176 : 32768;
    for (int d = 0; d < 3; ++d) level.active[static_cast<std::size_t>(d)] = d < directions;
    level.domain = {{0, 0, 0}, {1, 1, 1}};
    for (int d = 0; d < directions; ++d) level.domain.upper[d] = cells + 8;
    level.spacing = {0.1, 0.1, 0.1};
    shape = block_shape(level.active);
    grid.count = directions;
    grid.half = {0.25, 0.25, 0.25};
    for (int d = 0; d < 3; ++d) {
      grid.axes[static_cast<std::size_t>(d)] = axis_of(level, d);
      grid.active[static_cast<std::size_t>(d)] = d;
    }
    columns.resize(3 + 3 + 2 + 6 + 9 + 9 + 9 + 3 + 24);
    IntVec3 count{1, 1, 1};
    for (int d = 0; d < directions; ++d) count[d] = cells / shape.edge[d];
    for (int k = 0; k < count.z; ++k)
      for (int j = 0; j < count.y; ++j)
        for (int i = 0; i < count.x; ++i) fill({i, j, k}, directions);
    a_block = static_cast<int>(columns[0].size() / blocks.size());
  }

  void fill(IntVec3 block, int directions) {
    blocks.push_back(block);
    IntVec3 n{1, 1, 1};
    for (int d = 0; d < directions; ++d) n[d] = 2 * shape.edge[d];
    const IntVec3 low = shape.lower(block);
    for (int c = 0; c < n.z; ++c)
      for (int b = 0; b < n.y; ++b)
        for (int a = 0; a < n.x; ++a) {
          const double x[3] = {0.1 * (low.x + 0.5 * a + 0.21), 0.1 * (low.y + 0.5 * b + 0.27),
                               0.1 * (low.z + 0.5 * c + 0.24)};
          for (std::size_t e = 0; e < columns.size(); ++e) columns[e].push_back(value(e, x));
        }
  }
  static double value(std::size_t column, const double (&x)[3]) {
    if (column < 3) return x[column];
    if (column >= 14 && column < 23) return (column - 14) % 4 == 0 ? 1.02 : 0.01;  // F
    if (column >= 23 && column < 32) return (column - 23) % 4 == 0 ? 0.5 : 0.0;    // R0
    if (column >= 44) {  // corners, a quarter of a cell away
      const std::size_t corner = (column - 44) / 3, d = (column - 44) % 3;
      return x[d] + (corner >> d & 1 ? 0.0255 : -0.0255);
    }
    if (column >= 41) return 0.24;
    return 0.5;
  }
  template <std::size_t N>
  std::array<const double*, N> at(std::size_t first) const {
    std::array<const double*, N> to;
    for (std::size_t n = 0; n < N; ++n) to[n] = columns[first + n].data();
    return to;
  }
};

double seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);  // others on the machine do not count
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void run(const std::string& name, Basis basis, bool widths, int directions, bool affine) {
  const Particles of(directions);
  ParticlesToGrid p;
  p.x = of.at<3>(0);
  p.v = of.at<3>(3);
  p.mass = of.columns[6].data();
  p.volume = of.columns[7].data();
  p.stress = of.at<6>(8);
  p.shape.F = of.at<9>(14);
  p.shape.edges = of.at<9>(23);
  if (affine) p.affine = of.at<9>(32);
  if (widths) p.shape.half = of.at<3>(41);
  if (basis == Basis::carried) p.shape.corners = of.at<24>(44);
  SumUnits units;
  units.mass = units.momentum = units.force = 0x1p40;
  BlockTable table(of.shape);
  NodeLanes nodes;
  const int reach = std::max(reach_of(basis), by_corners(basis) ? 1 : 0);
  for (const IntVec3 b : of.blocks) {
    IntVec3 low = of.shape.lower(b), high = low;
    for (int d = 0; d < directions; ++d) {
      low[d] -= reach;
      high[d] += of.shape.edge[d] + reach;
    }
    add_blocks(table, low, high);
  }
  nodes.fit(table);
  Window window(of.shape, reach);
  GridAtParticles read;
  volatile double sink = 0;  // what is read is used
  // The least of each block: what others on the machine disturb differs from one to the next.
  std::vector<double> to(of.blocks.size(), 1e9), from(of.blocks.size(), 1e9);
  for (int r = 0; r < repetitions; ++r)
    for (std::size_t b = 0; b < of.blocks.size(); ++b) {
      const int begin = static_cast<int>(b) * of.a_block;
      const double start = seconds();
      window.begin(of.blocks[b]);
      add_to_window(basis, of.grid, p, begin, begin + of.a_block, units, window);
      window.add_to(table, nodes, false);
      to[b] = std::min(to[b], seconds() - start);
    }
  for (int n = 0; n < table.count(); ++n) std::fill_n(nodes.sums(n), block_lanes, as_bits(0.5));
  for (int r = 0; r < repetitions; ++r)
    for (std::size_t b = 0; b < of.blocks.size(); ++b) {
      const int begin = static_cast<int>(b) * of.a_block;
      const double start = seconds();
      window.load(of.blocks[b], table, nodes);
      for (int at = begin; at < begin + of.a_block; at += chunk_size) {
        read_window(basis, of.grid, p.x, p.shape, at, std::min(chunk_size, begin + of.a_block - at),
                    affine && basis != Basis::gimp && !by_corners(basis), window, read);
        sink = read.u[0][0];
      }
      from[b] = std::min(from[b], seconds() - start);
    }
  const double to_all = std::accumulate(to.begin(), to.end(), 0.0);
  const double from_all = std::accumulate(from.begin(), from.end(), 0.0);
  static_cast<void>(sink);
  const double scale = 1e9 / static_cast<double>(of.columns[0].size());
  std::printf("%s, %d-D%s, %zu particles: to grid %.1f, from grid %.1f, ns %.1f\n", name.c_str(),
              directions, affine ? ", affine" : "", of.columns[0].size(), to_all * scale,
              from_all * scale, (to_all + from_all) * scale);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "gimp";
  const int directions = argc > 2 ? std::atoi(argv[2]) : 3;
  const bool affine = argc > 3 && std::string(argv[3]) == "apic";
  const std::pair<const char*, Basis> bases[] = {
      {"linear", Basis::linear},       {"gimp", Basis::gimp},
      {"gimp_own", Basis::gimp},       {"cpgimp", Basis::cpgimp},
      {"quadratic", Basis::quadratic}, {"cubic", Basis::cubic},
      {"cpdi", Basis::cpdi},           {"carried_corners", Basis::carried}};
  for (const auto& [known, basis] : bases)
    if (name == known && directions >= 1 && directions <= 3) {
      run(name, basis, name == "gimp_own", directions, affine);
      return 0;
    }
  std::fprintf(stderr,
               "usage: sluice_transfer_bench [linear|gimp|gimp_own|cpgimp|quadratic|cubic|cpdi|"
               "carried_corners [1|2|3 [flip|apic]]]\n");
  return 2;
}
