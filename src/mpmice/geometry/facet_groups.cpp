#include "mpmice/geometry/facet_groups.hpp"

#include <bit>
#include <cmath>

#include "mpmice/geometry/cell_sums.hpp"
#include "mpmice/geometry/mixed_facet.hpp"

namespace sluice::mpmice {
namespace {

constexpr std::size_t width = FacetGroups::width;
using Group = FacetGroups::Group;
using Lanes = double __attribute__((vector_size(64)));
using Whole = std::int64_t __attribute__((vector_size(64)));

Lanes all(double x) {
  return Lanes{x, x, x, x, x, x, x, x};
}
Lanes chosen(Whole mask, Lanes a, Lanes b) {
  return mask ? a : b;
}
Lanes loaded(const double* from) {
  Lanes to;
  __builtin_memcpy(&to, from, sizeof(to));
  return to;
}

// round(x sum_unit), halves away from zero: x and -x cancel.
Whole in_units(Lanes x) {
  const Lanes scaled = x * sum_unit, half = chosen(x < 0.0, all(-0.5), all(0.5));
  return __builtin_convertvector(scaled + half, Whole);
}

// Rows become columns.
void transpose(Whole (&m)[width]) {
  Whole t[width];
  for (std::size_t i = 0; i < width; i += 2) {
    t[i] = __builtin_shufflevector(m[i], m[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    t[i + 1] = __builtin_shufflevector(m[i], m[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  Whole u[width];
  for (std::size_t i = 0; i < width; i += 4)
    for (std::size_t k = 0; k < 2; ++k) {
      u[i + k] = __builtin_shufflevector(t[i + k], t[i + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      u[i + k + 2] = __builtin_shufflevector(t[i + k], t[i + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (std::size_t k = 0; k < 4; ++k) {
    m[k] = __builtin_shufflevector(u[k], u[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    m[k + 4] = __builtin_shufflevector(u[k], u[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

// A triangle: places of its corners, the weights there of the nodes of the facet, its share of the
// facet's area.
struct Triangle {
  Lanes x[3][3], l[3][3], share;
};
struct Part {
  Lanes s, m[3];
};

Part whole_of(const Triangle& t) {
  Part to{t.share, {}};
  const Lanes third = t.share * (1.0 / 3);
  for (int k = 0; k < 3; ++k) to.m[k] = third * ((t.l[0][k] + t.l[1][k]) + t.l[2][k]);
  return to;
}

// The corner that the plane x_d = 1 cuts off; `low`: it lies below the plane. Where all corners lie
// on one side it has no area, and is taken for one of the other side.
Triangle corner_of(const Triangle& t, int d, Whole& low) {
  const Whole b0 = t.x[0][d] < 1.0, b1 = t.x[1][d] < 1.0, b2 = t.x[2][d] < 1.0;
  const Whole below = -(b0 + b1 + b2), one = below == 1, two = below == 2;
  low = one | (below == 0);
  const Whole first = (one & b0) | (two & ~b0), second = (one & b1) | (two & ~b1);
  // Corner v alone on its side, then a and b around the triangle.
  const auto turned = [&](const Lanes(&of)[3][3], int k, int by) {
    return chosen(first, of[by % 3][k], chosen(second, of[(1 + by) % 3][k], of[(2 + by) % 3][k]));
  };
  const Whole cuts = one | two;
  const Lanes none{}, unit = all(1);
  const Lanes v = turned(t.x, d, 0), a = turned(t.x, d, 1), b = turned(t.x, d, 2);
  const Lanes ta = chosen(cuts, (1.0 - v) / chosen(cuts, a - v, unit), none),
              tb = chosen(cuts, (1.0 - v) / chosen(cuts, b - v, unit), none);
  Triangle to;
  for (int k = 0; k < 3; ++k) {
    const auto take = [&](const Lanes(&from)[3][3], Lanes(&into)[3][3]) {
      const Lanes at = turned(from, k, 0);
      into[0][k] = at;
      into[1][k] = at + ta * (turned(from, k, 1) - at);
      into[2][k] = at + tb * (turned(from, k, 2) - at);
    };
    take(t.x, to.x);
    take(t.l, to.l);
  }
  for (int n = 1; n < 3; ++n) to.x[n][d] = chosen(cuts, unit, to.x[n][d]);
  to.share = t.share * (ta * tb);
  return to;
}

// Parts of a triangle by the sides of the planes x_d = 1 on which they lie, d from D to Cuts - 1:
// bit d - D of their number is 1 above.
template <int D, int Cuts>
void part(const Triangle& t, Part* to) {
  if constexpr (D == Cuts) {
    to[0] = whole_of(t);
  } else {
    constexpr int half = 1 << (Cuts - D - 1);
    Part all_of_it[half], corner[half];
    part<D + 1, Cuts>(t, all_of_it);
    Whole low;
    const Triangle cut = corner_of(t, D, low);
    part<D + 1, Cuts>(cut, corner);
    for (int i = 0; i < half; ++i) {
      const auto give = [&](Lanes whole, Lanes cut_off, Lanes& below, Lanes& above) {
        const Lanes rest = whole - cut_off;
        below = chosen(low, cut_off, rest);
        above = chosen(low, rest, cut_off);
      };
      give(all_of_it[i].s, corner[i].s, to[2 * i].s, to[2 * i + 1].s);
      for (int k = 0; k < 3; ++k)
        give(all_of_it[i].m[k], corner[i].m[k], to[2 * i].m[k], to[2 * i + 1].m[k]);
    }
  }
}

// Eight moving facets that are cut along directions 0 to Cuts - 1, of which `Split` are split.
template <int Cuts, unsigned Split>
class Moving {
 public:
  explicit Moving(const Group& g) : group_(g) {
    for (int slot = 0; slot < 2; ++slot)
      for (int node = 0; node < 3; ++node)
        for (int d = 0; d < 3; ++d) x_[slot][node][d] = loaded(g.x[slot][node][d]);
    for (int d = 0; d < 3; ++d)
      for (int node = 0; node < 3; ++node) move_[d][node] = x_[1][node][d] - x_[0][node][d];
    const Lanes weight = loaded(g.weight);
    for (int d = 0; d < 3; ++d)
      for (int u = 0; u < 2; ++u)
        for (int v = 0; v < 2; ++v) normal_[d][u][v] = weight * normal_of(d, u, v);
  }

  void add(const CellBlocks<3>& cells, std::uint64_t* sums) {
    find_places(cells);
    // Every split direction at its old and at its new places; all new comes last.
    for (unsigned slots = 0; slots <= Split; ++slots)
      if ((slots & ~Split) == 0) add_cut(slots, sums);
  }

 private:
  static constexpr int parts = 1 << Cuts;
  static constexpr bool is_split(int d) { return (Split >> d & 1) != 0; }

  // n_d of the shape with these slots of the next two directions.
  Lanes normal_of(int d, int u, int v) const {
    const int j = (d + 1) % 3, k = (d + 2) % 3;
    const auto edge = [&](int node, int along, int slot) {
      return x_[slot][node][along] - x_[slot][0][along];
    };
    return 0.5 * (edge(1, j, u) * edge(2, k, v) - edge(1, k, v) * edge(2, j, u));
  }
  // sum of W n_d over the shapes that share a cut and have these places along d; P_d where `both`
  // (MeanArea).
  Lanes mean_area(int d, unsigned slots, int own, bool both) const {
    const int j = (d + 1) % 3, k = (d + 2) % 3;
    Lanes sum{};
    for (int u = 0; u < 2; ++u)
      for (int v = 0; v < 2; ++v) {
        const bool there = (!is_split(j) || u == static_cast<int>(slots >> j & 1)) &&
                           (!is_split(k) || v == static_cast<int>(slots >> k & 1));
        const double weight = both ? weight_of_shape<3>(u + v) + weight_of_shape<3>(u + v + 1)
                                   : weight_of_shape<3>(u + v + own);
        if (there) sum += weight * normal_[d][u][v];
      }
    return sum;
  }
  Triangle triangle(unsigned slots) const {
    Triangle t;
    for (int node = 0; node < 3; ++node)
      for (int d = 0; d < 3; ++d) {
        t.x[node][d] = x_[slots >> d & 1][node][d];
        t.l[node][d] = all(node == d ? 1 : 0);
      }
    t.share = all(1);
    return t;
  }
  static Lanes dot(const Lanes (&m)[3], const Lanes (&f)[3]) {
    return (m[0] * f[0] + m[1] * f[1]) + m[2] * f[2];
  }
  // m.(P - X) along d, of a part that lies above the plane or not.
  static Lanes arm(const Part& p, const Lanes (&x)[3][3], int d, int above) {
    const double X = above;
    return (p.m[0] * (x[0][d] - X) + p.m[1] * (x[1][d] - X)) + p.m[2] * (x[2][d] - X);
  }

  void add_cut(unsigned slots, std::uint64_t* sums) {
    Lanes at[3][2], N[3], P[3];  // MeanArea
    for (int d = 0; d < 3; ++d) {
      for (int own = 0; own < 2; ++own)
        if (!is_split(d) || own == static_cast<int>(slots >> d & 1))
          at[d][own] = mean_area(d, slots, own, false);
        else
          at[d][own] = Lanes{};
      N[d] = at[d][0] + at[d][1];
      if (is_split(d)) P[d] = mean_area(d, slots, 0, true);
    }
    const Triangle t = triangle(slots);
    Part found[parts];
    part<0, Cuts>(t, found);
    for (int p = 0; p < parts; ++p) {
      Whole swept[width] = {};
      for (int d = 0; d < 3; ++d) {
        const int above = d < Cuts ? p >> d & 1 : 0;
        swept[lane(number_of_cell::mean_N, d)] = in_units(N[d] * found[p].s);
        Lanes T{};
        if (is_split(d)) {
          const bool is_new = (slots >> d & 1) != 0;
          const Lanes to_part = arm(found[p], t.x, d, above);
          T = N[d] * to_part;
          T_[d][p] += (is_new ? 1.0 : -1.0) * P[d] * to_part - N[d] * dot(found[p].m, move_[d]);
        } else {
          T = at[d][0] * arm(found[p], x_[0], d, above) + at[d][1] * arm(found[p], x_[1], d, above);
        }
        swept[lane(number_of_cell::mean_T, d)] = in_units(T);
      }
      if (slots == Split) add_end(p, found[p], swept, sums);
      transpose(swept);
      for (std::size_t i = 0; i < group_.count; ++i) add_to(sums + at_[p][i], swept[i]);
    }
  }
  // Once the last shape is cut: C of faces that the plane is, N' and T'.
  void add_end(int p, const Part& found, Whole (&swept)[width], std::uint64_t* sums) const {
    Whole end[width] = {};
    for (int d = 0; d < 3; ++d) {
      const int above = d < Cuts ? p >> d & 1 : 0;
      const Lanes N = normal_[d][1][1];
      end[lane(number_of_cell::end_N - 8, d)] = in_units(N * found.s);
      end[lane(number_of_cell::end_T - 8, d)] = in_units(N * arm(found, x_[1], d, above));
      if (!is_split(d) || above == 0) continue;
      const std::size_t C = number_of_cell::C[lane(0, d)];
      (C < 8 ? swept[C] : end[C - 8]) = in_units(T_[d][p]);
    }
    end[number_of_cell::mark - 8] = Whole{1, 1, 1, 1, 1, 1, 1, 1};
    transpose(end);
    for (std::size_t i = 0; i < group_.count; ++i) add_to(sums + at_[p][i] + 8, end[i]);
  }
  std::size_t lane(std::size_t first, int d) const {
    return first + static_cast<std::size_t>((d + group_.turn) % 3);
  }
  static void add_to(std::uint64_t* to, Whole more) {
    Whole sum;
    __builtin_memcpy(&sum, to, sizeof(sum));
    sum += more;
    __builtin_memcpy(to, &sum, sizeof(sum));
  }
  // Where the numbers of the cells of all parts begin.
  void find_places(const CellBlocks<3>& cells) {
    for (int p = 0; p < parts; ++p)
      for (std::size_t i = 0; i < group_.count; ++i) {
        Cell<3> c = group_.low[i];
        for (int d = 0; d < Cuts; ++d)
          c[static_cast<std::size_t>((d + group_.turn) % 3)] += p >> d & 1;
        at_[p][i] = numbers_of_cell * cells.index_to_add(c);
      }
  }

  const Group& group_;
  Lanes x_[2][3][3];        // [old, new][node][direction]
  Lanes move_[3][3];        // [direction][node]
  Lanes normal_[3][2][2];   // [direction][slot of the next][slot of the one after]
  Lanes T_[3][parts] = {};  // Tl of a part (swept_rows.hpp)
  std::size_t at_[parts][width];
};

template <int Cuts, unsigned Split>
void add_group(const Group& g, const CellBlocks<3>& cells, std::uint64_t* sums) {
  Moving<Cuts, Split>(g).add(cells, sums);
}

void add_full(std::size_t cuts, unsigned split, const Group& g, const CellBlocks<3>& cells,
              std::uint64_t* sums) {
  using Add = void (*)(const Group&, const CellBlocks<3>&, std::uint64_t*);
  static constexpr Add table[4][8] = {
      {add_group<0, 0>},
      {add_group<1, 0>, add_group<1, 1>},
      {add_group<2, 0>, add_group<2, 1>, add_group<2, 2>, add_group<2, 3>},
      {add_group<3, 0>, add_group<3, 1>, add_group<3, 2>, add_group<3, 3>, add_group<3, 4>,
       add_group<3, 5>, add_group<3, 6>, add_group<3, 7>}};
  table[cuts][split](g, cells, sums);
}

// What decides the group of eight facets t of faces i to i + 7.
struct Spans {
  alignas(64) double low[3][width], high[3][width];
  bool moves[3][width], flat[width];
};

void find_spans(const double (&x)[2][3][3][width], Spans& to) {
  std::fill_n(to.flat, width, false);
  for (int d = 0; d < 3; ++d) {
    double low[2][width], high[2][width];
    for (int slot = 0; slot < 2; ++slot)
      for (std::size_t l = 0; l < width; ++l) {
        const double a = x[slot][0][d][l], b = x[slot][1][d][l], c = x[slot][2][d][l];
        low[slot][l] = std::min(std::min(a, b), c);
        high[slot][l] = std::max(std::max(a, b), c);
      }
    for (std::size_t l = 0; l < width; ++l) {
      to.low[d][l] = std::floor(std::min(low[0][l], low[1][l]));
      to.high[d][l] = std::ceil(std::max(high[0][l], high[1][l])) - 1;
      const auto in_plane = [&](int slot) {
        return low[slot][l] == high[slot][l] && low[slot][l] == std::floor(low[slot][l]);
      };
      to.flat[l] |= in_plane(0) || in_plane(1);
      bool moves = false;
      for (int node = 0; node < 3; ++node) moves |= x[0][node][d][l] != x[1][node][d][l];
      to.moves[d][l] = moves;
    }
  }
}

// Places of the nodes of facet t of up to eight faces from i on; the rest repeat the last.
void take_nodes(const OuterFaces<3>& faces, std::size_t i, int t, double (&x)[2][3][3][width]) {
  const auto a = static_cast<std::size_t>(t), b = (a + 1) % 4;
  const std::size_t n = std::min(width, faces.size() - i);
  for (int slot = 0; slot < 2; ++slot) {
    const auto& places = slot == 0 ? faces.start : faces.end;
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t l = 0; l < width; ++l) {
        const std::size_t f = i + std::min(l, n - 1);
        x[slot][0][d][l] =
            ((places[0][d][f] + places[2][d][f]) + (places[1][d][f] + places[3][d][f])) * 0.25;
        x[slot][1][d][l] = places[a][d][f];
        x[slot][2][d][l] = places[b][d][f];
      }
  }
}

}  // namespace

void FacetGroups::add(const OuterFaces<3>& faces, const CellBlocks<3>& cells, std::uint64_t* sums,
                      KeptArray<std::uint32_t>& left) {
  left.clear();
  // Turns that bring the directions that are cut, by their bits, to the front.
  static constexpr int turn_of[8] = {0, 0, 1, 0, 2, 2, 1, 0};
  alignas(64) double x[2][3][3][width];
  Spans spans;
  for (std::size_t i = 0; i < faces.size(); i += width)
    for (int t = 0; t < 4; ++t) {
      take_nodes(faces, i, t, x);
      find_spans(x, spans);
      for (std::size_t l = 0; l < std::min(width, faces.size() - i); ++l) {
        unsigned cut = 0;
        bool simple = !spans.flat[l];
        for (int d = 0; d < 3; ++d) {
          const double more = spans.high[d][l] - spans.low[d][l];
          simple &= more <= 1;
          cut |= more > 0 ? 1u << d : 0u;
        }
        if (!simple) {
          left.push_back(static_cast<std::uint32_t>(4 * (i + l)) + static_cast<std::uint32_t>(t));
          continue;
        }
        const int turn = turn_of[cut], cuts = std::popcount(cut);
        unsigned split = 0;
        for (int d = 0; d < cuts; ++d) split |= spans.moves[(d + turn) % 3][l] ? 1u << d : 0u;
        Group& g = groups_[static_cast<std::size_t>(cuts)][split][static_cast<std::size_t>(turn)];
        g.turn = turn;
        for (int d = 0; d < 3; ++d) {
          const int of = (d + turn) % 3;
          g.low[g.count][static_cast<std::size_t>(of)] = static_cast<int>(spans.low[of][l]);
          for (int slot = 0; slot < 2; ++slot)
            for (int node = 0; node < 3; ++node)
              g.x[slot][node][d][g.count] = x[slot][node][of][l] - spans.low[of][l];
        }
        g.weight[g.count] = faces.weight_of(i + l);
        if (++g.count < width) continue;
        add_full(static_cast<std::size_t>(cuts), split, g, cells, sums);
        g.count = 0;
      }
    }
  for (std::size_t cuts = 0; cuts < 4; ++cuts)
    for (unsigned split = 0; split < 8; ++split)
      for (Group& g : groups_[cuts][split]) {
        if (g.count == 0) continue;
        for (std::size_t l = g.count; l < width; ++l) {  // what is not used must be finite
          g.weight[l] = 0;
          for (auto& slot : g.x)
            for (auto& node : slot)
              for (auto& along : node) along[l] = along[0];
        }
        add_full(cuts, split, g, cells, sums);
        g.count = 0;
      }
}

}  // namespace sluice::mpmice
