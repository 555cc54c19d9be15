// From strided memory to the stored bytes of a piece, one cache-sized chunk after the other.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>

#include "framework/archive/archive_record.hpp"
#include "framework/archive/field_piece.hpp"

namespace sluice {

// Chunks fit the second-level cache, where summing and writing find them again.
inline constexpr std::size_t gather_chunk_bytes = 256 * 1024;

struct GatherResult {
  std::uint32_t crc = 0;
  std::int64_t float_overflows = 0;
};

// Calls `emit(bytes, count)` with successive chunks of the piece as stored (x fastest, no ghosts).
// PhysicsError where an integer label holds no integer, std::logic_error for a piece that reaches
// outside its view.
GatherResult gather(const FieldPiece& piece, StoredType stored,
                    const std::function<void(const void*, std::size_t)>& emit);

}  // namespace sluice
