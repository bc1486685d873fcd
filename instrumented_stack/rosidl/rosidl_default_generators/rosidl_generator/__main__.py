# SPDX-License-Identifier: Apache-2.0
"""python3 rosidl_generator --package PKG --output DIR [--known PKG/msg/NAME]... [--descriptions JSON]...
                            [--python-output DIR --python-library FILE] FILE...

Writes the C++ and C of one package: headers under DIR/include/PKG, the sources DIR/PKG__interfaces.cpp and DIR/PKG__c.cpp
of its libraries, and DIR/type_descriptions.json, which packages that use its messages need as --descriptions. The
folder of a file, msg, srv or action, is the namespace of its types; if it has another name, the extension of the file is.
--known names the messages of other packages that may be used. --python-output is the folder for the package's modules in
Python, --python-library its library for C from the folders of these modules.
"""

import argparse
import json
import os
import sys
from importlib.machinery import ModuleSpec

if __package__ in (None, ''):
    # The program is run by its path, but the modules import each other as parts of a package.
    sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    __package__ = 'rosidl_generator'
    __spec__ = ModuleSpec('rosidl_generator.__main__', None)  # Python 3.13 warns if the two differ

from . import c_headers, c_source, cpp_builder, cpp_source, cpp_struct, cpp_traits, py_modules, type_hash  # noqa: E402
from .idl_parser import parse_idl  # noqa: E402
from .interface_parser import InterfaceError, parse_file  # noqa: E402
from .least_size import least_sizes  # noqa: E402


def write_if_changed(path: str, text: str) -> None:
    """Leaves a file alone if it already has this text, so that files that include it are not compiled again."""
    if os.path.exists(path):
        with open(path, encoding='utf-8') as old:
            if old.read() == text:
                return
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, 'w', encoding='utf-8') as new:
        new.write(text)


def namespace_of(path: str) -> str:
    folder = os.path.basename(os.path.dirname(path))
    return folder if folder in ('msg', 'srv', 'action') else os.path.splitext(path)[1][1:]


def main() -> int:
    arguments = argparse.ArgumentParser(prog='rosidl_generator', description=__doc__)
    arguments.add_argument('--package', required=True)
    arguments.add_argument('--output', required=True)
    arguments.add_argument('--known', nargs='*', default=[])
    arguments.add_argument('--descriptions', nargs='*', default=[])
    arguments.add_argument('--python-output')
    arguments.add_argument('--python-library', default='')
    arguments.add_argument('files', nargs='+', metavar='FILE')
    options = arguments.parse_args()

    namespaces = {path: namespace_of(path) for path in options.files}
    names = {path: os.path.splitext(os.path.basename(path))[0] for path in options.files}
    known = {*options.known,
             *(f'{options.package}/msg/{names[path]}' for path in options.files if namespaces[path] == 'msg')}
    files = []
    errors = []
    for path in options.files:
        with open(path, encoding='utf-8') as source:
            try:
                text = source.read()
                parse = parse_idl if path.endswith('.idl') else parse_file
                files.append(parse(path, text, options.package, namespaces[path], known))
                files[-1].source = text
                files[-1].encoding = 'idl' if parse is parse_idl else ''
            except InterfaceError as error:
                errors.append(str(error))
    if errors:
        print('\n'.join(errors), file=sys.stderr)
        return 1

    descriptions = {}
    for path in options.descriptions:
        with open(path, encoding='utf-8') as of_dependency:
            descriptions.update(json.load(of_dependency))
    own = [description for file in files for description in type_hash.describe_file(file)]
    descriptions.update((description['type_name'], description) for description in own)
    hashes = {description['type_name']: type_hash.type_hash(description, descriptions) for description in own}
    needed = {*(description['type_name'] for description in own), *type_hash.referenced(own, descriptions)}
    write_if_changed(os.path.join(options.output, 'type_descriptions.json'),
                     json.dumps({name: descriptions[name] for name in sorted(needed)}, indent=1) + '\n')

    include = os.path.join(options.output, 'include')
    for file in files:
        write_if_changed(os.path.join(include, file.header), cpp_struct.main_header(file))
        for part, emit in (('struct', cpp_struct.struct_header), ('builder', cpp_builder.builder_header), ('traits', cpp_traits.traits_header),
                           ('type_support', cpp_traits.type_support_header)):
            write_if_changed(os.path.join(include, file.detail_header(part)), emit(file))
        write_if_changed(os.path.join(include, c_headers.main_path(file)), c_headers.main_header(file))
        for part, emit in (('struct', c_headers.struct_header), ('functions', c_headers.functions_header),
                           ('type_support', c_headers.type_support_header)):
            write_if_changed(os.path.join(include, c_headers.detail_path(file, part)), emit(file))
    sizes = least_sizes(descriptions)
    write_if_changed(os.path.join(include, cpp_source.codec_header_path(options.package)),
                     cpp_source.codec_header(options.package, files, sizes))
    write_if_changed(os.path.join(options.output, f'{options.package}__interfaces.cpp'),
                     cpp_source.source(options.package, files, own, hashes))
    write_if_changed(os.path.join(options.output, f'{options.package}__c.cpp'),
                     c_source.source(options.package, files, sizes, hashes))
    if options.python_output:
        for path, text in py_modules.modules(options.package, files, options.python_library).items():
            write_if_changed(os.path.join(options.python_output, path), text)
    return 0


if __name__ == '__main__':
    sys.exit(main())
