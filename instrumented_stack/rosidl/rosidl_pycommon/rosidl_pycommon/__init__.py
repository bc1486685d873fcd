# SPDX-License-Identifier: Apache-2.0
"""What the classes of all interfaces have in common: `rosidl_pycommon.interface_base_classes`."""

import re


def convert_camel_case_to_lower_case_underscore(value: str) -> str:
    """The name of the module of a type: 'MultiArrayLayout' becomes 'multi_array_layout'."""
    words = re.sub(r'(.)([A-Z][a-z]+)', r'\1_\2', value)
    return re.sub(r'([a-z0-9])([A-Z])', r'\1_\2', words).lower()
