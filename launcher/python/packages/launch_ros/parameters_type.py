# SPDX-License-Identifier: Apache-2.0
"""Type hints."""

from typing import Any

SomeParameters = Any
SomeParametersDict = Any
SomeParameterValue = Any
Parameters = Any
ParametersDict = Any
SomeParameterFile = Any
ParameterFile = Any
ParameterValue = Any
