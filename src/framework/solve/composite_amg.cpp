// Rows of all levels for BoomerAMG, and its cycles.
#include "framework/solve/composite_amg.hpp"

#include <fmt/format.h>

#include <limits>
#include <numeric>

#include "framework/base/error.hpp"
#include "framework/solve/hypre_amg.hpp"

namespace sluice::solve {
namespace {

constexpr HYPRE_BigInt no_unknown = -1;
constexpr HYPRE_Int terms_of_row = 12;  // 7, and most of those of a coarse cell beside finer ones

// cell(place, {i, j, k}) for every cell of the window.
template <class F>
void for_cells(const DenseShape& s, F&& cell) {
  for (int k = 0; k < s.count[2]; ++k)
    for (int j = 0; j < s.count[1]; ++j)
      for (int i = 0; i < s.count[0]; ++i) cell(s.at(i, j, k), std::array<int, 3>{i, j, k});
}

}  // namespace

CompositeAmg::CompositeAmg(const CompositeSystem& system) {
  start_hypre();
  if (system.unknowns() > std::numeric_limits<HYPRE_Int>::max() / terms_of_row)
    throw InputError(fmt::format("hypre's amg numbers at most {} cells, the levels have {}",
                                 std::numeric_limits<HYPRE_Int>::max() / terms_of_row,
                                 system.unknowns()));
  number_unknowns(system);
  fill(system);
  make(b_);
  make(x_);
  check_hypre(HYPRE_BoomerAMGCreate(cycle_.out()), "BoomerAMGCreate");
  choose_amg_methods(cycle_.get());
  HYPRE_BoomerAMGSetTol(cycle_.get(), 0.0);
  HYPRE_BoomerAMGSetMaxIter(cycle_.get(), 1);
  HYPRE_BoomerAMGSetup(cycle_.get(), parcsr_matrix(matrix_.get()), par_vector(b_.get()),
                       par_vector(x_.get()));
  if (const std::string failure = take_hypre_failure(); !failure.empty())
    throw PhysicsError("hypre: set-up of amg failed: " + failure);
}

void CompositeAmg::make(Vector& vector) {
  const auto last = static_cast<HYPRE_BigInt>(numbers_.size()) - 1;
  check_hypre(HYPRE_IJVectorCreate(MPI_COMM_SELF, 0, last, vector.out()), "IJVectorCreate");
  check_hypre(HYPRE_IJVectorSetObjectType(vector.get(), HYPRE_PARCSR), "IJVectorSetObjectType");
  std::fill(values_.begin(), values_.end(), 0.0);
  put(vector);
}

void CompositeAmg::put(const Vector& to) {
  check_hypre(HYPRE_IJVectorInitialize(to.get()), "IJVectorInitialize");
  check_hypre(HYPRE_IJVectorSetValues(to.get(), static_cast<HYPRE_Int>(numbers_.size()),
                                      numbers_.data(), values_.data()),
              "IJVectorSetValues");
  check_hypre(HYPRE_IJVectorAssemble(to.get()), "IJVectorAssemble");
}

// By level, then by place.
void CompositeAmg::number_unknowns(const CompositeSystem& system) {
  HYPRE_BigInt next = 0;
  for (std::size_t l = 0; l < system.levels(); ++l) {
    const DenseShape& shape = system.rows(l).shape();
    const DenseVector is_unknown = system.unknowns_of(l);
    std::vector<HYPRE_BigInt>& number = number_.emplace_back(shape.size(), no_unknown);
    std::vector<std::ptrdiff_t>& places = places_.emplace_back();
    for_cells(shape, [&](std::ptrdiff_t c, const std::array<int, 3>&) {
      if (is_unknown[c] == 0) return;
      number[c] = next++;
      places.push_back(c);
    });
  }
  numbers_.resize(next);
  std::iota(numbers_.begin(), numbers_.end(), HYPRE_BigInt{0});
  values_.resize(numbers_.size());
}

void CompositeAmg::add(HYPRE_BigInt row, HYPRE_Int n, const HYPRE_BigInt* columns,
                       const double* values) {
  check_hypre(HYPRE_IJMatrixAddToValues(matrix_.get(), 1, &n, &row, columns, values),
              "IJMatrixAddToValues");
}

// A cell with its neighbours on its own level.
void CompositeAmg::add_row(const DenseSystem& rows, const std::vector<HYPRE_BigInt>& number,
                           std::ptrdiff_t c, const std::array<int, 3>& cell) {
  const HYPRE_BigInt row = number[c];
  if (row == no_unknown) return;
  const DenseShape& shape = rows.shape();
  std::array<HYPRE_BigInt, 7> columns{row};
  std::array<double, 7> values{rows.diagonal()[c]};
  HYPRE_Int n = 1;
  for (int d = 0; d < 3; ++d) {
    const int count = shape.count[d];
    for (int side = 0; side < 2 && count > 1; ++side) {
      const double low = rows.low(d)[c + side * shape.stride(d)];
      if (low == 0) continue;
      std::array<int, 3> other = cell;
      int& along = other[d];
      along = (along + (side == 0 ? -1 : 1) + count) % count;
      const std::size_t place = shape.at(other[0], other[1], other[2]);
      columns[n] = number[place];
      values[n++] = low;
    }
  }
  add(row, n, columns.data(), values.data());
}

void CompositeAmg::fill(const CompositeSystem& system) {
  const auto last = static_cast<HYPRE_BigInt>(numbers_.size()) - 1;
  check_hypre(HYPRE_IJMatrixCreate(MPI_COMM_SELF, 0, last, 0, last, matrix_.out()),
              "IJMatrixCreate");
  check_hypre(HYPRE_IJMatrixSetObjectType(matrix_.get(), HYPRE_PARCSR), "IJMatrixSetObjectType");
  const std::vector<HYPRE_Int> sizes(numbers_.size(), terms_of_row);
  check_hypre(HYPRE_IJMatrixSetRowSizes(matrix_.get(), sizes.data()), "IJMatrixSetRowSizes");
  check_hypre(HYPRE_IJMatrixInitialize(matrix_.get()), "IJMatrixInitialize");
  for (std::size_t l = 0; l < system.levels(); ++l)
    for_cells(system.rows(l).shape(), [&](std::ptrdiff_t c, const std::array<int, 3>& cell) {
      add_row(system.rows(l), number_[l], c, cell);
    });
  system.for_interfaces(
      [&](std::size_t level, std::ptrdiff_t fine, std::ptrdiff_t coarse, double weight) {
        const HYPRE_BigInt f = number_[level][fine];
        const HYPRE_BigInt c = number_[level - 1][coarse];
        const std::array<HYPRE_BigInt, 2> columns{c, f};
        const std::array<double, 2> values{weight, -weight};
        if (f != no_unknown) add(f, 1, &c, &values[1]);
        add(c, f == no_unknown ? 1 : 2, columns.data(), values.data());
      });
  check_hypre(HYPRE_IJMatrixAssemble(matrix_.get()), "IJMatrixAssemble");
}

void CompositeAmg::apply(const CompositeVector& r, CompositeVector& z) {
  std::size_t n = 0;
  for (std::size_t l = 0; l < places_.size(); ++l)
    for (const std::ptrdiff_t c : places_[l]) values_[n++] = r[l][c];
  put(b_);
  std::fill(values_.begin(), values_.end(), 0.0);
  put(x_);
  HYPRE_BoomerAMGSolve(cycle_.get(), parcsr_matrix(matrix_.get()), par_vector(b_.get()),
                       par_vector(x_.get()));
  HYPRE_ClearAllErrors();  // one cycle does not converge
  check_hypre(HYPRE_IJVectorGetValues(x_.get(), static_cast<HYPRE_Int>(numbers_.size()),
                                      numbers_.data(), values_.data()),
              "IJVectorGetValues");
  n = 0;
  for (std::size_t l = 0; l < places_.size(); ++l) {
    std::fill(z[l].begin(), z[l].end(), 0.0);
    for (const std::ptrdiff_t c : places_[l]) z[l][c] = values_[n++];
  }
}

}  // namespace sluice::solve
