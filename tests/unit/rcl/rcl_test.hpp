// SPDX-License-Identifier: Apache-2.0
// The common part of the tests of rcl: owners for its C handles.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rcl/error_handling.h"
#include "rcl/rcl.h"
#include "rmw/rmw.h"

namespace rcl_test {

// A longer wait than this for messages that must come ends a broken test.
constexpr int64_t kPatience = 10'000'000'000;

// Takes the error of this thread, without the source place at its end.
inline std::string take_error() {
  const rcl_error_state_t* state = rcl_get_error_state();
  const std::string message = state == nullptr ? "" : state->message;
  rcl_reset_error();
  return message;
}

// A string from rcl, empty for null.
inline std::string take_string(char* text) {
  const std::string result = text == nullptr ? "" : text;
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  allocator.deallocate(text, allocator.state);
  return result;
}

class Arguments {
 public:
  explicit Arguments(const std::vector<std::string>& arguments) : texts_(arguments) {
    for (const std::string& text : texts_) {
      argv_.push_back(text.c_str());
    }
    result = rcl_parse_arguments(static_cast<int>(argv_.size()), argv_.data(), rcl_get_default_allocator(), &handle);
    error = take_error();
  }
  Arguments(const Arguments&) = delete;
  Arguments& operator=(const Arguments&) = delete;
  ~Arguments() {
    if (handle.impl != nullptr) {
      (void)rcl_arguments_fini(&handle);
    }
  }

  const char* const* argv() const { return argv_.data(); }

  rcl_arguments_t handle = rcl_get_zero_initialized_arguments();
  rcl_ret_t result;
  std::string error;

 private:
  std::vector<std::string> texts_;
  std::vector<const char*> argv_;
};

// A context between rcl_init() and rcl_shutdown().
class Context {
 public:
  explicit Context(const std::vector<std::string>& arguments = {}) {
    std::vector<const char*> argv;
    for (const std::string& argument : arguments) {
      argv.push_back(argument.c_str());
    }
    rcl_init_options_t options = rcl_get_zero_initialized_init_options();
    EXPECT_EQ(rcl_init_options_init(&options, rcl_get_default_allocator()), RCL_RET_OK);
    EXPECT_EQ(rcl_init(static_cast<int>(argv.size()), argv.data(), &options, &handle), RCL_RET_OK) << take_error();
    EXPECT_EQ(rcl_init_options_fini(&options), RCL_RET_OK);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() {
    if (rcl_context_is_valid(&handle)) {
      EXPECT_EQ(rcl_shutdown(&handle), RCL_RET_OK);
    }
    EXPECT_EQ(rcl_context_fini(&handle), RCL_RET_OK) << take_error();
  }

  rcl_context_t handle = rcl_get_zero_initialized_context();
};

class Node {
 public:
  Node(Context& context, const std::string& name, const std::string& namespace_ = "/",
       const rcl_node_options_t& options = rcl_node_get_default_options()) {
    result = rcl_node_init(&handle, name.c_str(), namespace_.c_str(), &context.handle, &options);
    error = take_error();
  }
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  ~Node() { EXPECT_EQ(rcl_node_fini(&handle), RCL_RET_OK) << take_error(); }

  // The name that a topic gets on this node, or the error.
  std::string resolve(const std::string& topic) {
    char* output = nullptr;
    const rcl_ret_t resolved =
        rcl_node_resolve_name(&handle, topic.c_str(), rcl_get_default_allocator(), false, false, &output);
    return resolved == RCL_RET_OK ? take_string(output) : take_error();
  }

  rcl_node_t handle = rcl_get_zero_initialized_node();
  rcl_ret_t result;
  std::string error;
};

}  // namespace rcl_test
