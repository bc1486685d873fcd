# SPDX-License-Identifier: Apache-2.0
"""Lists of names that traces are asked for with."""

from tracetools_trace.tools import tracepoints  # written at build, from the declaration of the events

DEFAULT_EVENTS_ROS = list(tracepoints._all)

DEFAULT_INIT_EVENTS_ROS = list(tracepoints._initialisation)

DEFAULT_EVENTS_UST = DEFAULT_EVENTS_ROS

# What analyses use.
DEFAULT_EVENTS_KERNEL = ['sched_switch', 'kmem_mm_page_alloc', 'kmem_mm_page_free', 'power_cpu_frequency']

DOMAIN_TYPE_KERNEL = 'kernel'
DOMAIN_TYPE_USERSPACE = 'userspace'

DEFAULT_CONTEXT = ['procname', 'vpid', 'vtid']
