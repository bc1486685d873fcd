// SPDX-License-Identifier: Apache-2.0
// A node in C, without rclcpp: it takes joint states, publishes each with its names in capitals and its positions twice
// as large, answers one call of a service, and ends.
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>

#include "example_interfaces/srv/add_two_ints.h"
#include "rcl/error_handling.h"
#include "rcl/rcl.h"
#include "rosidl_runtime_c/string_functions.h"
#include "sensor_msgs/msg/joint_state.h"

static rcl_publisher_t publisher;
static rcl_subscription_t subscription;
static rcl_service_t service;

static void check(rcl_ret_t result, const char* what) {
  if (result != RCL_RET_OK) {
    fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

static void echo_joints(void) {
  sensor_msgs__msg__JointState* state = sensor_msgs__msg__JointState__create();
  check(rcl_take(&subscription, state, NULL, NULL), "rcl_take");
  for (size_t i = 0; i < state->name.size; ++i) {
    for (char* letter = state->name.data[i].data; *letter; ++letter) {
      *letter = (char)toupper((unsigned char)*letter);
    }
  }
  for (size_t i = 0; i < state->position.size; ++i) {
    state->position.data[i] *= 2;
  }
  check(rcl_publish(&publisher, state, NULL), "rcl_publish");
  sensor_msgs__msg__JointState__destroy(state);
}

static void answer(void) {
  rmw_request_id_t id;
  example_interfaces__srv__AddTwoInts_Request request;
  example_interfaces__srv__AddTwoInts_Response response;
  if (!example_interfaces__srv__AddTwoInts_Request__init(&request) ||
      !example_interfaces__srv__AddTwoInts_Response__init(&response)) {
    exit(1);
  }
  check(rcl_take_request(&service, &id, &request), "rcl_take_request");
  response.sum = request.a + request.b;
  check(rcl_send_response(&service, &id, &response), "rcl_send_response");
  example_interfaces__srv__AddTwoInts_Request__fini(&request);
  example_interfaces__srv__AddTwoInts_Response__fini(&response);
}

int main(int argc, char** argv) {
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_init_options_t init_options = rcl_get_zero_initialized_init_options();
  rcl_context_t context = rcl_get_zero_initialized_context();
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_node_options_t node_options = rcl_node_get_default_options();
  rcl_publisher_options_t publisher_options = rcl_publisher_get_default_options();
  rcl_subscription_options_t subscription_options = rcl_subscription_get_default_options();
  rcl_service_options_t service_options = rcl_service_get_default_options();
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
  publisher = rcl_get_zero_initialized_publisher();
  subscription = rcl_get_zero_initialized_subscription();
  service = rcl_get_zero_initialized_service();

  check(rcl_init_options_init(&init_options, allocator), "rcl_init_options_init");
  check(rcl_init(argc, (const char* const*)argv, &init_options, &context), "rcl_init");
  check(rcl_node_init(&node, "c_node", "", &context, &node_options), "rcl_node_init");
  check(rcl_publisher_init(&publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, JointState), "doubled",
                           &publisher_options),
        "rcl_publisher_init");
  check(rcl_subscription_init(&subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, JointState), "joints",
                              &subscription_options),
        "rcl_subscription_init");
  check(rcl_service_init(&service, &node, ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts), "add",
                         &service_options),
        "rcl_service_init");
  check(rcl_wait_set_init(&wait_set, 1, 0, 0, 0, 1, 0, &context, allocator), "rcl_wait_set_init");

  bool has_answered = false;
  while (!has_answered) {
    check(rcl_wait_set_clear(&wait_set), "rcl_wait_set_clear");
    check(rcl_wait_set_add_subscription(&wait_set, &subscription, NULL), "rcl_wait_set_add_subscription");
    check(rcl_wait_set_add_service(&wait_set, &service, NULL), "rcl_wait_set_add_service");
    check(rcl_wait(&wait_set, -1), "rcl_wait");
    if (wait_set.subscriptions[0]) {
      echo_joints();
    }
    if (wait_set.services[0]) {
      answer();
      has_answered = true;
    }
  }

  check(rcl_wait_set_fini(&wait_set), "rcl_wait_set_fini");
  check(rcl_service_fini(&service, &node), "rcl_service_fini");
  check(rcl_subscription_fini(&subscription, &node), "rcl_subscription_fini");
  check(rcl_publisher_fini(&publisher, &node), "rcl_publisher_fini");
  check(rcl_node_fini(&node), "rcl_node_fini");
  check(rcl_shutdown(&context), "rcl_shutdown");
  check(rcl_context_fini(&context), "rcl_context_fini");
  check(rcl_init_options_fini(&init_options), "rcl_init_options_fini");
  puts("answered");
  return 0;
}
