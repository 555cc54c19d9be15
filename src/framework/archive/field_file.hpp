// One rank's field data of one step: an HDF5 file and the record that guards it.
//
// Group /lL/LABEL/mM (level, label, material) holds
//   boxes   int32  [n][6]   lower and upper index of each box (upper exclusive)
//   values  float64|float32|int32 [sum of sizes], box after box, component after component,
//           x fastest, then y, then z
//   crc32c  uint32 [n][components], of the stored bytes of each box and component
// and attributes type, centring, unit. HDF5 lays the file out; the values themselves are gathered
// from memory, summed and written in pieces that stay in the cache, past HDF5 (compressed ones
// through it). Every byte that is not a value is guarded by the CRC in pNNNNN.xml, so that a reader
// trusts HDF5's structures only when they are as written.
#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "framework/archive/archive_record.hpp"
#include "framework/archive/field_piece.hpp"

namespace sluice {

struct StorageOptions {
  bool doubles_as_float = false;
};

struct FieldFileResult {
  DataFileRecord record;
  std::int64_t float_overflows = 0;  // finite doubles that no float can hold: stored as infinity
};

// Bytes of the values that writing these pieces takes, uncompressed.
std::int64_t stored_bytes(std::span<const FieldPiece> pieces, const StorageOptions& options);

// Writes folder/pNNNNN.h5, flushed, and folder/pNNNNN.xml, not flushed. Throws SystemError; the
// caller removes the folder then.
FieldFileResult write_field_file(const std::filesystem::path& folder, int rank,
                                 std::span<const FieldPiece> pieces, const StorageOptions& options);

// CRC-32C of every byte of the file outside the values of `record.variables`.
std::uint32_t metadata_checksum(const std::filesystem::path& file, const DataFileRecord& record);

}  // namespace sluice
