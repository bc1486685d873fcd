# SPDX-License-Identifier: Apache-2.0
"""Type hints."""

SomeParameters = object
SomeParametersDict = object
SomeParameterValue = object
Parameters = object
ParametersDict = object
SomeParameterFile = object
SomeParameterName = object
ParameterName = object
EvaluatedParameterValue = object
EvaluatedParameters = object
SomeParameterValue_types_tuple = (str, bool, int, float)
ParameterFile = object
ParameterValue = object
