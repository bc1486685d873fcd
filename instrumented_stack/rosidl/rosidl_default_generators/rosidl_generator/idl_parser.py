# SPDX-License-Identifier: Apache-2.0
"""Reads the text of .idl files: the part of OMG IDL 4.2 that ROS 2 uses.

A file has `module <package> { module <msg|srv|action> { … }; };`, in it one struct (a message), or the structs of a
service or action (`X_Request`, `X_Response`; `X_Goal`, `X_Result`, `X_Feedback`), `typedef`s, and modules `X_Constants`.
`@default (value=…)` gives a default; other annotations have no effect on the types.
"""

import ast
import re
from typing import Callable, Collection, Dict, List, Optional, Tuple

from .interface_definition import Constant, Field, InterfaceFile, Message, Service, Type, action_file
from .interface_parser import IMPLIED, INTEGER_BITS, PARTS, InterfaceError

TOKEN = re.compile(r'''(?P<skip>\s+|//[^\n]*|/\*.*?\*/|\#[^\n]*)|(?P<text>L?"(?:\\.|[^"\\])*"|L?'(?:\\.|[^'\\])*')
                       |(?P<number>(?:0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)[dD]?)
                       |(?P<name>[A-Za-z_]\w*)|(?P<sign>::|<<|>>|[-+*/%|&^~{}()\[\]<>;,=@.])|(?P<other>.)''',
                   re.DOTALL | re.VERBOSE)
# Longest first, because types may have several words.
WORDS = {'unsigned long long': 'uint64', 'unsigned long': 'uint32', 'unsigned short': 'uint16', 'long long': 'int64',
         'long': 'int32', 'short': 'int16', 'boolean': 'bool', 'octet': 'byte', 'float': 'float32', 'double': 'float64',
         'char': 'idl_char', 'int8': 'int8', 'uint8': 'uint8', 'int16': 'int16', 'uint16': 'uint16', 'int32': 'int32',
         'uint32': 'uint32', 'int64': 'int64', 'uint64': 'uint64'}


class _Token:
    def __init__(self, kind: str, text: str, position: int):
        self.kind, self.text, self.position = kind, text, position


class _Reader:
    """The tokens of a file, and the current one."""

    def __init__(self, path: str, text: str):
        self._path, self._text, self._next = path, text, 0
        self._tokens: List[_Token] = []
        for match in TOKEN.finditer(text):
            kind = match.lastgroup or ''
            if kind == 'other':
                raise self.error(_Token(kind, match.group(), match.start()), f"'{match.group()}' has no meaning here")
            if kind != 'skip':
                self._tokens.append(_Token(kind, match.group(), match.start()))
        self._tokens.append(_Token('end', 'the end of the file', len(text)))

    def error(self, token: _Token, what: str) -> InterfaceError:
        begin = self._text.rfind('\n', 0, token.position) + 1
        number = self._text.count('\n', 0, token.position) + 1
        line = self._text[begin:].split('\n', 1)[0]
        return InterfaceError(self._path, number, token.position - begin, line, what)

    @property
    def token(self) -> _Token:
        return self._tokens[self._next]

    def take(self) -> _Token:
        token = self.token
        self._next += token.kind != 'end'
        return token

    def accept(self, text: str) -> bool:
        if text == '>' and self.token.text == '>>':  # the end of two types: one of the signs stays
            self._tokens[self._next] = _Token('sign', '>', self.token.position + 1)
            return True
        found = self.token.text == text and self.token.kind in ('name', 'sign')
        if found:
            self._next += 1
        return found

    def expect(self, text: str) -> None:
        if not self.accept(text):
            raise self.error(self.token, f"expected '{text}' and not '{self.token.text}'")

    def name(self) -> _Token:
        if self.token.kind != 'name':
            raise self.error(self.token, f"expected a name and not '{self.token.text}'")
        return self.take()


def parse_idl(path: str, text: str, package: str, namespace: str, known_types: Collection[str]) -> InterfaceFile:
    """Parses one file. `known_types` are the messages that it may use, including those of `package`."""
    return _IdlParser(path, text, package, namespace, known_types).parse()


