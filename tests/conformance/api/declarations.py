# SPDX-License-Identifier: Apache-2.0
"""
What the public headers of a package declare, read with libclang (python3-clang-14).

`declarations_of()` returns a map from qualified names to `Declaration`. A name stands for all overloads of it;
the overloads differ in the numbers of arguments with which they can be called.
"""

import dataclasses
import pathlib
import re
import tempfile

from clang.cindex import AccessSpecifier, Config, CursorKind, Diagnostic, Index, TranslationUnit

Config.set_library_file('libclang-14.so.1')

# A function that takes any number of arguments can be called with so many.
MANY = 12

FUNCTIONS = {CursorKind.FUNCTION_DECL, CursorKind.CXX_METHOD, CursorKind.CONSTRUCTOR, CursorKind.CONVERSION_FUNCTION}
CLASSES = {CursorKind.CLASS_DECL, CursorKind.STRUCT_DECL, CursorKind.UNION_DECL, CursorKind.CLASS_TEMPLATE}
ALIASES = {CursorKind.TYPEDEF_DECL, CursorKind.TYPE_ALIAS_DECL, CursorKind.TYPE_ALIAS_TEMPLATE_DECL}
PARTIAL = CursorKind.CLASS_TEMPLATE_PARTIAL_SPECIALIZATION
# Parts of a namespace with such a name are not for programs.
INNER_NAMESPACES = {'detail', 'impl', 'internal', 'policies', ''}


@dataclasses.dataclass
class Declaration:
    kind: str
    header: str
    arities: set = dataclasses.field(default_factory=set)
    bases: list = dataclasses.field(default_factory=list)


def plain(type_name):
    """A type's name without its template arguments and qualifiers."""
    name = type_name
    while re.search(r'<[^<>]*>', name):
        name = re.sub(r'<[^<>]*>', '', name)
    return re.sub(r'\b(typename|const|class|struct)\b|[&*\s]', '', name)


def arities(function):
    """With how many arguments a function can be called."""
    least = most = 0
    for argument in function.get_children():
        if argument.kind != CursorKind.PARM_DECL:
            continue
        tokens = [token.spelling for token in argument.get_tokens()]
        if '...' in tokens and '(' not in tokens:
            return set(range(least, MANY + 1))
        most += 1
        if '=' not in tokens:
            least = most
    if function.type.kind.name == 'FUNCTIONPROTO' and function.type.is_function_variadic():
        most = MANY
    return set(range(least, most + 1))


