# SPDX-License-Identifier: Apache-2.0
"""Reads the text of .msg, .srv and .action files.

A line is `type name [default]`, `type NAME=value`, a comment, or `---` between the request and response of a service,
and between the goal, result and feedback of an action.
A type is a primitive, `Name`, `package/Name` or `package/msg/Name`. Strings may have a bound `<=N`. `[]`, `[N]` or
`[<=N]` at the end means many elements.
"""

import difflib
import re
from typing import Any, Callable, Collection, List, Optional, Tuple

from .interface_definition import Constant, Field, InterfaceFile, Message, Service, Type, action_file

INTEGER_BITS = {'byte': (0, 8), 'char': (0, 8), 'int8': (1, 8), 'uint8': (0, 8), 'int16': (1, 16), 'uint16': (0, 16),
                'int32': (1, 32), 'uint32': (0, 32), 'int64': (1, 64), 'uint64': (0, 64)}
PRIMITIVES = (*INTEGER_BITS, 'bool', 'float32', 'float64', 'string', 'wstring')

TYPE = re.compile(r'(?P<base>[A-Za-z][\w/]*)(?P<bound><=\d*)?(?P<array>\[[^\]]*\]?)?')
ARRAY = re.compile(r'\[(?P<bounded><=)?(?P<size>\d*)\]')
FIELD_NAME = re.compile(r'(?!.*__)[a-z]([a-z0-9_]*[a-z0-9])?')
CONSTANT_NAME = re.compile(r'(?!.*__)[A-Z]([A-Z0-9_]*[A-Z0-9])?')
MESSAGE_NAME = re.compile(r'[A-Z][A-Za-z0-9]*')
PACKAGE_NAME = re.compile(r'(?!.*__)[a-z]([a-z0-9_]*[a-z0-9])?')
PARTS = {'msg': (), 'srv': ('Request', 'Response'), 'action': ('Goal', 'Result', 'Feedback')}
TOO_MANY_PARTS = {'msg': "a .msg file has no '---'", 'srv': "only a .srv file has '---', and only one",
                  'action': "an .action file has two '---'"}
# Types that a file uses implicitly.
IMPLIED = {'msg': ('a message', ()), 'srv': ('a service', ('service_msgs/msg/ServiceEventInfo',)),
           'action': ('an action', ('unique_identifier_msgs/msg/UUID', 'builtin_interfaces/msg/Time',
                                    'service_msgs/msg/ServiceEventInfo'))}
ESCAPES = {'n': '\n', 't': '\t', 'r': '\r', '\\': '\\', '"': '"', "'": "'"}


class InterfaceError(Exception):
    """An error in an interface file. Its text points at the position."""

    def __init__(self, path: str, line_number: int, column: int, line: str, what: str):
        place = f'{path}:{line_number}:{column + 1}'
        pointer = ''.join('\t' if c == '\t' else ' ' for c in line[:column]) + '^'
        super().__init__(f'{place}: error: {what}\n  {line}\n  {pointer}')


def parse_file(path: str, text: str, package: str, namespace: str, known_types: Collection[str]) -> InterfaceFile:
    """Parses one file.

    `known_types` are the messages it may use, for example 'std_msgs/msg/Header', including those of `package`.
    """
    name = re.sub(r'.*/|\.\w+$', '', path)
    lines = text.splitlines()
    if not MESSAGE_NAME.fullmatch(name):
        raise InterfaceError(path, 1, 0, lines[0] if lines else '',
                             f"'{name}' is not a type name: it must be letters and digits, starting with a capital")
    names = [f'{name}_{part}' for part in PARTS[namespace]] or [name]
    parts = [Message(package, namespace, part) for part in names]
    part = 0
    for number, line in enumerate(lines, start=1):
        def error(column: int, what: str) -> InterfaceError:
            return InterfaceError(path, number, column, line, what)

        if line.strip() == '---':
            part += 1
            if part == len(parts):
                raise error(line.index('-'), TOO_MANY_PARTS[namespace])
            continue
        _parse_line(_Line(line, error), parts[part], known_types)
    if part + 1 < len(parts):
        raise InterfaceError(path, max(len(lines), 1), 0, lines[-1] if lines else '',
                             "no '---' between the {} and the {}".format(*PARTS[namespace][part:part + 2]).lower())
    kind, implied = IMPLIED[namespace]
    for used in implied:
        if used not in known_types:
            raise InterfaceError(path, 1, 0, lines[0] if lines else '',
                                 f"{kind} uses {used}: name '{used.split('/')[0]}' among the DEPENDENCIES of "
                                 'rosidl_generate_interfaces')
    if namespace == 'action':
        return action_file(package, name, *parts)
    if namespace == 'srv':
        service = Service(package, namespace, name, *parts)
        return InterfaceFile(package, namespace, name, service.messages, [service])
    return InterfaceFile(package, namespace, name, parts)


