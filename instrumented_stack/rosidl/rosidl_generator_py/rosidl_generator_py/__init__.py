# SPDX-License-Identifier: Apache-2.0
"""Makes the classes of messages, services and actions from the short modules that the build of a package writes.

The classes have the form of ROS 2's. `rosidl_generator_py._type_support`, in C++, converts their objects for rclpy.
"""

from ._field_types import class_of
from ._interfaces import Definitions, interface_module
from ._messages import CHECK_FIELDS

__all__ = ['CHECK_FIELDS', 'Definitions', 'class_of', 'interface_module']
