# SPDX-License-Identifier: Apache-2.0
"""The action that records a trace of the launch."""

from tracetools_launch import action

__all__ = ['action']
