# SPDX-License-Identifier: Apache-2.0
"""
Where in a launch file something is: (file, line, first byte, end byte).

The instruction that makes an object tells the position of the call. The syntax tree of the file tells where the called
name and the arguments are; it is read when the first place of the file is asked for.
"""

import _ast  # the module ast would take 2 ms to load
import os
import sys

_OWN_PACKAGES = os.path.dirname(os.path.dirname(os.path.abspath(__file__))) + os.sep

_sources = {}
_element = None  # the place of the element of XML or YAML for which objects are being made
_positions = {}
_calls = {}


def note_source(filename, source):
    """The text of a launch file, as it was read."""
    _sources[filename] = source
    _calls.pop(filename, None)


def is_own(filename):
    return filename.startswith(_OWN_PACKAGES) or filename.startswith('<')


def name_of_function(function):
    """The name of a function; None for one of these packages."""
    code = getattr(function, '__code__', None)
    if code is not None and code.co_filename.startswith(_OWN_PACKAGES):
        return None
    return getattr(function, '__qualname__', None) or type(function).__name__


class of_element:  # noqa: N801  as contextlib has it
    """Objects that are made in the block have this place, and not that of the instruction that makes them."""

    def __init__(self, place):
        self._place = place

    def __enter__(self):
        global _element
        self._outer, _element = _element, _Fixed(self._place)

    def __exit__(self, *_error):
        global _element
        _element = self._outer
        return False


class _Fixed:
    """Stands for an instruction whose place is known already."""

    def __init__(self, place):
        self.place = place


def caller():
    """The instruction outside these packages that is being executed."""
    if _element is not None:
        return _element
    frame = sys._getframe(2)
    while frame is not None and is_own(frame.f_code.co_filename):
        frame = frame.f_back
    return None if frame is None else (frame.f_code, frame.f_lasti, frame.f_lineno)


def resolve(instruction):
    """The place of an instruction; only its line when the interpreter doesn't tell more."""
    if instruction is None or isinstance(instruction, _Fixed):
        return instruction and instruction.place
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
    """The first line of a function; None for a function that isn't written in Python."""
    code = getattr(function, '__code__', None)
    return code and (code.co_filename, code.co_firstlineno, 0, 0)


def _call_at(place):
    """The syntax of the call at a place, or None."""
    filename = place[0]
    calls = _calls.get(filename)
    if calls is None:
        calls = _calls[filename] = {}
        try:
            source = _sources.get(filename)
            if source is None:
                with open(filename, 'rb') as file:
                    source = file.read()
            # Inner calls that begin where outer calls do, as in a().b(), come later.
            waiting = [compile(source, filename, 'exec', _ast.PyCF_ONLY_AST, dont_inherit=True)]
            for node in waiting:
                if isinstance(node, _ast.Call):
                    calls.setdefault((node.lineno, node.col_offset), node)
                for field in node._fields:
                    value = getattr(node, field, None)
                    waiting += [each for each in (value if isinstance(value, list) else (value,))
                                if isinstance(each, _ast.AST)]
        except (OSError, SyntaxError, ValueError):
            pass
    return calls.get(place[1:3])


def _of_node(filename, node):
    return filename, node.lineno, node.col_offset, node.end_col_offset if node.end_lineno == node.lineno else 1 << 30


class Located:
    """An object that remembers where it was made."""

    def __new__(cls, *_args, **_kwargs):
        self = object.__new__(cls)
        self._made_at = caller()
        return self

    def _place(self):
        """The place of the class name in the call that made it."""
        place = resolve(self._made_at)
        call = place and _call_at(place)
        if call is None or call.func.end_lineno != call.lineno:
            return place
        return place[:3] + (call.func.end_col_offset,)

    def _place_of(self, argument):
        """The place of the argument of that name in the call that made it; None when it is not known."""
        place = resolve(self._made_at)
        call = place and _call_at(place)
        if call is None:
            return None
        for keyword in call.keywords:
            if keyword.arg == argument:
                return _of_node(place[0], keyword.value)
        code = type(self).__init__.__code__
        names = code.co_varnames[1:code.co_argcount]
        if argument in names:
            index = names.index(argument)
            if index < len(call.args) and not any(type(arg).__name__ == 'Starred' for arg in call.args[:index + 1]):
                return _of_node(place[0], call.args[index])
        return None
