# SPDX-License-Identifier: Apache-2.0
"""The levels of a state."""

OK, WARN, ERROR, STALE = range(4)