class Reader:
    def __init__(self, folders, with_inner):
        self.with_inner = with_inner
        self.folders = [str(folder.resolve()) + '/' for folder in folders]
        self.found = {}

    def header(self, cursor):
        """The header below one of the folders that has the cursor, or None."""
        if cursor.location.file is None:
            return None
        name = str(pathlib.Path(cursor.location.file.name).resolve())
        return next((name[len(folder):] for folder in self.folders if name.startswith(folder)), None)

    def elsewhere(self, cursor):
        """Whether this is the definition of a member outside of its class."""
        return (cursor.semantic_parent is not None and cursor.semantic_parent.kind in CLASSES | {PARTIAL} and
                cursor.lexical_parent is not None and cursor.lexical_parent.kind not in CLASSES | {PARTIAL})

    def add(self, name, kind, cursor):
        declaration = self.found.setdefault(name, Declaration(kind, self.header(cursor)))
        if declaration.kind == 'alias' and kind == 'class':
            declaration.kind = kind
        return declaration

    def read(self, cursor, scope=''):
        for child in cursor.get_children():
            if not scope and self.header(child) is None:
                continue
            self.read_one(child, scope)

    def read_one(self, cursor, scope):
        kind, name = cursor.kind, scope + cursor.spelling
        if kind in (CursorKind.UNEXPOSED_DECL, CursorKind.LINKAGE_SPEC):
            self.read(cursor, scope)
        elif kind == CursorKind.NAMESPACE:
            if self.with_inner or cursor.spelling not in INNER_NAMESPACES:
                for child in cursor.get_children():
                    if self.header(child) is not None:
                        self.read_one(child, name + '::')
        elif kind == CursorKind.MACRO_DEFINITION:
            if not re.search(r'_(HPP|H)_?$|^_|__', cursor.spelling):
                self.add(cursor.spelling, 'macro', cursor)
        elif cursor.access_specifier in (AccessSpecifier.PRIVATE, AccessSpecifier.PROTECTED) or self.elsewhere(cursor):
            pass
        elif kind in CLASSES:
            self.read_class(cursor, name)
        elif kind == CursorKind.ENUM_DECL:
            if cursor.spelling:
                self.add(name, 'enum', cursor)
            for constant in cursor.get_children():
                self.add((name + '::' if cursor.is_scoped_enum() else scope) + constant.spelling, 'value', constant)
        elif kind in ALIASES:
            self.add(name, 'alias', cursor).bases.append(plain(cursor.underlying_typedef_type.spelling))
        elif kind == PARTIAL:
            self.read_class(cursor, scope + plain(cursor.spelling))
        elif kind == CursorKind.FUNCTION_TEMPLATE or kind in FUNCTIONS:
            self.read_function(cursor, scope)
        elif kind in (CursorKind.VAR_DECL, CursorKind.FIELD_DECL):
            self.add(name, 'value', cursor)
        elif kind == CursorKind.USING_DECLARATION:  # also of the constructors of a base class
            name = name.split('<')[0]
            self.add(name, 'using', cursor).arities |= set(range(MANY + 1))

    def read_class(self, cursor, name):
        if not cursor.spelling:
            return
        declaration = self.add(name, 'class', cursor)
        if not cursor.is_definition():
            return
        for child in cursor.get_children():
            if child.kind == CursorKind.CXX_BASE_SPECIFIER:
                declaration.bases.append(plain(child.type.spelling))
            else:
                self.read_one(child, name + '::')

    def read_function(self, cursor, scope):
        spelling = re.sub(r'<.*>$', '', cursor.spelling) if 'operator' not in cursor.spelling else cursor.spelling
        if cursor.kind == CursorKind.CONSTRUCTOR or (cursor.kind == CursorKind.FUNCTION_TEMPLATE and '<' in spelling):
            spelling = spelling.split('<')[0]
        if spelling == 'operator=' or spelling.startswith('~') or spelling.startswith('<deduction'):
            return
        if spelling.startswith('operator ') and '<' in spelling:
            spelling = 'operator ' + plain(spelling[len('operator '):])
        self.add(scope + spelling, 'function', cursor).arities.update(arities(cursor))


def headers_below(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob('*') if path.suffix in ('.h', '.hpp'))


def declarations_of(headers, include_folders, read_folders, with_inner=False):
    """
    The public declarations of the headers, also those of namespaces for inner parts if with_inner is set. A header of
    another package that is not there is taken as an empty one.
    """
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder, 'headers.cpp')
        program.write_text(''.join(f'#include <{header}>\n' for header in headers))
        arguments = ['-xc++', '-std=c++17', '-ferror-limit=0', '-w'] + [f'-I{path}' for path in include_folders]
        options = TranslationUnit.PARSE_SKIP_FUNCTION_BODIES | TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD
        while True:
            unit = Index.create().parse(str(program), args=arguments + [f'-I{folder}'], options=options)
            missing = [match[1] for match in (re.match(r"'(.*)' file not found", error.spelling)
                                              for error in unit.diagnostics) if match]
            if not missing:
                break
            pathlib.Path(folder, missing[0]).parent.mkdir(parents=True, exist_ok=True)
            pathlib.Path(folder, missing[0]).touch()
        reader = Reader(read_folders, with_inner)
        reader.read(unit.cursor)
    return reader.found, [str(error) for error in unit.diagnostics if error.severity >= Diagnostic.Error]
