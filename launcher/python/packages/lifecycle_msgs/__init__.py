# SPDX-License-Identifier: Apache-2.0
"""The numbers of states and transitions, for launch files. The package with the messages comes first where there is one."""

from pkgutil import extend_path

__path__ = extend_path(__path__, __name__)
__path__.append(__path__.pop(0))
