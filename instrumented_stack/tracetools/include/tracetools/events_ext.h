// SPDX-License-Identifier: Apache-2.0
#pragma once

// The events of provider `ros2_ext` as C sees them, in rows as in events.h. ROS 2's tracetools does not record them.

#include "tracetools/events.h"

#define TRACETOOLS_EXT_EVENTS(EVENT) TRACETOOLS_EXT_EVENT_TABLE(TRACETOOLS_EVENT_IN_C, EVENT)
