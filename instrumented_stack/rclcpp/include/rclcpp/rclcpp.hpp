// SPDX-License-Identifier: Apache-2.0
// The C++ client library of ROS 2, as far as this stack implements it:
//
//   utilities.hpp        init, shutdown, ok, signals           context.hpp, init_options.hpp
//   node.hpp             Node                                  node_options.hpp, node_interfaces/
//   publisher.hpp        Publisher                             publisher_options.hpp, qos.hpp, loaned_message.hpp
//   subscription.hpp     Subscription                          subscription_options.hpp, any_subscription_callback.hpp
//   generic_publisher.hpp, generic_subscription.hpp            serialization.hpp, serialized_message.hpp
//   type_adapter.hpp     TypeAdapter                           message_info.hpp
//   service.hpp          Service                               any_service_callback.hpp
//   client.hpp           Client
//   timer.hpp            WallTimer, GenericTimer               create_timer.hpp
//   parameter.hpp        Parameter                             parameter_value.hpp
//   parameter_client.hpp SyncParametersClient                  AsyncParametersClient
//   parameter_event_handler.hpp ParameterEventHandler          node_interfaces/node_interfaces.hpp
//   time.hpp             Time                                  duration.hpp, clock.hpp, rate.hpp
//   executors.hpp        spin, the executors                   executor.hpp, executors/, callback_group.hpp
//   waitable.hpp         Waitable                              guard_condition.hpp, node_interfaces/node_waitables.hpp
//   wait_set.hpp         WaitSet and similar classes           wait_for_message.hpp
//   logging.hpp          RCLCPP_INFO and similar macros        logger.hpp
//   exceptions.hpp       the exceptions of rclcpp
//
// Names, signatures and behaviour are those of rclcpp in ROS 2 Jazzy.
#pragma once

// Applications expect these headers to come with rclcpp.
#include <rcl/domain_id.h>
#include <rcl/logging_rosout.h>
#include <rcutils/types.h>
#include <rmw/error_handling.h>
#include <rmw/incompatible_qos_events_statuses.h>
#include <rmw/rmw.h>

#include <algorithm>
#include <cassert>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <future>
#include <iomanip>
#include <iostream>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <queue>
#include <rcpputils/join.hpp>
#include <rcpputils/pointer_traits.hpp>
#include <rcpputils/scope_exit.hpp>
#include <rcpputils/shared_library.hpp>
#include <rcpputils/thread_safety_annotations.hpp>
#include <rcpputils/time.hpp>
#include <set>
#include <sstream>
#include <thread>
#include <unordered_map>

#include "rclcpp/copy_all_parameter_values.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/executors.hpp"
#include "rclcpp/expand_topic_or_service_name.hpp"
#include "rclcpp/guard_condition.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/node.hpp"
#include "rclcpp/node_interfaces/node_interfaces.hpp"
#include "rclcpp/parameter.hpp"
#include "rclcpp/parameter_client.hpp"
#include "rclcpp/parameter_event_handler.hpp"
#include "rclcpp/parameter_map.hpp"
#include "rclcpp/rate.hpp"
#include "rclcpp/serialization.hpp"
#include "rclcpp/time.hpp"
#include "rclcpp/time_source.hpp"
#include "rclcpp/utilities.hpp"
#include "rclcpp/visibility_control.hpp"
#include "rclcpp/wait_for_message.hpp"
#include "rclcpp/wait_set.hpp"
#include "rclcpp/waitable.hpp"