class _IdlParser:
    def __init__(self, path: str, text: str, package: str, namespace: str, known_types: Collection[str]):
        self._in = _Reader(path, text)
        self._package, self._namespace, self._known = package, namespace, known_types
        self._name = re.sub(r'.*/|\.\w+$', '', path)
        self._structs: Dict[str, List[Field]] = {}
        self._constants: Dict[str, List[Constant]] = {}
        self._typedefs: Dict[str, Type] = {}
        self._scope: List[str] = []

    def parse(self) -> InterfaceFile:
        begin = self._in.token
        while self._in.token.kind != 'end':
            self._definition()
        names = [f'{self._name}_{part}' for part in PARTS[self._namespace]] or [self._name]
        for name in names:
            if name not in self._structs:
                raise self._in.error(begin, f"the file must define 'struct {name}' in module "
                                            f"'{self._package}::{self._namespace}'")
        kind, implied = IMPLIED[self._namespace]
        for used in implied:
            if used not in self._known:
                raise self._in.error(begin, f"{kind} uses {used}: name '{used.split('/')[0]}' among the DEPENDENCIES of "
                                            'rosidl_generate_interfaces')
        parts = [Message(self._package, self._namespace, name, self._structs[name], self._constants.get(name, []))
                 for name in names]
        if self._namespace == 'action':
            return action_file(self._package, self._name, *parts)
        if self._namespace == 'srv':
            service = Service(self._package, self._namespace, self._name, *parts)
            return InterfaceFile(self._package, self._namespace, self._name, service.messages, [service])
        return InterfaceFile(self._package, self._namespace, self._name, parts)

    def _definition(self) -> None:
        self._annotations()
        token = self._in.token
        if self._in.accept('module'):
            self._scope.append(self._in.name().text)
            self._in.expect('{')
            while not self._in.accept('}'):
                self._definition()
            self._scope.pop()
        elif self._in.accept('struct'):
            self._struct()
        elif self._in.accept('typedef'):
            type_ = self._type()
            name = self._in.name().text
            self._typedefs[name] = self._array(type_)
        elif self._in.accept('const'):
            self._constant()
        else:
            raise self._in.error(token, f"expected 'module', 'struct', 'typedef' or 'const' and not '{token.text}'")
        self._in.expect(';')

    def _struct(self) -> None:
        token = self._in.name()
        if self._scope != [self._package, self._namespace]:
            raise self._in.error(token, f"'{token.text}' must be in module '{self._package}::{self._namespace}'")
        fields: List[Field] = []
        self._in.expect('{')
        while not self._in.accept('}'):
            default = self._annotations()
            type_ = self._type()
            while True:
                fields.append(self._field(type_, default, fields))
                if not self._in.accept(','):
                    break
            self._in.expect(';')
        if [field.name for field in fields] == ['structure_needs_at_least_one_member']:
            fields = []
        self._structs[token.text] = fields

    def _field(self, type_: Type, default: Optional[Tuple[_Token, object]], fields: List[Field]) -> Field:
        token = self._in.name()
        if any(field.name == token.text for field in fields):
            raise self._in.error(token, f"there is already a member '{token.text}'")
        type_ = self._array(type_)
        return Field(type_, token.text, self._convert(default[0], default[1], type_) if default else None)

    def _annotations(self) -> Optional[Tuple[_Token, object]]:
        """Skips annotations, and returns the value of @default."""
        default = None
        while self._in.accept('@'):
            name = self._in.name().text
            if self._in.token.text != '(':
                continue
            self._in.take()
            while not self._in.accept(')'):
                token = self._in.take()
                if token.kind == 'end':
                    raise self._in.error(token, "a ')' is missing")
                if name == 'default' and token.text == 'value' and self._in.accept('='):
                    default = (self._in.token, self._value())
                elif token.text == '(':
                    raise self._in.error(token, "annotations can't be nested")
        return default

    def _type(self) -> Type:
        token = self._in.token
        if self._in.accept('sequence'):
            self._in.expect('<')
            element = self._type()
            bound = self._size() if self._in.accept(',') else None
            self._in.expect('>')
            if element.is_array or element.is_sequence:
                raise self._in.error(token, 'a sequence of arrays or sequences is not possible')
            return Type(element.name, element.package, element.string_bound, sequence_bound=bound, is_sequence=True,
                        namespace=element.namespace)
        for string in ('string', 'wstring'):
            if self._in.accept(string):
                bound = None
                if self._in.accept('<'):
                    bound = self._size()
                    self._in.expect('>')
                return Type(string, string_bound=bound)
        words = []
        while self._in.token.text in ('unsigned', 'long', 'short'):
            words.append(self._in.take().text)
        if not words and self._in.token.text in WORDS:
            words.append(self._in.take().text)
        if words:
            if ' '.join(words) not in WORDS:
                raise self._in.error(token, f"'{' '.join(words)}' is not a type of ROS 2")
            return Type(WORDS[' '.join(words)])
        names = [self._in.name().text]
        while self._in.accept('::'):
            names.append(self._in.name().text)
        if names[-1] in self._typedefs:
            return self._typedefs[names[-1]]
        if len(names) == 1:
            names = [self._package, 'msg', *names]
        if '/'.join(names) in self._known:
            return Type(names[-1], names[0], namespace=names[1] if len(names) == 3 else 'msg')
        raise self._in.error(token, f"unknown type '{'::'.join(names)}'")

    def _array(self, type_: Type) -> Type:
        begin = self._in.token
        if not self._in.accept('['):
            return type_
        size = self._size()
        self._in.expect(']')
        if type_.is_array or type_.is_sequence:
            raise self._in.error(begin, 'an array of arrays or sequences is not possible')
        return Type(type_.name, type_.package, type_.string_bound, array_size=size, namespace=type_.namespace)

    def _size(self) -> int:
        token = self._in.token
        value = self._value()
        if not isinstance(value, int) or isinstance(value, bool) or value < 1:
            raise self._in.error(token, 'the size must be a number above 0')
        return value

    def _constant(self) -> None:
        token = self._in.token
        if not self._scope or not self._scope[-1].endswith('_Constants'):
            raise self._in.error(token, "constants are in a module '<name>_Constants'")
        type_ = self._type()
        name = self._in.name().text
        self._in.expect('=')
        token = self._in.token
        value = self._convert(token, self._value(), type_)
        self._constants.setdefault(self._scope[-1][:-len('_Constants')], []).append(Constant(type_, name, value))

    def _value(self) -> object:
        """A literal, a constant, or a number computed from them."""
        begin = self._in.token
        if begin.kind == 'text':
            return ''.join(iter(self._strings, ''))
        expression = []
        while True:
            token = self._in.token
            if token.kind == 'number':
                expression.append(_python_number(token.text))
            elif token.kind == 'name':
                token = self._in.take()
                while self._in.accept('::'):
                    token = self._in.name()
                expression.append(repr(self._named_value(token)))
                continue
            elif token.kind != 'sign' or token.text not in '+ - * / % ( ) | & ^ ~ << >>'.split():
                break
            elif token.text == ')' and expression.count('(') == expression.count(')'):
                break
            elif token.text == '>>':
                break  # the end of two types
            else:
                expression.append(token.text)
            self._in.take()
        try:
            return _evaluate(ast.parse(' '.join(expression), mode='eval').body)
        except (SyntaxError, ValueError, ArithmeticError, TypeError):
            raise self._in.error(begin, 'expected a value') from None

    def _strings(self) -> str:
        if self._in.token.kind != 'text':
            return ''
        return str(ast.literal_eval(self._in.take().text.lstrip('L')))

    def _named_value(self, token: _Token) -> object:
        if token.text in ('TRUE', 'FALSE'):
            return token.text == 'TRUE'
        for constants in self._constants.values():
            for constant in constants:
                if constant.name == token.text:
                    return constant.value
        raise self._in.error(token, f"unknown constant '{token.text}'")

    def _convert(self, token: _Token, value: object, type_: Type) -> object:
        if type_.is_array or type_.is_sequence:
            # The default of many elements is a string with a list of Python.
            try:
                items = list(ast.literal_eval(value)) if isinstance(value, str) else None
            except (SyntaxError, ValueError, TypeError):
                items = None
            if items is None:
                raise self._in.error(token, 'the default of an array is a string with a list: "(1, 2, 3)"')
            return [self._convert(token, item, type_.element) for item in items]
        return _checked(lambda what: self._in.error(token, what), value, type_)


