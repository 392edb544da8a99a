"""Check of .mat files of version 5 to 7: scipy reads beyond its memory where sizes contradict.

MAT-File Format, MathWorks: a header of 128 bytes, then elements, each a tag (type, bytes) with its
data. A matrix holds elements itself: flags, dimensions, name, and data by its class.
"""

from __future__ import annotations

import math
import struct
import zlib

#: Most bytes of a file, unpacked: 10^8 numbers.
LARGEST = 1_000_000_000
_HEADER = 128
_MATRIX, _COMPRESSED = 14, 15
#: Bytes of a number by the type of its element.
_SIZES = {1: 1, 2: 1, 3: 2, 4: 2, 5: 4, 6: 4, 7: 4, 9: 8, 12: 8, 13: 8}
_CELL, _STRUCT, _OBJECT, _CHAR, _SPARSE, _FUNCTION, _OPAQUE = 1, 2, 3, 4, 5, 16, 17
#: Fewest and most bytes of a character by the type of its element.
_CHARACTERS = {1: (1, 1), 2: (1, 1), 4: (2, 2), 16: (1, 4), 17: (2, 4), 18: (4, 4)}
_NUMERIC = range(6, 16)  # classes, double to uint64


def check(data: bytes) -> None:
    """Refuse a file whose elements contradict each other; other versions pass.

    Raises
    ------
    ValueError
        An element is larger than what it is in, or not as large as its dimensions say.
    """
    order = {b"\0\1IM": "<", b"\1\0MI": ">"}.get(data[124:128])
    if order is None or data[:4].count(0):  # version 4 has zeros there, 7.3 another number
        return
    at, total = _HEADER, len(data)
    while at < len(data):
        elements = _Elements(data, order)
        kind, begin, end, at = elements.tag(at, len(data), packed=True)
        if kind == _COMPRESSED:
            unpacker = zlib.decompressobj()
            try:
                unpacked = unpacker.decompress(data[begin:end], LARGEST + 1)
            except zlib.error as error:
                raise ValueError(f"at byte {begin}: {error}") from None
            total += len(unpacked)
            if total > LARGEST:
                raise ValueError(f"more than {LARGEST} bytes, unpacked")
            elements = _Elements(unpacked, order)
            kind, begin, end, _ = elements.tag(0, len(unpacked))
        if kind == _MATRIX and begin < end:
            elements.matrix(begin, end)


class _Elements:
    """Elements of a piece of a file; `order` is that of the bytes, as `struct` has it."""

    def __init__(self, data: bytes, order: str) -> None:
        self.data, self.order = data, order

    def tag(self, at: int, limit: int, packed: bool = False) -> tuple[int, int, int, int]:
        """Type of the element at a place, where its data begin and end, and the next place."""
        if at + 8 > limit:
            raise ValueError(f"it ends within a tag, at byte {at}")
        kind, size = struct.unpack_from(f"{self.order}II", self.data, at)
        begin = at + 8
        following = begin + (size if packed and kind == _COMPRESSED else -(-size // 8) * 8)
        if kind >> 16:  # up to four bytes stand in the tag
            kind, size, begin, following = kind & 0xFFFF, kind >> 16, at + 4, at + 8
        if begin + size > limit or (begin == at + 4 and size > 4):
            raise ValueError(f"an element of {size} bytes at byte {at} is larger than its place")
        return kind, begin, begin + size, following

    def numbers(self, at: int, limit: int) -> tuple[list[int], int]:
        """Whole numbers of four bytes of an element, and the next place."""
        _, begin, end, following = self.tag(at, limit)
        count = (end - begin) // 4
        return list(struct.unpack_from(f"{self.order}{count}i", self.data, begin)), following

    def matrix(self, at: int, limit: int) -> None:
        """Check a matrix and all that it holds."""
        flags, at = self.numbers(at, limit)
        if flags and flags[0] & 0xFF == _OPAQUE:
            for _ in range(3):  # names
                at = self.tag(at, limit)[3]
            return self.matrices(1, at, limit)
        shape, at = self.numbers(at, limit)
        at = self.tag(at, limit)[3]  # its name
        if not flags or len(shape) < 2 or min(shape) < 0:
            raise ValueError(f"a matrix without its class and shape, up to byte {at}")
        kind, count = flags[0] & 0xFF, math.prod(shape)
        if kind in _NUMERIC:
            for _ in range(2 if flags[0] & 0x800 else 1):
                of, begin, end, at = self.tag(at, limit)
                if end - begin != count * _SIZES.get(of, -1):
                    raise ValueError(f"{end - begin} bytes at byte {begin} for {count} numbers")
        if kind == _CHAR:
            of, begin, end, at = self.tag(at, limit)
            least, most = _CHARACTERS.get(of, (1, 0))
            if end > begin and not count * least <= end - begin <= count * most:
                raise ValueError(f"{end - begin} bytes at byte {begin} for {count} characters")
        if kind == _SPARSE:
            rows, at = self.numbers(at, limit)
            columns, at = self.numbers(at, limit)
            if len(columns) != shape[1] + 1 or columns[-1] > len(rows):
                raise ValueError(f"indices of a sparse matrix that do not fit, up to byte {at}")
        if kind == _OBJECT:
            at = self.tag(at, limit)[3]  # the name of its class
        if kind in (_STRUCT, _OBJECT):
            lengths, at = self.numbers(at, limit)
            _, begin, end, at = self.tag(at, limit)
            count *= (end - begin) // lengths[0] if lengths and lengths[0] > 0 else 0
        if kind == _FUNCTION:
            count = 1
        if kind in (_CELL, _STRUCT, _OBJECT, _FUNCTION):
            self.matrices(count, at, limit)

    def matrices(self, count: int, at: int, limit: int) -> None:
        """Check matrices one behind the other."""
        for _ in range(count):
            of, begin, end, at = self.tag(at, limit)
            if of != _MATRIX:
                raise ValueError(f"an element of type {of} in place of a matrix, up to byte {end}")
            if begin < end:
                self.matrix(begin, end)
