# SPDX-License-Identifier: Apache-2.0
"""Type hints."""

SomeParameters = object
SomeParametersDict = object
SomeParameterValue = object
Parameters = object
ParametersDict = object
SomeParameterFile = object
ParameterFile = object
ParameterValue = object
