# SPDX-License-Identifier: Apache-2.0
"""The name under which ROS 2 has the program: `python3 -m launch_testing.launch_test FILE`."""

import os
import runpy
import sys


def main():
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), '__main__.py')
    sys.exit(runpy.run_path(path)['main']())


if __name__ == '__main__':
    main()
