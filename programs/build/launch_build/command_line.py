# SPDX-License-Identifier: Apache-2.0
"""The options of `launch build`, and its help."""

import sys
from difflib import get_close_matches
from typing import Dict, List, NoReturn, Tuple

HELP = '''Builds the packages of a workspace with CMake, each after those that it needs.
Usage: launch build [OPTIONS] [PACKAGE...]

Positionals:
  PACKAGE ...                 packages to build, with those of the workspace that they need; all if there is none

Options:
  -h,--help                   Print this help message and exit
  -C,--directory TEXT         the workspace, which gets the folders build and install; default: the current directory
  --from TEXT                 where packages are searched for; may be repeated; default: src, or else the workspace
  --only                      only the named packages, not those that they need
  --packages-up-to TEXT ...   these packages and those that they need, as PACKAGE
  --packages-select TEXT ...  only these packages, as PACKAGE with --only
  --packages-skip TEXT ...    all but these; what needs them is built against those that are installed
  --list                      only print the packages, in the order in which they are built
  --missing                   only print the packages of Debian that they name as dependencies and that are not installed:
                              apt install $(launch build --missing)
  --test                      run the tests of the packages, too
  --no-tests                  build no tests (-DBUILD_TESTING=OFF)
  --merge-install             install all packages into one prefix and not each into its own
  --cmake-args TEXT ...       arguments of CMake, up to the next word that begins with '--', or to the word '--'
  --no-ccache                 compile without ccache; it is used if it is installed and nothing names another launcher
  --continue,--continue-on-error
                              go on with packages that do not need one that has failed
  -j,--jobs TEXT              how many processors are used; default: all

Then `source install/setup.bash`. Packages are built against the prefixes in AMENT_PREFIX_PATH, or else against this
stack. The build type is RelWithDebInfo unless --cmake-args names another one.
'''
VALUES = {'-C': 'directory', '--directory': 'directory', '--from': 'from', '-j': 'jobs', '--jobs': 'jobs'}
LISTS = ('--packages-up-to', '--packages-select', '--packages-skip', '--cmake-args')
FLAGS = ('--only', '--list', '--missing', '--test', '--no-tests', '--merge-install', '--no-ccache', '--continue',
         '--continue-on-error')


def usage_error(what: str) -> NoReturn:
    print(f"launch build: error: {what}\n      = help: see 'launch build --help'", file=sys.stderr)
    sys.exit(2)


def parse(words: List[str]) -> Tuple[List[str], Dict[str, List[str]]]:
    """Returns the packages, and the values of the options."""
    names: List[str] = []
    options: Dict[str, List[str]] = {}
    index = 0
    while index < len(words):
        word, _, value = words[index].partition('=')
        index += 1
        if word in ('-h', '--help'):
            print(HELP, end='')
            sys.exit(0)
        if word == '--':
            names += words[index:]
            break
        if word in LISTS and not value:
            # An argument of CMake may begin with one '-', the name of a package can't.
            ends = '--' if word == '--cmake-args' else '-'
            found = options.setdefault(word[2:], [])
            while index < len(words) and not words[index].startswith(ends):
                found.append(words[index].strip() if ends == '--' else words[index])
                index += 1
            if words[index:index + 1] == ['--']:
                index += 1
            if not found and word != '--cmake-args':
                usage_error(f'{word} needs the name of a package')
        elif word in VALUES:
            if not value:
                if index == len(words):
                    usage_error(f'{word} needs a value')
                value = words[index]
                index += 1
            options.setdefault(VALUES[word], []).append(value)
        elif word in FLAGS and not value:
            options['continue' if word.startswith('--continue') else word[2:]] = []
        elif word.startswith('-'):
            near = get_close_matches(word, [*VALUES, *LISTS, *FLAGS, '--help'], 1)
            usage_error(f"unknown option '{word}'" + (f"\n      = help: did you mean '{near[0]}'?" if near else ''))
        else:
            names.append(words[index - 1])
    return names, options
