// SPDX-License-Identifier: Apache-2.0
// The parts of a client, for the files that implement it.
#pragma once

#include <string>

#include "rcl/client.h"
#include "rcl/subscription.h"
#include "rcl_action/action_client.h"
#include "rosidl_runtime_c/type_description.h"

struct rcl_action_client_impl_s {
  rcl_action_client_options_t options;
  std::string action_name;
  const rosidl_type_description_t* type = nullptr;
  rcl_client_t goal_client = rcl_get_zero_initialized_client();
  rcl_client_t cancel_client = rcl_get_zero_initialized_client();
  rcl_client_t result_client = rcl_get_zero_initialized_client();
  rcl_subscription_t feedback_subscription = rcl_get_zero_initialized_subscription();
  rcl_subscription_t status_subscription = rcl_get_zero_initialized_subscription();
};
