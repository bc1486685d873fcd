# SPDX-License-Identifier: Apache-2.0
"""Type hints."""

from typing import Any

SomeRemapRule = Any
SomeRemapRules = Any
RemapRule = Any
RemapRules = Any
