"""Where in a launch file an object was made."""

import os
import sys

_OWN_PACKAGES = os.path.dirname(os.path.dirname(os.path.abspath(__file__))) + os.sep

_positions = {}


def is_own(filename):
    return filename.startswith(_OWN_PACKAGES) or filename.startswith('<')


def caller():
    """The instruction outside these packages that is being executed."""
    frame = sys._getframe(2)
    while frame is not None and is_own(frame.f_code.co_filename):
        frame = frame.f_back
    return None if frame is None else (frame.f_code, frame.f_lasti, frame.f_lineno)


def resolve(instruction):
    """(file, line, first byte, end byte) of an instruction; 0 and 0 when only the line is known."""
    if instruction is None:
        return None
    code, offset, line = instruction
    if hasattr(code, 'co_positions'):
        positions = _positions.get(code)
        if positions is None:
            positions = _positions[code] = list(code.co_positions())
        first, last, begin, end = positions[offset // 2]
        if first is not None and begin is not None:
            return code.co_filename, first, begin, end if last == first else 1 << 30
    return code.co_filename, line, 0, 0


def of_function(function):
    """The first line of a function; None for what isn't written in Python."""
    code = getattr(function, '__code__', None)
    return code and (code.co_filename, code.co_firstlineno, 0, 0)


class Located:
    """Remembers where it was made."""

    def __new__(cls, *_args, **_kwargs):
        self = object.__new__(cls)
        self._made_at = caller()
        return self

    def _place(self):
        return resolve(self._made_at)
