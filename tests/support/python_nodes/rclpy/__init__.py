# SPDX-License-Identifier: Apache-2.0
"""Has the shape of rclpy, as far as its callbacks go. What rcl would record is recorded here, with addresses of real memory."""

import ctypes

# A node's own library: other libraries do not see its functions.
tracetools = ctypes.CDLL('libtracetools.so')


class Handle:
    """As of _rclpy: `pointer` is the address of the object of rcl."""

    def __init__(self):
        self.memory = ctypes.create_string_buffer(64)
        self.pointer = ctypes.addressof(self.memory)


def record(event, *fields):
    kinds = {int: ctypes.c_void_p, bytes: ctypes.c_char_p}
    getattr(tracetools, 'ros_trace_' + event)(*(kinds[type(field)](field) for field in fields))
