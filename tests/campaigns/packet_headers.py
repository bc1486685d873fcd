# SPDX-License-Identifier: Apache-2.0
"""
The packets of a trace as LTTng 2.13 writes them, read without any reader of this project.

The headers have the same shape in all user-space streams: magic number, UUID, stream class and stream instance, then the
context of the packet. Bytes are in the order of this machine, numbers are not aligned.
"""

import re
import struct
from dataclasses import dataclass
from pathlib import Path

_HEADER = struct.Struct('<I16sIQQQQQQQI')
_MAGIC = 0xC1FC1FC1


@dataclass(frozen=True)
class Packet:
    begin: int
    end: int
    bytes: int
    number: int
    discarded: int  # in the stream, until its end
    cpu: int


def packets_in(file):
    """The packets of one file of a stream. The last one may be there in part; it is left out."""
    data = Path(file).read_bytes()
    at, packets = 0, []
    while at + _HEADER.size <= len(data):
        magic, _, _, _, begin, end, content, size, number, discarded, cpu = _HEADER.unpack_from(data, at)
        if magic != _MAGIC:
            raise ValueError(f'{file}: no packet begins at byte {at}')
        if size == 0 or at + size // 8 > len(data):
            break
        packets.append(Packet(begin, end, content // 8, number, discarded, cpu))
        at += size // 8
    return packets


@dataclass
class Stream:
    channel: str
    cpu: int
    process: str    # the folder of a process with buffers of its own; '' for shared ones
    packets: list   # in the order of their numbers

    @property
    def earlier_packets(self):
        return self.packets[0].number if self.packets else 0

    @property
    def earlier_discarded(self):
        return self.packets[0].discarded if self.earlier_packets else 0

    @property
    def discarded(self):
        """A total that goes back is a mistake of LTTng: the highest one counts."""
        return max((packet.discarded for packet in self.packets), default=0) - self.earlier_discarded

    @property
    def lost_packets(self):
        numbers = [packet.number for packet in self.packets]
        return sum(after - before - 1 for before, after in zip(numbers, numbers[1:]))


def streams_in(directory, channels):
    """The user-space streams of these channels in a recording."""
    found = {}
    for channel in channels:
        name = re.compile(re.escape(channel) + r'_(\d+)(_\d+)?$')
        for file in sorted(Path(directory).glob('**/ust/**/*')):
            match = name.match(file.name)
            if match is None or file.parent.name == 'index' or 'unreadable' in file.parts:
                continue
            folder = file.parent
            process = '' if 'uid' in folder.parts else str(folder)
            found.setdefault((channel, int(match[1]), process), []).extend(packets_in(file))
    return [Stream(*key, sorted(packets, key=lambda packet: packet.number)) for key, packets in found.items()]
