# SPDX-License-Identifier: Apache-2.0
"""The program `launch`, and how a script starts it."""

import os
import shutil
import subprocess

_PACKAGES = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
_STAND_IN = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'no_file.launch.py')


def find():
    """The path of the program. Raises RuntimeError when it is not there."""
    named = os.environ.get('LAUNCH_PROGRAM')
    beside = os.path.normpath(os.path.join(_PACKAGES, '..', '..', '..', 'bin', 'launch'))
    for path in [named] if named else [beside, shutil.which('launch')]:
        if path and os.access(path, os.X_OK):
            return path
    if named:
        raise RuntimeError(f"LaunchService needs the program 'launch': LAUNCH_PROGRAM names '{named}', which can't be run")
    raise RuntimeError(f"LaunchService needs the program 'launch', which is neither '{beside}' nor on PATH; "
                       'source setup.bash of the prefix, or set LAUNCH_PROGRAM')


def start(script, descriptors, debug):
    """The launcher's process, for the Python file `script`."""
    # A launch file of its own stands for a script that no file holds, such as one of standard input.
    file = script if script.endswith('.py') and os.path.isfile(script) else _STAND_IN
    # What processes end with is no error of the launch, as in ROS 2.
    command = [find(), '--ignore-failures', *(['--debug'] if debug else []), os.path.abspath(file)]
    order = ':'.join(map(str, (*descriptors, os.getpid())))
    # Ctrl-C is for the script, which passes it on: in one group with it, the launcher would get it twice.
    return subprocess.Popen(command, env={**os.environ, 'LAUNCH_OF_SCRIPT': order}, stdin=subprocess.DEVNULL,
                            pass_fds=descriptors, start_new_session=True)
