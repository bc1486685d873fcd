// SPDX-License-Identifier: Apache-2.0
// The ROS client library below rclcpp: all headers of this layer.
//
//   init.h context.h init_options.h arguments.h       start of a process, --ros-args
//   node.h node_options.h                              nodes
//   publisher.h subscription.h                         topics
//   service.h client.h service_introspection.h         services
//   timer.h time.h guard_condition.h wait.h            waiting
//   graph.h                                            what else is in the system
//   remap.h expand_topic_name.h validate_topic_name.h  names
//   logging.h logging_rosout.h                         console and /rosout
//   parameter_overrides.hpp                            parameters of the command line (C++)
//
// The functions of an object are rcl_get_zero_initialized_X(), rcl_X_init() and rcl_X_fini(). Functions return
// RCL_RET_OK, or a code of rcl/types.h after leaving a message for rcl_get_error_string().
#pragma once

#include "rcl/arguments.h"
#include "rcl/client.h"
#include "rcl/context.h"
#include "rcl/discovery_options.h"
#include "rcl/domain_id.h"
#include "rcl/expand_topic_name.h"
#include "rcl/graph.h"
#include "rcl/guard_condition.h"
#include "rcl/init.h"
#include "rcl/init_options.h"
#include "rcl/logging.h"
#include "rcl/logging_rosout.h"
#include "rcl/node.h"
#include "rcl/publisher.h"
#include "rcl/remap.h"
#include "rcl/service.h"
#include "rcl/service_introspection.h"
#include "rcl/subscription.h"
#include "rcl/time.h"
#include "rcl/timer.h"
#include "rcl/types.h"
#include "rcl/validate_topic_name.h"
#include "rcl/wait.h"
