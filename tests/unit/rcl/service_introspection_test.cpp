// SPDX-License-Identifier: Apache-2.0
// Introspection of services and clients in rcl: the topic, and the errors.
#include <string>

#include "rcl_test.hpp"
#include "rosidl_typesupport_cpp/service_type_support.hpp"
#include "std_srvs/srv/set_bool.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using rcl_test::Context;
using rcl_test::Node;
using rcl_test::take_error;

const rosidl_service_type_support_t* type_support() {
  return rosidl_typesupport_cpp::get_service_type_support_handle<std_srvs::srv::SetBool>();
}

// A service and a client of /lights; the program calls it switch.
class RclServiceIntrospection : public ::testing::Test {
 protected:
  RclServiceIntrospection() {
    rcl_allocator_t allocator = rcl_get_default_allocator();
    EXPECT_EQ(rcl_clock_init(RCL_SYSTEM_TIME, &clock_, &allocator), RCL_RET_OK);
    const rcl_service_options_t service_options = rcl_service_get_default_options();
    EXPECT_EQ(rcl_service_init(&service_, &node_.handle, type_support(), "switch", &service_options), RCL_RET_OK);
    const rcl_client_options_t client_options = rcl_client_get_default_options();
    EXPECT_EQ(rcl_client_init(&client_, &node_.handle, type_support(), "switch", &client_options), RCL_RET_OK);
  }
  ~RclServiceIntrospection() override {
    EXPECT_EQ(rcl_client_fini(&client_, &node_.handle), RCL_RET_OK);
    EXPECT_EQ(rcl_service_fini(&service_, &node_.handle), RCL_RET_OK);
    EXPECT_EQ(rcl_clock_fini(&clock_), RCL_RET_OK);
  }

  rcl_ret_t configure_service(rcl_service_introspection_state_t state) {
    return rcl_service_configure_service_introspection(&service_, &node_.handle, &clock_, type_support(),
                                                       rcl_publisher_get_default_options(), state);
  }
  rcl_ret_t configure_client(rcl_service_introspection_state_t state) {
    return rcl_client_configure_service_introspection(&client_, &node_.handle, &clock_, type_support(),
                                                      rcl_publisher_get_default_options(), state);
  }

  // Of events, the node's own, which it knows at once.
  size_t publishers() {
    size_t count = 0;
    EXPECT_EQ(rcl_count_publishers(&node_.handle, "/lights" RCL_SERVICE_INTROSPECTION_TOPIC_POSTFIX, &count),
              RCL_RET_OK);
    return count;
  }

  test_support::Sandbox sandbox_;
  Context context_{{"program", "--ros-args", "-r", "switch:=/lights"}};
  Node node_{context_, "node"};
  rcl_clock_t clock_{};
  rcl_service_t service_ = rcl_get_zero_initialized_service();
  rcl_client_t client_ = rcl_get_zero_initialized_client();
};

TEST_F(RclServiceIntrospection, EachEndHasAPublisherWhileItIsOn) {
  EXPECT_EQ(publishers(), 0u);
  EXPECT_EQ(configure_service(RCL_SERVICE_INTROSPECTION_OFF), RCL_RET_OK);
  EXPECT_EQ(publishers(), 0u);
  EXPECT_EQ(configure_service(RCL_SERVICE_INTROSPECTION_METADATA), RCL_RET_OK);
  EXPECT_EQ(publishers(), 1u);
  EXPECT_EQ(configure_service(RCL_SERVICE_INTROSPECTION_CONTENTS), RCL_RET_OK);
  EXPECT_EQ(publishers(), 1u);
  EXPECT_EQ(configure_client(RCL_SERVICE_INTROSPECTION_CONTENTS), RCL_RET_OK);
  EXPECT_EQ(publishers(), 2u);
  EXPECT_EQ(configure_service(RCL_SERVICE_INTROSPECTION_OFF), RCL_RET_OK);
  EXPECT_EQ(publishers(), 1u);
  EXPECT_EQ(configure_client(RCL_SERVICE_INTROSPECTION_OFF), RCL_RET_OK);
  EXPECT_EQ(publishers(), 0u);
  EXPECT_EQ(configure_client(RCL_SERVICE_INTROSPECTION_METADATA), RCL_RET_OK);
  EXPECT_EQ(publishers(), 1u);
}

