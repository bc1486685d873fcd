# SPDX-License-Identifier: Apache-2.0
"""Runs at the start of a Python program of a launch whose <trace> has python-nodes. Then runs the sitecustomize that it hides."""

import os
import sys


def _start():
    folder = os.path.dirname(os.path.abspath(__file__))
    try:
        import launch_rclpy_events
        launch_rclpy_events.install()
    except Exception:  # a program never fails because of its trace
        pass
    from importlib.machinery import PathFinder
    from importlib.util import module_from_spec
    others = [path for path in sys.path if os.path.abspath(path or '.') != folder]
    spec = PathFinder.find_spec('sitecustomize', others)
    if spec is None or spec.loader is None:
        return
    module = module_from_spec(spec)
    sys.modules['sitecustomize'] = module
    spec.loader.exec_module(module)


_start()
