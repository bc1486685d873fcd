// SPDX-License-Identifier: Apache-2.0
// Both ends of a service that adds two numbers, with failures as test failures.
#pragma once

#include <cstdint>

#include "example_interfaces/srv/add_two_ints.hpp"
#include "rmw_test.hpp"
#include "rosidl_typesupport_cpp/service_type_support.hpp"

namespace rmw_test {

using example_interfaces::srv::AddTwoInts;

template <typename ServiceT>
const rosidl_service_type_support_t* type_support() {
  return rosidl_typesupport_cpp::get_service_type_support_handle<ServiceT>();
}

class Service {
 public:
  Service(Node& node, const char* name)
      : node_(node),
        handle(rmw_create_service(node.handle, type_support<AddTwoInts>(), name, &rmw_qos_profile_services_default)) {
    EXPECT_NE(handle, nullptr) << take_error();
    wait_set_ = rmw_create_wait_set(&node.context_.handle, 1);
  }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  ~Service() {
    EXPECT_EQ(rmw_destroy_wait_set(wait_set_), RMW_RET_OK);
    EXPECT_EQ(rmw_destroy_service(node_.handle, handle), RMW_RET_OK) << take_error();
  }

  rmw_ret_t wait(const rmw_time_t& timeout) {
    void* entity = handle->data;
    rmw_services_t services{1, &entity};
    return rmw_wait(nullptr, nullptr, &services, nullptr, nullptr, wait_set_, &timeout);
  }
  bool take(rmw_service_info_t& info, AddTwoInts::Request& request) {
    bool taken = false;
    EXPECT_EQ(rmw_take_request(handle, &info, &request, &taken), RMW_RET_OK);
    return taken;
  }
  rmw_ret_t respond(rmw_service_info_t& info, int64_t sum) {
    AddTwoInts::Response response;
    response.sum = sum;
    return rmw_send_response(handle, &info.request_id, &response);
  }
  // Waits for a request and answers it.
  void serve() {
    rmw_service_info_t info{};
    AddTwoInts::Request request;
    ASSERT_EQ(wait(kPatience), RMW_RET_OK);
    ASSERT_TRUE(take(info, request));
    ASSERT_EQ(respond(info, request.a + request.b), RMW_RET_OK) << take_error();
  }

  Node& node_;
  rmw_service_t* handle;

 private:
  rmw_wait_set_t* wait_set_ = nullptr;
};

class Client {
 public:
  Client(Node& node, const char* name)
      : node_(node),
        handle(rmw_create_client(node.handle, type_support<AddTwoInts>(), name, &rmw_qos_profile_services_default)) {
    EXPECT_NE(handle, nullptr) << take_error();
    wait_set_ = rmw_create_wait_set(&node.context_.handle, 1);
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() {
    EXPECT_EQ(rmw_destroy_wait_set(wait_set_), RMW_RET_OK);
    EXPECT_EQ(rmw_destroy_client(node_.handle, handle), RMW_RET_OK) << take_error();
  }

  bool is_available() const {
    bool available = false;
    EXPECT_EQ(rmw_service_server_is_available(node_.handle, handle, &available), RMW_RET_OK);
    return available;
  }
  void wait_for_service() {
    node_.wait_for_graph([this] { return is_available(); });
  }
  int64_t send(int64_t a, int64_t b) {
    AddTwoInts::Request request;
    request.a = a;
    request.b = b;
    int64_t sequence = 0;
    EXPECT_EQ(rmw_send_request(handle, &request, &sequence), RMW_RET_OK) << take_error();
    return sequence;
  }
  rmw_ret_t wait(const rmw_time_t& timeout) {
    void* entity = handle->data;
    rmw_clients_t clients{1, &entity};
    return rmw_wait(nullptr, nullptr, nullptr, &clients, nullptr, wait_set_, &timeout);
  }
  bool take(rmw_service_info_t& info, AddTwoInts::Response& response) {
    bool taken = false;
    EXPECT_EQ(rmw_take_response(handle, &info, &response, &taken), RMW_RET_OK);
    return taken;
  }

  Node& node_;
  rmw_client_t* handle;

 private:
  rmw_wait_set_t* wait_set_ = nullptr;
};

}  // namespace rmw_test