TEST_F(RclServiceIntrospection, EndsWithTheServiceAndTheClient) {
  EXPECT_EQ(configure_service(RCL_SERVICE_INTROSPECTION_METADATA), RCL_RET_OK);
  EXPECT_EQ(configure_client(RCL_SERVICE_INTROSPECTION_METADATA), RCL_RET_OK);
  EXPECT_EQ(rcl_service_fini(&service_, &node_.handle), RCL_RET_OK);
  EXPECT_EQ(publishers(), 1u);
  EXPECT_EQ(rcl_client_fini(&client_, &node_.handle), RCL_RET_OK);
  EXPECT_EQ(publishers(), 0u);
}

TEST_F(RclServiceIntrospection, WrongArgumentsAreRefused) {
  const rcl_publisher_options_t options = rcl_publisher_get_default_options();
  constexpr auto kOn = RCL_SERVICE_INTROSPECTION_CONTENTS;
  const auto refused = [&](rcl_service_t* service, rcl_node_t* node, rcl_clock_t* clock,
                           const rosidl_service_type_support_t* type, rcl_service_introspection_state_t state) {
    const rcl_ret_t result = rcl_service_configure_service_introspection(service, node, clock, type, options, state);
    return std::to_string(result) + ": " + take_error();
  };
  rcl_service_t none = rcl_get_zero_initialized_service();
  EXPECT_EQ(refused(nullptr, &node_.handle, &clock_, type_support(), kOn), "600: the service is null");
  EXPECT_EQ(refused(&none, &node_.handle, &clock_, type_support(), kOn), "600: the service is not initialized");
  EXPECT_EQ(refused(&service_, nullptr, &clock_, type_support(), kOn), "11: node argument is null");
  EXPECT_EQ(refused(&service_, &node_.handle, nullptr, type_support(), kOn), "11: clock argument is null");
  EXPECT_EQ(refused(&service_, &node_.handle, &clock_, nullptr, kOn), "11: type_support argument is null");
  EXPECT_EQ(
      refused(&service_, &node_.handle, &clock_, type_support(), static_cast<rcl_service_introspection_state_t>(3)),
      "11: there is no such state of service introspection");
  rcl_clock_t no_clock{};
  EXPECT_EQ(refused(&service_, &node_.handle, &no_clock, type_support(), kOn), "11: the clock is not initialized");
  rcl_node_t no_node = rcl_get_zero_initialized_node();
  EXPECT_EQ(refused(&service_, &no_node, &clock_, type_support(), kOn), "200: the node is not initialized");
  rosidl_service_type_support_t without_event = *type_support();
  without_event.event_typesupport = nullptr;
  EXPECT_EQ(refused(&service_, &node_.handle, &clock_, &without_event, kOn),
            "11: the type support of the service has no event message");
  EXPECT_EQ(publishers(), 0u);

  rcl_client_t no_client = rcl_get_zero_initialized_client();
  EXPECT_EQ(
      rcl_client_configure_service_introspection(&no_client, &node_.handle, &clock_, type_support(), options, kOn),
      RCL_RET_CLIENT_INVALID);
  EXPECT_EQ(take_error(), "the client is not initialized");
  EXPECT_EQ(rcl_client_configure_service_introspection(&client_, &node_.handle, nullptr, type_support(), options, kOn),
            RCL_RET_INVALID_ARGUMENT);
  EXPECT_EQ(take_error(), "clock argument is null");
}

TEST_F(RclServiceIntrospection, FailureLeavesItAsItWas) {
  ASSERT_EQ(configure_service(RCL_SERVICE_INTROSPECTION_CONTENTS), RCL_RET_OK);
  EXPECT_EQ(configure_service(static_cast<rcl_service_introspection_state_t>(3)), RCL_RET_INVALID_ARGUMENT);
  rcl_reset_error();
  rcl_node_t no_node = rcl_get_zero_initialized_node();
  EXPECT_EQ(
      rcl_service_configure_service_introspection(&service_, &no_node, &clock_, type_support(),
                                                  rcl_publisher_get_default_options(), RCL_SERVICE_INTROSPECTION_OFF),
      RCL_RET_NODE_INVALID);
  rcl_reset_error();
  EXPECT_EQ(publishers(), 1u);
  EXPECT_EQ(configure_service(RCL_SERVICE_INTROSPECTION_OFF), RCL_RET_OK);
  EXPECT_EQ(publishers(), 0u);
}

}  // namespace
