# SPDX-License-Identifier: Apache-2.0
"""Lists of names for asking for traces."""

from tracetools_trace.tools import tracepoints  # written at build, from the declaration of the events

DEFAULT_EVENTS_ROS = list(tracepoints._all)

DEFAULT_INIT_EVENTS_ROS = list(tracepoints._initialisation)

DEFAULT_EVENTS_UST = DEFAULT_EVENTS_ROS

# The kernel events that analyses use.
DEFAULT_EVENTS_KERNEL = ['sched_switch', 'kmem_mm_page_alloc', 'kmem_mm_page_free', 'power_cpu_frequency']

DOMAIN_TYPE_KERNEL = 'kernel'
DOMAIN_TYPE_USERSPACE = 'userspace'

DEFAULT_CONTEXT = ['procname', 'vpid', 'vtid']
