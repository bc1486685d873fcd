// SPDX-License-Identifier: Apache-2.0
/* libtracetools_provider.so: the probes. Written in C, because LTTng's probe macros are not C++. */
#include <stdlib.h>

/* Of the events of rcl_init. A library that stands in for that of another ROS 2 tells the version of the other one. */
static const char* tracetools_version = TRACETOOLS_VERSION;
#ifdef TRACETOOLS_STANDS_IN
__attribute__((constructor)) static void read_version(void) {
  const char* const version = getenv("TRACETOOLS_STANDS_IN_FOR_VERSION");
  if (version != NULL) {
    tracetools_version = version;
  }
}
#endif

#define LTTNG_UST_TRACEPOINT_CREATE_PROBES
#include "provider/provider.h"
#include "provider/provider_deadline.h"
#include "provider/provider_ext.h"
#include "provider/provider_session.h"

const struct lttng_ust_probe_desc* tracetools_probes_of_ros2(void) {
  return &lttng_ust__probe_desc___ros2;
}

const struct lttng_ust_probe_desc* tracetools_probes_of_ros2_ext(void) {
  return &lttng_ust__probe_desc___ros2_ext;
}
