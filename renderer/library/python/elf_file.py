# SPDX-License-Identifier: MIT
"""Changes programs and shared libraries for a wheel: the libraries that they need, and where they look.

Names are changed in place, to names of the same length. ELF of 64 bits, little-endian.
"""
import re
import struct

NEEDED, STRTAB, SONAME, RPATH, RUNPATH = 1, 5, 14, 15, 29
LOAD, DYNAMIC = 1, 2


class ElfFile:
    """The bytes of one, to be read and changed."""

    def __init__(self, data):
        if data[:6] != b"\x7fELF\x02\x01":
            raise ValueError("must be an ELF file of 64 bits, little-endian")
        self.data = bytearray(data)
        first, = struct.unpack_from("<Q", data, 32)
        size, count = struct.unpack_from("<HH", data, 54)
        self._segments = [struct.unpack_from("<IIQQQQQQ", data, first + i * size) for i in range(count)]
        self._entries = []  # where each is in the file, its tag and its value
        for kind, _, offset, _, _, length, _, _ in self._segments:
            if kind == DYNAMIC:
                for at in range(offset, offset + length, 16):
                    tag, value = struct.unpack_from("<QQ", data, at)
                    if tag == 0:
                        break
                    self._entries.append((at, tag, value))
        self._strings = self._offset(next(value for _, tag, value in self._entries if tag == STRTAB))

    def _offset(self, address):
        for kind, _, offset, start, _, length, _, _ in self._segments:
            if kind == LOAD and start <= address < start + length:
                return offset + address - start
        raise ValueError("has a table that is in no segment")

    def _text(self, value):
        begin = self._strings + value
        return self.data[begin:self.data.index(0, begin)].decode()

    def needed(self):
        """The names of the libraries that it needs."""
        return [self._text(value) for _, tag, value in self._entries if tag == NEEDED]

    def rename(self, names):
        """Changes its own name and those that it needs, by a dict; of the same lengths."""
        for _, tag, value in self._entries:
            if tag in (NEEDED, SONAME) and (old := self._text(value)) in names:
                new = names[old].encode()
                assert len(new) == len(old.encode())
                begin = self._strings + value
                self.data[begin:begin + len(new)] = new

    def has_path(self):
        return any(tag in (RPATH, RUNPATH) for _, tag, _ in self._entries)

    def set_path(self, path):
        """Where it looks for libraries, and where those look that it needs: an RPATH, not a RUNPATH."""
        for at, tag, value in self._entries:
            if tag in (RPATH, RUNPATH):
                room, begin = len(self._text(value)), self._strings + value
                if len(path) > room:
                    raise ValueError(f"has room for a path of {room} characters (got {path})")
                self.data[begin:begin + room] = path.encode().ljust(room, b"\0")
                struct.pack_into("<Q", self.data, at, RPATH)

    def versions(self, name):
        """The versions of a library's symbols that are named in it, such as (2, 34) of GLIBC."""
        found = re.findall(rb"\0" + name.encode() + rb"_([0-9.]+)(?=\0)", bytes(self.data))
        return [tuple(int(part) for part in text.split(b".")) for text in found]
