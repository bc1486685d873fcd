"""The action that records a trace of the launch."""

from tracetools_launch import action

__all__ = ['action']
