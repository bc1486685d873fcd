# SPDX-License-Identifier: Apache-2.0
"""The prefixes that a build uses, and the environment that names them to CMake, tests and Python."""

import os
import shutil
import sys
from pathlib import Path
from typing import Dict, Iterable, List, Mapping

SETUP_FILES = ('local_setup.bash', 'local_setup.sh', 'local_setup.zsh', 'setup.bash', 'setup.sh', 'setup.zsh')


def own_prefix() -> Path:
    """The prefix in which this program is installed: lib/launch/launch_build/prefixes.py is in it."""
    return Path(__file__).resolve().parents[3]


def underlays(environment: Mapping[str, str]) -> List[Path]:
    """What packages are built against: the prefixes of the environment, and this program's own unless a ROS 2 is among
    them."""
    named = [Path(prefix) for prefix in environment.get('AMENT_PREFIX_PATH', '').split(':') if prefix]
    found = [prefix for prefix in dict.fromkeys(named) if prefix.is_dir()]
    if not any((prefix / 'share/rclcpp/cmake').is_dir() for prefix in found):
        found.append(own_prefix())
    return found


def build_environment(environment: Mapping[str, str], prefixes: Iterable[Path]) -> Dict[str, str]:
    """`environment` with these prefixes first."""
    prefixes = list(prefixes)
    result = dict(environment)
    result.setdefault('ROS_VERSION', '2')
    result.setdefault('ROS_PYTHON_VERSION', '3')
    result.setdefault('ROS_DISTRO', 'jazzy')  # whose packages this stack stands in for
    python = f'lib/python{sys.version_info.major}.{sys.version_info.minor}/site-packages'
    for variable, below in (('AMENT_PREFIX_PATH', ''), ('CMAKE_PREFIX_PATH', ''), ('PATH', 'bin'), ('PYTHONPATH', python)):
        found = [str(prefix / below) for prefix in prefixes if not below or (prefix / below).is_dir()]
        before = [path for path in result.get(variable, '').split(':') if path and path not in found]
        if found or before:
            result[variable] = ':'.join(found + before)
    return result


def write_setup_files(install: Path, below: Iterable[Path]) -> None:
    """Makes `install` a prefix, or a folder of prefixes, that a shell can source."""
    install.mkdir(parents=True, exist_ok=True)
    source = own_prefix() / 'share/ament_cmake/setup'
    for name in SETUP_FILES:
        shutil.copyfile(source / name, install / name)
    (install / 'underlays').write_text(''.join(f'{os.path.abspath(prefix)}\n' for prefix in below))