class _Line:
    """A line without its comment, and the current read position."""

    def __init__(self, text: str, error: Callable[[int, str], InterfaceError]):
        self.text = _without_comment(text)
        self.position = 0
        self.error = error
        self.skip_spaces()

    def skip_spaces(self) -> None:
        while self.position < len(self.text) and self.text[self.position].isspace():
            self.position += 1

    @property
    def rest(self) -> str:
        return self.text[self.position:].rstrip()

    def take(self, pattern: 're.Pattern[str]') -> Optional['re.Match[str]']:
        match = pattern.match(self.text, self.position)
        if match:
            self.position = match.end()
        return match


def _without_comment(text: str) -> str:
    quote = ''
    escaped = False
    for index, character in enumerate(text):
        if escaped:
            escaped = False
        elif quote:
            escaped = character == '\\'
            quote = '' if character == quote else quote
        elif character == '#':
            return text[:index]
        elif character in '"\'' and text[index - 1:index] in ('', ' ', '\t', '=', ',', '['):
            quote = character  # an apostrophe inside a word is no quote
    return text


def _parse_line(line: _Line, message: Message, known_types: Collection[str]) -> None:
    if not line.rest:
        return
    type_ = _parse_type(line, message, known_types)
    line.skip_spaces()
    name_column = line.position
    name = line.take(re.compile(r'[^\s=]+'))
    if not name:
        raise line.error(name_column, 'the name is missing: a line is `type name` or `type NAME=value`')
    line.skip_spaces()
    used = {m.name for m in (*message.fields, *message.constants)}
    if name.group() in used:
        raise line.error(name_column, f"there is already a member '{name.group()}'")
    if line.take(re.compile('=')):
        line.skip_spaces()
        message.constants.append(Constant(type_, _constant_name(line, name_column, name.group(), type_),
                                          _parse_value(line, type_)))
        return
    if not FIELD_NAME.fullmatch(name.group()):
        raise line.error(name_column, f"'{name.group()}' is not a field name: it must be lower case letters, digits "
                         'and single underscores, starting with a letter')
    default = None
    if line.rest:
        if type_.is_message:
            raise line.error(line.position, 'a message cannot have a default')
        default = _parse_array(line, type_) if type_.is_array or type_.is_sequence else _parse_value(line, type_)
    message.fields.append(Field(type_, name.group(), default))


def _constant_name(line: _Line, column: int, name: str, type_: Type) -> str:
    if type_.is_message or type_.is_array or type_.is_sequence:
        raise line.error(column, 'a constant must be a single primitive')
    if not CONSTANT_NAME.fullmatch(name):
        raise line.error(column, f"'{name}' is not a constant name: it must be capitals, digits and single "
                         'underscores, starting with a letter')
    if not line.rest and not type_.is_string:
        raise line.error(line.position, 'the value is missing')
    return name


def _parse_type(line: _Line, message: Message, known_types: Collection[str]) -> Type:
    start = line.position
    match = line.take(TYPE)
    if not match or line.text[line.position:line.position + 1].strip():
        raise line.error(start, f"'{line.text[start:].split()[0]}' is not a type")
    base, bound, array = match.group('base', 'bound', 'array')
    package, name = None, base
    if base not in PRIMITIVES:
        package, name = _resolve(line, start, base, message, known_types)
    string_bound = None
    if bound is not None:
        if base not in ('string', 'wstring'):
            raise line.error(match.start('bound'), f"only strings have a bound here; for many write '{base}[{bound}]'")
        string_bound = _positive(line, match.start('bound') + 2, bound[2:])
    if array is None:
        return Type(name, package, string_bound)
    size = ARRAY.fullmatch(array)
    if not size or (size.group('bounded') and not size.group('size')):
        raise line.error(match.start('array'), f"'{array}' is not an array: write [], [N] or [<=N]")
    if not size.group('size'):
        return Type(name, package, string_bound, is_sequence=True)
    count = _positive(line, match.start('array') + size.start('size'), size.group('size'))
    if size.group('bounded'):
        return Type(name, package, string_bound, is_sequence=True, sequence_bound=count)
    return Type(name, package, string_bound, array_size=count)


