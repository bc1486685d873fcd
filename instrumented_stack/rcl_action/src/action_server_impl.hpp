// SPDX-License-Identifier: Apache-2.0
// The parts of a server, for the files that implement it.
#pragma once

#include <string>
#include <vector>

#include "rcl/publisher.h"
#include "rcl/service.h"
#include "rcl_action/action_server.h"
#include "rosidl_runtime_c/type_description.h"

struct rcl_action_server_impl_s {
  rcl_action_server_options_t options;
  std::string action_name;
  const rosidl_type_description_t* type = nullptr;
  rcl_clock_t* clock = nullptr;
  rcl_service_t goal_service = rcl_get_zero_initialized_service();
  rcl_service_t cancel_service = rcl_get_zero_initialized_service();
  rcl_service_t result_service = rcl_get_zero_initialized_service();
  rcl_publisher_t feedback_publisher = rcl_get_zero_initialized_publisher();
  rcl_publisher_t status_publisher = rcl_get_zero_initialized_publisher();
  rcl_timer_t expire_timer = rcl_get_zero_initialized_timer();
  std::vector<rcl_action_goal_handle_t*> goals;  // owned by the callers of rcl_action_accept_new_goal()
};
