#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A node in Python: loads the libraries of its ROS 2 when it runs. The arguments are those of the talker."""

import ctypes
import sys

arguments = [argument.encode() for argument in sys.argv]
library = ctypes.CDLL('librclcpp.so')
sys.exit(library.spin_their_node(len(arguments), (ctypes.c_char_p * len(arguments))(*arguments)))
