// SPDX-License-Identifier: Apache-2.0
// Services and clients of rcl: names, and a call through a wait set.
#include "rcl_test.hpp"
#include "rosidl_typesupport_cpp/service_type_support.hpp"
#include "std_srvs/srv/set_bool.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using rcl_test::Context;
using rcl_test::kPatience;
using rcl_test::Node;
using rcl_test::take_error;
using std_srvs::srv::SetBool;

const rosidl_service_type_support_t* set_bool_support() {
  return rosidl_typesupport_cpp::get_service_type_support_handle<SetBool>();
}

class Service {
 public:
  Service(Node& node, const char* name) : node_(node) {
    const rcl_service_options_t options = rcl_service_get_default_options();
    result = rcl_service_init(&handle, &node.handle, set_bool_support(), name, &options);
  }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  ~Service() { EXPECT_EQ(rcl_service_fini(&handle, &node_.handle), RCL_RET_OK); }

  std::string name() const { return rcl_service_get_service_name(&handle); }

  rcl_service_t handle = rcl_get_zero_initialized_service();
  rcl_ret_t result;

 private:
  Node& node_;
};

class Client {
 public:
  Client(Node& node, const char* name) : node_(node) {
    const rcl_client_options_t options = rcl_client_get_default_options();
    result = rcl_client_init(&handle, &node.handle, set_bool_support(), name, &options);
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() { EXPECT_EQ(rcl_client_fini(&handle, &node_.handle), RCL_RET_OK); }

  std::string name() const { return rcl_client_get_service_name(&handle); }

  rcl_client_t handle = rcl_get_zero_initialized_client();
  rcl_ret_t result;

 private:
  Node& node_;
};

TEST(RclService, NamesAreExpandedAndRemapped) {
  const test_support::Sandbox sandbox;
  Context context(
      {"program", "--ros-args", "-r", "switch:=lights", "-r", "rosservice://door:=gate", "-r", "rostopic://own:=x"});
  Node node(context, "node", "/ns");
  EXPECT_EQ(Service(node, "switch").name(), "/ns/lights");
  EXPECT_EQ(Service(node, "door").name(), "/ns/gate");
  EXPECT_EQ(Client(node, "~/own").name(), "/ns/node/own");
  EXPECT_EQ(Client(node, "own").name(), "/ns/own");
}

TEST(RclService, WrongNamesAndASecondInitAreRefused) {
  const test_support::Sandbox sandbox;
  Context context;
  Node node(context, "node");
  Service wrong(node, "a b");
  EXPECT_EQ(wrong.result, RCL_RET_SERVICE_NAME_INVALID);
  EXPECT_EQ(take_error(),
            "invalid topic name 'a b', at character 2: topic name must not contain characters other than letters, "
            "digits, '_', '/', '~', '{' "
            "and '}'");
  Client client(node, "{what}");
  EXPECT_EQ(client.result, RCL_RET_SERVICE_NAME_INVALID);
  rcl_reset_error();
  Service service(node, "switch");
  const rcl_service_options_t options = rcl_service_get_default_options();
  EXPECT_EQ(rcl_service_init(&service.handle, &node.handle, set_bool_support(), "switch", &options),
            RCL_RET_ALREADY_INIT);
  EXPECT_EQ(take_error(), "the service is initialized already");
}

TEST(RclService, WaitSetTellsOfRequestAndResponse) {
  const test_support::Sandbox sandbox;
  Context context;
  Node node(context, "node");
  Service service(node, "switch");
  Client client(node, "switch");
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
  ASSERT_EQ(rcl_wait_set_init(&wait_set, 0, 1, 0, 1, 1, 0, &context.handle, rcl_get_default_allocator()), RCL_RET_OK);
  bool available = false;
  while (rcl_service_server_is_available(&node.handle, &client.handle, &available) == RCL_RET_OK && !available) {
    ASSERT_EQ(rcl_wait_set_clear(&wait_set), RCL_RET_OK);
    ASSERT_EQ(rcl_wait_set_add_guard_condition(&wait_set, rcl_node_get_graph_guard_condition(&node.handle), nullptr),
              RCL_RET_OK);
    ASSERT_EQ(rcl_wait(&wait_set, kPatience), RCL_RET_OK);
  }
  const auto wait = [&] {
    EXPECT_EQ(rcl_wait_set_clear(&wait_set), RCL_RET_OK);
    EXPECT_EQ(rcl_wait_set_add_service(&wait_set, &service.handle, nullptr), RCL_RET_OK);
    EXPECT_EQ(rcl_wait_set_add_client(&wait_set, &client.handle, nullptr), RCL_RET_OK);
    EXPECT_EQ(rcl_wait(&wait_set, kPatience), RCL_RET_OK);
  };

  SetBool::Request request;
  request.data = true;
  int64_t sequence = 0;
  ASSERT_EQ(rcl_send_request(&client.handle, &request, &sequence), RCL_RET_OK);
  wait();
  EXPECT_EQ(wait_set.services[0], &service.handle);
  EXPECT_EQ(wait_set.clients[0], nullptr);
  rmw_request_id_t header{};
  SetBool::Request received;
  ASSERT_EQ(rcl_take_request(&service.handle, &header, &received), RCL_RET_OK);
  EXPECT_TRUE(received.data);
  EXPECT_EQ(rcl_take_request(&service.handle, &header, &received), RCL_RET_SERVICE_TAKE_FAILED);

  SetBool::Response response;
  response.message = "on";
  ASSERT_EQ(rcl_send_response(&service.handle, &header, &response), RCL_RET_OK);
  wait();
  EXPECT_EQ(wait_set.services[0], nullptr);
  EXPECT_EQ(wait_set.clients[0], &client.handle);
  rmw_request_id_t answered{};
  SetBool::Response answer;
  ASSERT_EQ(rcl_take_response(&client.handle, &answered, &answer), RCL_RET_OK);
  EXPECT_EQ(answer.message, "on");
  EXPECT_EQ(answered.sequence_number, sequence);
  EXPECT_EQ(rcl_take_response(&client.handle, &answered, &answer), RCL_RET_CLIENT_TAKE_FAILED);
  EXPECT_EQ(rcl_wait_set_fini(&wait_set), RCL_RET_OK);
}

}  // namespace
