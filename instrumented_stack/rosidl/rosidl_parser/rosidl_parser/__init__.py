# SPDX-License-Identifier: Apache-2.0
"""The module `rosidl_parser.definition`: how ROS 2 tells the types of fields in Python."""
