# SPDX-License-Identifier: Apache-2.0
"""Names of events and fields of traces."""

from tracetools_trace.tools import names, tracepoints

__all__ = ['names', 'tracepoints']
