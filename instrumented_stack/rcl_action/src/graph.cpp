// SPDX-License-Identifier: Apache-2.0
#include "rcl_action/graph.h"

#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rcl/error_handling.h"
#include "rcl_action/names.h"

namespace {

// Every action has this topic, from its servers to its clients, with its own type.
constexpr std::string_view kTopicSuffix = "/_action/feedback";
constexpr std::string_view kTypeSuffix = "_FeedbackMessage";

struct Action {
  std::string name;
  std::vector<std::string> types;
};

bool take_off(std::string_view& text, std::string_view suffix) {
  if (text.size() < suffix.size() || text.substr(text.size() - suffix.size()) != suffix) {
    return false;
  }
  text.remove_suffix(suffix.size());
  return true;
}

std::vector<Action> actions_among(const rcl_names_and_types_t& topics) {
  std::vector<Action> actions;
  for (size_t i = 0; i < topics.names.size; ++i) {
    std::string_view name = topics.names.data[i];
    if (!take_off(name, kTopicSuffix)) {
      continue;
    }
    Action& action = actions.emplace_back(Action{std::string(name), {}});
    for (size_t k = 0; k < topics.types[i].size; ++k) {
      std::string_view type = topics.types[i].data[k];
      take_off(type, kTypeSuffix);
      action.types.emplace_back(type);
    }
  }
  return actions;
}

bool fill(rcutils_string_array_t& array, size_t index, const std::string& text, const rcl_allocator_t& allocator) {
  array.data[index] = static_cast<char*>(allocator.allocate(text.size() + 1, allocator.state));
  if (array.data[index] == nullptr) {
    return false;
  }
  std::memcpy(array.data[index], text.c_str(), text.size() + 1);
  return true;
}

rcl_ret_t hand_out(const std::vector<Action>& actions, rcl_allocator_t& allocator, rcl_names_and_types_t* output) {
  if (const rmw_ret_t result = rmw_names_and_types_init(output, actions.size(), &allocator); result != RMW_RET_OK) {
    return result;
  }
  bool complete = true;
  for (size_t i = 0; complete && i < actions.size(); ++i) {
    const std::vector<std::string>& types = actions[i].types;
    complete = fill(output->names, i, actions[i].name, allocator) &&
               rcutils_string_array_init(&output->types[i], types.size(), &allocator) == RCUTILS_RET_OK;
    for (size_t k = 0; complete && k < types.size(); ++k) {
      complete = fill(output->types[i], k, types[k], allocator);
    }
  }
  if (!complete) {
    (void)rcl_names_and_types_fini(output);
    RCL_SET_ERROR_MSG("out of memory for the names of actions");
    return RCL_RET_BAD_ALLOC;
  }
  return RCL_RET_OK;
}

// `get_topics` fills in topics; the actions are found among them.
rcl_ret_t get_actions(const std::function<rcl_ret_t(rcl_names_and_types_t*)>& get_topics, rcl_allocator_t* allocator,
                      rcl_names_and_types_t* action_names_and_types) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(action_names_and_types, RCL_RET_INVALID_ARGUMENT);
  rcl_names_and_types_t topics = rcl_get_zero_initialized_names_and_types();
  if (const rcl_ret_t result = get_topics(&topics); result != RCL_RET_OK) {
    return result;
  }
  const std::vector<Action> actions = actions_among(topics);
  (void)rcl_names_and_types_fini(&topics);
  return hand_out(actions, *allocator, action_names_and_types);
}

// Each client and each server has one goal service.
template <typename CountT>
rcl_ret_t count_by_goal_service(CountT count_ends, const rcl_node_t* node, const char* action_name, size_t* count) {
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  char* service = nullptr;
  if (const rcl_ret_t result = rcl_action_get_goal_service_name(action_name, allocator, &service);
      result != RCL_RET_OK) {
    return result;
  }
  const rcl_ret_t result = count_ends(node, service, count);
  allocator.deallocate(service, allocator.state);
  return result;
}

}  // namespace

rcl_ret_t rcl_action_get_names_and_types(const rcl_node_t* node, rcl_allocator_t* allocator,
                                         rcl_names_and_types_t* action_names_and_types) {
  return get_actions(
      [&](rcl_names_and_types_t* topics) { return rcl_get_topic_names_and_types(node, allocator, false, topics); },
      allocator, action_names_and_types);
}

rcl_ret_t rcl_action_get_server_names_and_types_by_node(const rcl_node_t* node, rcl_allocator_t* allocator,
                                                        const char* node_name, const char* node_namespace,
                                                        rcl_names_and_types_t* action_names_and_types) {
  return get_actions(
      [&](rcl_names_and_types_t* topics) {
        return rcl_get_publisher_names_and_types_by_node(node, allocator, false, node_name, node_namespace, topics);
      },
      allocator, action_names_and_types);
}

rcl_ret_t rcl_action_get_client_names_and_types_by_node(const rcl_node_t* node, rcl_allocator_t* allocator,
                                                        const char* node_name, const char* node_namespace,
                                                        rcl_names_and_types_t* action_names_and_types) {
  return get_actions(
      [&](rcl_names_and_types_t* topics) {
        return rcl_get_subscriber_names_and_types_by_node(node, allocator, false, node_name, node_namespace, topics);
      },
      allocator, action_names_and_types);
}

rcl_ret_t rcl_action_count_clients(const rcl_node_t* node, const char* action_name, size_t* count) {
  return count_by_goal_service(rcl_count_clients, node, action_name, count);
}

rcl_ret_t rcl_action_count_servers(const rcl_node_t* node, const char* action_name, size_t* count) {
  return count_by_goal_service(rcl_count_services, node, action_name, count);
}
