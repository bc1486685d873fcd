# SPDX-License-Identifier: Apache-2.0
"""Type hints."""

SomeRemapRule = object
SomeRemapRules = object
RemapRule = object
RemapRules = object
