"""Type hints."""

from typing import Any

SomeRemapRule = Any
SomeRemapRules = Any
RemapRule = Any
RemapRules = Any
