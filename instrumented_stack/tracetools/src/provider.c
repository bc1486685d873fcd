// SPDX-License-Identifier: Apache-2.0
/* libtracetools_provider.so: the probes. Written in C, because LTTng's probe macros are not C++. */
#define LTTNG_UST_TRACEPOINT_CREATE_PROBES
#include "provider.h"
