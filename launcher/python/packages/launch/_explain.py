# SPDX-License-Identifier: Apache-2.0
"""Explains an exception of a launch file by one line and a place instead of a traceback."""

import difflib
import re
import sys
import sysconfig
import traceback
import types

from launch._places import is_own, resolve
from launch._values import LaunchFileError

_LIBRARIES = tuple({sysconfig.get_path(name) for name in ('stdlib', 'platstdlib', 'purelib', 'platlib')}) + (
    '/dist-packages/', '/site-packages/')


def _is_users(filename):
    return not is_own(filename) and not any(part in filename for part in _LIBRARIES)


def _place(trace):
    """The innermost place in the user's own files."""
    place = None
    while trace is not None:
        code = trace.tb_frame.f_code
        if _is_users(code.co_filename):
            place = resolve((code, trace.tb_lasti, trace.tb_lineno))
        trace = trace.tb_next
    return place


def _names_in(trace):
    names = set()
    while trace is not None:
        names.update(trace.tb_frame.f_globals, trace.tb_frame.f_locals)
        trace = trace.tb_next
    return names


def _help(error, trace):
    if isinstance(error, ModuleNotFoundError):
        top = (error.name or '').partition('.')[0]
        if top in _OWN:
            return f'this launcher has its own {top}, without that module'
        return f"install the Python package '{top}', or add its folder to PYTHONPATH"
    if isinstance(error, NameError):
        name = getattr(error, 'name', None)
        near = difflib.get_close_matches(name, _names_in(trace), 1) if name else []
        return f"did you mean '{near[0]}'?" if near else ''
    if isinstance(error, AttributeError) and getattr(error, 'name', None):
        near = difflib.get_close_matches(error.name, dir(error.obj), 1)
        return f"did you mean '{near[0]}'?" if near else ''
    return ''


_OWN = ('launch', 'launch_ros', 'launch_xml', 'launch_yaml', 'ament_index_python', 'tracetools_launch',
        'tracetools_trace')


def _unknown_name(error):
    """(module, name) if a package of the launcher lacks a name that was imported, otherwise None."""
    if isinstance(error, ImportError) and not isinstance(error, ModuleNotFoundError):
        found = re.match(r"cannot import name '([^']*)' from '([^']*)'", str(error))
        module, name = (found[2], found[1]) if found else (None, None)
    elif isinstance(error, AttributeError) and isinstance(error.obj, types.ModuleType):
        module, name = error.obj.__name__, error.name
    else:
        return None
    return (module, name) if module and module.partition('.')[0] in _OWN else None


def explain(error, trace, with_traceback):
    """(message, place, help, traceback, number of the launcher's exception)."""
    text = ''.join(traceback.format_exception(type(error), error, trace)) if with_traceback else ''
    number = getattr(error, '_number', None)
    place = getattr(error, 'of_element', None) or _place(trace) or getattr(error, 'place', None)
    if isinstance(error, LaunchFileError):
        return str(error), place, error.help, text, number
    if unknown := _unknown_name(error):
        module, name = unknown
        # Each class has a module of its own name as well, which nobody means.
        names = [known for known, value in getattr(sys.modules.get(module), '__dict__', {}).items() if not isinstance(value, types.ModuleType)]
        near = difflib.get_close_matches(name, names, 1)
        return (f"this launcher's {module} has no '{name}'", place, f"did you mean '{near[0]}'?" if near else '',
                text, number)
    if isinstance(error, SyntaxError) and error.filename and error.lineno:
        begin = max((error.offset or 1) - 1, 0)
        end = (error.end_offset or 0) - 1 if error.end_lineno == error.lineno else 0
        wrong = (error.filename, error.lineno, begin, end if end > begin else begin + 1)
        return f'{type(error).__name__}: {error.msg}', wrong, '', text, number
    if isinstance(error, SystemExit):
        return f'the launch file called sys.exit({error.code!r})', place, '', text, number
    if isinstance(error, KeyboardInterrupt) and not error.args:
        return 'interrupted by a signal', place, '', text, number
    message = str(error) or 'no message'
    if isinstance(error, KeyError) and len(error.args) == 1:
        message = repr(error.args[0])
    message = re.sub(r'\s*\n\s*', ' ', message)
    return f'{type(error).__name__}: {message}', place, _help(error, trace), text, number


