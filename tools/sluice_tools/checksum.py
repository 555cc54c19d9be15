"""CRC-32C (Castagnoli), by which every byte of an archive is guarded; as src/framework/base/crc32c.

    crc32c(b"123456789")          0xe3069283
    crc32c_rows(bytes[n, size])   of n rows of bytes at once

NumPy has no such sum, and a loop over bytes in Python takes a microsecond for each. Rows are
therefore cut into many pieces whose sums advance together, byte by byte, and are then joined: the
sum is linear over GF(2), so that appending k zero bytes is a 32 x 32 matrix. About 10 ns a byte.
"""
import functools

import numpy as np

POLYNOMIAL = np.uint32(0x82F63B78)  # reflected
ALL_ONES = np.uint32(0xFFFFFFFF)
MAX_PIECES = 1 << 15  # together; more would leave the cache
MIN_PIECE = 64  # bytes


@functools.lru_cache(maxsize=1)
def _table():
    table = np.arange(256, dtype=np.uint32)
    for _ in range(8):
        table = np.where(table & 1, (table >> 1) ^ POLYNOMIAL, table >> 1).astype(np.uint32)
    return table


def _apply(matrix, sums):
    """The matrix (its columns as 32 numbers) times each of the sums."""
    result = np.zeros_like(sums)
    for bit in range(32):
        result ^= np.where(sums >> np.uint32(bit) & np.uint32(1), matrix[bit], np.uint32(0))
    return result


@functools.lru_cache(maxsize=256)
def _zeros(count):
    """The matrix by which a sum changes when so many zero bytes are appended."""
    if count == 0:
        return np.uint32(1) << np.arange(32, dtype=np.uint32)
    if count == 1:
        unit = np.uint32(1) << np.arange(32, dtype=np.uint32)
        return _table()[unit & np.uint32(255)] ^ unit >> np.uint32(8)
    half = _zeros(count // 2)
    matrix = _apply(half, half)
    return _apply(_zeros(1), matrix) if count % 2 else matrix


def crc32c_rows(rows):
    """Of each row of an array of bytes [n, size]: uint32 [n]."""
    count, size = rows.shape
    pieces = 1
    while 2 * pieces * count <= MAX_PIECES and size // (2 * pieces) >= MIN_PIECE:
        pieces *= 2
    length = -(-size // pieces)
    # Zero bytes in front of the first piece change nothing: sums begin at 0 here.
    padded = np.zeros((count, pieces * length), dtype=np.uint8)
    padded[:, pieces * length - size:] = rows
    columns = np.ascontiguousarray(padded.reshape(count * pieces, length).T)
    table, sums = _table(), np.zeros(count * pieces, dtype=np.uint32)
    for column in columns:
        sums = table[(sums ^ column) & np.uint32(255)] ^ sums >> np.uint32(8)
    sums = sums.reshape(count, pieces)
    while sums.shape[1] > 1:
        sums = _apply(_zeros(length), sums[:, 0::2]) ^ sums[:, 1::2]
        length *= 2
    return sums[:, 0] ^ _apply(_zeros(size), np.full(count, ALL_ONES)) ^ ALL_ONES


def crc32c(data):
    """Of bytes, or of the bytes of an array."""
    data = np.frombuffer(data, dtype=np.uint8) if not isinstance(data, np.ndarray) else data
    return int(crc32c_rows(data.reshape(1, -1).view(np.uint8))[0])