def _positive(line: _Line, column: int, digits: str) -> int:
    if not digits or int(digits) == 0:
        raise line.error(column, 'the size must be a number above 0')
    return int(digits)


def _resolve(line: _Line, column: int, base: str, message: Message, known_types: Collection[str]) -> Tuple[str, str]:
    parts = base.split('/')
    if len(parts) == 1:
        full = f'{message.package}/msg/{base}'
    elif len(parts) == 2:
        full = f'{parts[0]}/msg/{parts[1]}'
    else:
        full = base
    if full in known_types:
        package, _, name = full.split('/')
        return package, name
    known_packages = {known.split('/')[0] for known in known_types} | {message.package}
    package = full.split('/')[0]
    if len(parts) > 1 and package not in known_packages and PACKAGE_NAME.fullmatch(package):
        raise line.error(column, f"package '{package}' is not among the DEPENDENCIES of rosidl_generate_interfaces")
    raise line.error(column, f"unknown type '{base}'{_suggestion(base, message.package, known_types)}")


def _suggestion(base: str, package: str, known_types: Collection[str]) -> str:
    def spelling(full: str) -> str:
        owner, _, name = full.split('/')
        return name if owner == package else f'{owner}/{name}'

    def last(name: str) -> str:
        return name.split('/')[-1].lower()

    same = [spelling(known) for known in sorted(known_types) if last(known) == last(base)]
    near = difflib.get_close_matches(base, [*PRIMITIVES, *(spelling(known) for known in sorted(known_types))], n=1)
    return f", did you mean '{(same or near)[0]}'?" if same or near else ''


def _parse_array(line: _Line, type_: Type) -> List[Any]:
    start = line.position
    text = line.rest
    if not (text.startswith('[') and text.endswith(']')):
        raise line.error(start, 'the default of an array is a list: [1, 2, 3]')
    values = [_convert(line, column, token, type_)
              for column, token in _list_items(line, start + 1, start + len(text) - 1)]
    if type_.is_array and len(values) != type_.array_size:
        raise line.error(start, f'{len(values)} values for an array of {type_.array_size}')
    if type_.sequence_bound is not None and len(values) > type_.sequence_bound:
        raise line.error(start, f'{len(values)} values for a sequence of at most {type_.sequence_bound}')
    return values


def _list_items(line: _Line, begin: int, end: int) -> List[Tuple[int, str]]:
    """Column and text of each item between the brackets. Commas in quotes do not separate items."""
    item = re.compile(r'''\s*("(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*'|[^,'"]*)\s*(,|$)''')
    items: List[Tuple[int, str]] = []
    position = begin
    while position < end:
        match = item.match(line.text[:end], position)
        if not match or not match.group(1).strip():
            raise line.error(position, 'a value is missing, or a quote is not closed')
        items.append((match.start(1), match.group(1).strip()))
        position = match.end()
    return items


def _parse_value(line: _Line, type_: Type) -> Any:
    return _convert(line, line.position, line.rest, type_)


def _convert(line: _Line, column: int, token: str, type_: Type) -> Any:
    if type_.is_string:
        return _string(line, column, token, type_)
    if type_.name == 'bool':
        if token.lower() not in ('true', 'false', '1', '0'):
            raise line.error(column, f"'{token}' is not a bool: write true or false")
        return token.lower() in ('true', '1')
    if type_.name in ('float32', 'float64'):
        try:
            return float(token)
        except ValueError:
            raise line.error(column, f"'{token}' is not a number") from None
    try:
        value = int(token, 0)
    except ValueError:
        raise line.error(column, f"'{token}' is not an integer") from None
    signed, bits = INTEGER_BITS[type_.name]
    low, high = (-(1 << (bits - 1)), (1 << (bits - 1)) - 1) if signed else (0, (1 << bits) - 1)
    if not low <= value <= high:
        raise line.error(column, f'{value} does not fit {type_.name}, which goes from {low} to {high}')
    return value


def _string(line: _Line, column: int, token: str, type_: Type) -> str:
    if token[:1] in ('"', "'"):
        if len(token) < 2 or token[-1] != token[0]:
            raise line.error(column, f'the string is not closed by {token[0]}')
        token = re.sub(r'\\(.)', lambda escape: ESCAPES.get(escape.group(1), escape.group()), token[1:-1])
    if type_.string_bound is not None and len(token) > type_.string_bound:
        raise line.error(column, f'{len(token)} characters for a string of at most {type_.string_bound}')
    return token