def _checked(error: Callable[[str], InterfaceError], value: object, type_: Type) -> object:
    if type_.is_message:
        raise error('a message cannot have a value')
    if type_.is_string:
        if not isinstance(value, str):
            raise error('expected a string')
        return value
    if type_.name == 'bool':
        return bool(value)
    if not isinstance(value, (int, float)):
        raise error('expected a number')
    if type_.name in ('float32', 'float64'):
        return float(value)
    signed, bits = INTEGER_BITS.get(type_.name, (0, 8))
    low, high = (-(1 << (bits - 1)), (1 << (bits - 1)) - 1) if signed else (0, (1 << bits) - 1)
    if int(value) != value or not low <= value <= high:
        raise error(f'{value} does not fit {type_.name}, which goes from {low} to {high}')
    return int(value)


def _python_number(text: str) -> str:
    if text.lower().startswith('0x'):
        return text
    text = text.rstrip('dD')
    return f'0o{text[1:]}' if re.fullmatch('0[0-7]+', text) else text


def _evaluate(node: ast.AST) -> object:
    """The value of an expression of numbers, strings and the operators of IDL."""
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float, str)):
        return node.value
    if isinstance(node, ast.UnaryOp):
        operand = _evaluate(node.operand)
        if isinstance(node.op, ast.USub):
            return -operand  # type: ignore[operator]
        if isinstance(node.op, ast.Invert):
            return ~operand  # type: ignore[operator]
        return operand
    if isinstance(node, ast.BinOp):
        left, right = _evaluate(node.left), _evaluate(node.right)
        if isinstance(node.op, ast.Div):
            return left // right if isinstance(left, int) and isinstance(right, int) else left / right  # type: ignore[operator]
        operators: Dict[type, Callable[..., object]] = {
            ast.Add: lambda a, b: a + b, ast.Sub: lambda a, b: a - b, ast.Mult: lambda a, b: a * b, ast.Mod: lambda a, b: a % b,
            ast.BitOr: lambda a, b: a | b, ast.BitAnd: lambda a, b: a & b, ast.BitXor: lambda a, b: a ^ b,
            ast.LShift: lambda a, b: a << min(b, 64), ast.RShift: lambda a, b: a >> b}
        return operators[type(node.op)](left, right)
    raise ValueError('no value')
