// Rows of a view into chunks: copied or converted, summed while they are in the cache.
#include "framework/archive/field_gather.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "framework/base/crc32c.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

// The piece as up to three nested loops, the innermost first; loops of one turn are left out, so
// that rows run along the fastest direction that has more than one cell.
struct Loops {
  std::array<int, 3> count{1, 1, 1};
  std::array<std::ptrdiff_t, 3> stride{1, 0, 0};
};

Loops loops_of(const FieldPiece& piece) {
  Loops loops;
  std::size_t n = 0;
  for (int d = 0; d < 3; ++d) {
    if (piece.cells.size()[d] == 1) continue;
    loops.count[n] = piece.cells.size()[d];
    loops.stride[n++] = piece.view.stride[d];
  }
  return loops;
}

void check_range(const FieldPiece& piece) {
  const IndexBox& box = piece.view.box;
  for (int d = 0; d < 3; ++d) {
    const bool inside =
        piece.cells.lower[d] >= box.lower[d] && piece.cells.upper[d] <= box.upper[d];
    if (piece.view.valid() && (inside || piece.view.stride[d] == 0)) continue;
    throw std::logic_error("archive: piece of " + piece.label.name() + " reaches outside its view");
  }
}

template <class T>
class Chunk {
 public:
  Chunk(const FieldPiece& piece, const std::function<void(const void*, std::size_t)>& emit)
      : piece_(piece), emit_(emit), buffer_(gather_chunk_bytes / sizeof(T)) {}

  void row(const double* from, std::ptrdiff_t stride, int count) {
    while (count > 0) {
      const auto take = std::min<std::size_t>(count, buffer_.size() - used_);
      copy(buffer_.data() + used_, from, stride, take);
      used_ += take;
      from += static_cast<std::ptrdiff_t>(take) * stride;
      count -= static_cast<int>(take);
      if (used_ == buffer_.size()) flush();
    }
  }

  GatherResult finish() {
    if (used_ > 0) flush();
    return result_;
  }

 private:
  void copy(T* to, const double* from, std::ptrdiff_t stride, std::size_t n) {
    if constexpr (std::is_same_v<T, double>) {
      if (stride == 1) {
        std::memcpy(to, from, n * sizeof(double));
        return;
      }
    }
    for (std::size_t i = 0; i < n; ++i)
      to[i] = convert(from[static_cast<std::ptrdiff_t>(i) * stride]);
  }

  T convert(double value) {
    const T stored = static_cast<T>(in_range(value));
    if constexpr (std::is_same_v<T, float>)
      result_.float_overflows += std::isinf(stored) && std::isfinite(value);
    return stored;
  }

  // Only integers that an int32 can hold may stand in an integer label, those that a double holds
  // exactly in one of long integers.
  double in_range(double value) {
    if constexpr (std::is_integral_v<T>) {
      constexpr bool is_long = sizeof(T) > 4;
      constexpr double least = is_long ? -0x1p53 : -0x1p31, most = is_long ? 0x1p53 : 0x1p31 - 1;
      if (!(value >= least && value <= most && value == std::trunc(value)))
        throw PhysicsError(
            fmt::format("integer label {} of material {} holds {:.17g} in box {} of level {}: not "
                        "an integer of {} bits",
                        piece_.label.name(), piece_.material, value, piece_.box_id, piece_.level,
                        is_long ? 53 : 32));
    }
    return value;
  }

  void flush() {
    const std::size_t bytes = used_ * sizeof(T);
    result_.crc = crc32c(result_.crc, buffer_.data(), bytes);
    emit_(buffer_.data(), bytes);
    used_ = 0;
  }

  const FieldPiece& piece_;
  const std::function<void(const void*, std::size_t)>& emit_;
  std::vector<T> buffer_;
  std::size_t used_ = 0;
  GatherResult result_;
};

template <class T>
GatherResult gather_as(const FieldPiece& piece,
                       const std::function<void(const void*, std::size_t)>& emit) {
  const Loops loops = loops_of(piece);
  const double* first = piece.view.data + piece.view.offset(piece.cells.lower);
  Chunk<T> chunk(piece, emit);
  for (int k = 0; k < loops.count[2]; ++k)
    for (int j = 0; j < loops.count[1]; ++j)
      chunk.row(first + j * loops.stride[1] + k * loops.stride[2], loops.stride[0], loops.count[0]);
  return chunk.finish();
}

}  // namespace

GatherResult gather(const FieldPiece& piece, StoredType stored,
                    const std::function<void(const void*, std::size_t)>& emit) {
  if (piece.cells.empty()) return {};
  check_range(piece);
  switch (stored) {
    case StoredType::float64:
      return gather_as<double>(piece, emit);
    case StoredType::float32:
      return gather_as<float>(piece, emit);
    case StoredType::int32:
      return gather_as<std::int32_t>(piece, emit);
    case StoredType::int64:
      return gather_as<std::int64_t>(piece, emit);
    default:  // of raw files, which are only read
      break;
  }
  throw std::logic_error("archive: unknown stored type");
}

}  // namespace sluice
