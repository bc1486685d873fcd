# SPDX-License-Identifier: Apache-2.0
"""The files of a trace."""

import struct


def packet_ends(index):
    """Where the packets of a stream end, but for the last one, by its index (version 1 of LTTng's format)."""
    content = index.read_bytes()
    (length,) = struct.unpack_from('>I', content, 12)
    ends = []
    for at in range(16, len(content) - length + 1, length):
        offset, bits = struct.unpack_from('>QQ', content, at)
        ends.append(offset + bits // 8)
    return ends[:-1]
