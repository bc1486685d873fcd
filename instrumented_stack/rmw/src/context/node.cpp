// SPDX-License-Identifier: Apache-2.0
// Nodes and the endpoints that they own. Every change is announced on ros_discovery_info.
#include "context/node.hpp"

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "context/context_impl.hpp"
#include "endpoint/endpoint.hpp"
#include "names/topic_name.hpp"
#include "process/end_of_process.hpp"
#include "qos/best_available.hpp"
#include "rmw/error_handling.h"
#include "rmw/rmw.h"
#include "rmw/validate_full_topic_name.h"
#include "rmw/validate_namespace.h"
#include "rmw/validate_node_name.h"
#include "types/identifier.hpp"

using rmw_fastrtps::EndpointIdentity;
using rmw_fastrtps::GraphCache;
using rmw_fastrtps::GraphChannel;
using rmw_fastrtps::kIdentifier;
using rmw_fastrtps::Participant;

namespace {

struct Node {
  rmw_node_t handle{};
  std::string name;
  std::string namespace_;
};

const Node& node_of(const rmw_node_t* node) {
  return *static_cast<const Node*>(node->data);
}

void check_node_name(const char* name, const char* namespace_) {
  int result = RMW_NODE_NAME_VALID;
  if (rmw_validate_node_name(name, &result, nullptr) == RMW_RET_OK && result != RMW_NODE_NAME_VALID) {
    throw std::invalid_argument(std::string("invalid node name '") + name +
                                "': " + rmw_node_name_validation_result_string(result));
  }
  if (rmw_validate_namespace(namespace_, &result, nullptr) == RMW_RET_OK && result != RMW_NAMESPACE_VALID) {
    throw std::invalid_argument(std::string("invalid namespace '") + namespace_ +
                                "': " + rmw_namespace_validation_result_string(result));
  }
}

// Of a test, if its faults name the endpoint.
template <typename Handle>
void set_faults_of(Handle& handle, rmw_message_faults::Side side, const char* topic, const rmw_node_t* node) {
  if (auto faults = rmw_fastrtps::faults_of(side, topic, node)) {
    rmw_fastrtps::set_faults(handle, std::move(faults));
  }
}

// The endpoints that the profile of a new one depends on.
std::vector<GraphCache::OwnedEndpoint> other_side(const rmw_context_impl_t& context, GraphCache::Kind kind,
                                                  const std::string& topic, const rmw_qos_profile_t& profile) {
  if (!rmw_fastrtps::asks_for_best_available(profile)) {
    return {};
  }
  return context.graph.endpoints(kind,
                                 profile.avoid_ros_namespace_conventions ? topic : rmw_fastrtps::mangled_topic(topic));
}

void close_participant(rmw_context_impl_t& context) {
  if (rmw_fastrtps::process_ends()) {
    // They have been ended. In the child of a fork they have not, and their threads are missing.
    (void)context.channel.release();
    (void)context.participant.release();
    return;
  }
  const rmw_fastrtps::Gid gid = context.participant->gid();
  context.channel.reset();
  context.participant.reset();
  context.graph.remove_participant(gid);
}

}  // namespace

namespace rmw_fastrtps {

void check_topic_name(const char* topic_name) {
  int result = RMW_TOPIC_VALID;
  if (rmw_validate_full_topic_name(topic_name, &result, nullptr) == RMW_RET_OK && result != RMW_TOPIC_VALID) {
    throw std::invalid_argument(std::string("invalid topic name '") + topic_name +
                                "': " + rmw_full_topic_name_validation_result_string(result));
  }
}

std::unique_ptr<MessageFaults> faults_of(rmw_message_faults::Side side, const std::string& name,
                                         const rmw_node_t* node) {
  const std::string& name_space = node_of(node).namespace_;
  return MessageFaults::of(side, name, name_space + (name_space.ends_with('/') ? "" : "/") + node_of(node).name);
}

void enter_graph(const rmw_node_t* node, std::initializer_list<EndpointIdentity> endpoints) {
  rmw_context_impl_t& context = *node->context->impl;
  GraphCache::EntitiesInfo info;
  for (const EndpointIdentity& endpoint : endpoints) {
    context.graph.add_endpoint(endpoint.gid, endpoint.names);
    info = context.graph.add_node_endpoint(context.participant->gid(), node_of(node).namespace_, node_of(node).name,
                                           endpoint.names.kind, endpoint.gid);
  }
  context.channel->announce(std::move(info));
}

void leave_graph(const rmw_node_t* node, std::initializer_list<EndpointIdentity> endpoints) {
  rmw_context_impl_t& context = *node->context->impl;
  GraphCache::EntitiesInfo info;
  for (const EndpointIdentity& endpoint : endpoints) {
    context.graph.remove_endpoint(endpoint.gid);
    info = context.graph.remove_node_endpoint(context.participant->gid(), node_of(node).namespace_, node_of(node).name,
                                              endpoint.names.kind, endpoint.gid);
  }
  context.channel->announce(std::move(info));
}

}  // namespace rmw_fastrtps

rmw_node_t* rmw_create_node(rmw_context_t* context, const char* name, const char* namespace_) try {
  RMW_CHECK_HANDLE(context, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(name, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(namespace_, nullptr);
  check_node_name(name, namespace_);
  rmw_context_impl_t& impl = *context->impl;
  std::lock_guard lock(impl.mutex);
  if (impl.shut_down) {
    RMW_SET_ERROR_MSG("a node cannot be created in a context that was shut down");
    return nullptr;
  }
  auto node = std::make_unique<Node>();
  node->name = name;
  node->namespace_ = namespace_;
  node->handle = {kIdentifier, node.get(), node->name.c_str(), node->namespace_.c_str(), context};
  try {
    if (impl.nodes == 0) {
      impl.participant = std::make_unique<Participant>(context->options, impl.graph);
      impl.channel = std::make_unique<GraphChannel>(*context, *impl.participant, impl.graph);
    }
    impl.channel->announce(impl.graph.add_node(impl.participant->gid(), node->namespace_, node->name));
  } catch (...) {
    if (impl.nodes == 0 && impl.participant != nullptr) {
      close_participant(impl);
    }
    throw;
  }
  ++impl.nodes;
  return &node.release()->handle;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return nullptr;
}

rmw_ret_t rmw_destroy_node(rmw_node_t* node) try {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  rmw_context_impl_t& impl = *node->context->impl;
  const std::unique_ptr<const Node> owned(&node_of(node));
  std::lock_guard lock(impl.mutex);
  auto info = impl.graph.remove_node(impl.participant->gid(), owned->namespace_, owned->name);
  if (--impl.nodes == 0) {
    // The end of the participant tells the others that the node is gone.
    close_participant(impl);
  } else {
    impl.channel->announce(std::move(info));
  }
  return RMW_RET_OK;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return RMW_RET_ERROR;
}

const rmw_guard_condition_t* rmw_node_get_graph_guard_condition(const rmw_node_t* node) {
  RMW_CHECK_HANDLE(node, nullptr);
  return &node->context->impl->graph_guard_condition;
}

rmw_publisher_t* rmw_create_publisher(const rmw_node_t* node, const rosidl_message_type_support_t* type_support,
                                      const char* topic_name, const rmw_qos_profile_t* qos_profile,
                                      const rmw_publisher_options_t* publisher_options) try {
  RMW_CHECK_HANDLE(node, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(topic_name, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(qos_profile, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(publisher_options, nullptr);
  if (!qos_profile->avoid_ros_namespace_conventions) {
    rmw_fastrtps::check_topic_name(topic_name);
  }
  rmw_context_impl_t& impl = *node->context->impl;
  std::lock_guard lock(impl.mutex);
  const rmw_qos_profile_t profile = rmw_fastrtps::best_available_for_publisher(
      *qos_profile, other_side(impl, GraphCache::Kind::kReader, topic_name, *qos_profile));
  rmw_publisher_t* publisher =
      rmw_fastrtps::create_publisher(*impl.participant, *type_support, topic_name, profile, *publisher_options);
  try {
    set_faults_of(*publisher, rmw_message_faults::Side::kPublish, topic_name, node);
    rmw_fastrtps::enter_graph(node, {rmw_fastrtps::identity_of(*publisher)});
  } catch (...) {
    impl.graph.remove_endpoint(rmw_fastrtps::identity_of(*publisher).gid);
    rmw_fastrtps::destroy_publisher(publisher);
    throw;
  }
  return publisher;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return nullptr;
}

rmw_ret_t rmw_destroy_publisher(rmw_node_t* node, rmw_publisher_t* publisher) try {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  std::lock_guard lock(node->context->impl->mutex);
  const EndpointIdentity identity = rmw_fastrtps::identity_of(*publisher);
  rmw_fastrtps::destroy_publisher(publisher);
  rmw_fastrtps::leave_graph(node, {identity});
  return RMW_RET_OK;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return RMW_RET_ERROR;
}

rmw_subscription_t* rmw_create_subscription(const rmw_node_t* node, const rosidl_message_type_support_t* type_support,
                                            const char* topic_name, const rmw_qos_profile_t* qos_policies,
                                            const rmw_subscription_options_t* subscription_options) try {
  RMW_CHECK_HANDLE(node, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(topic_name, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(qos_policies, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(subscription_options, nullptr);
  if (!qos_policies->avoid_ros_namespace_conventions) {
    rmw_fastrtps::check_topic_name(topic_name);
  }
  rmw_context_impl_t& impl = *node->context->impl;
  std::lock_guard lock(impl.mutex);
  const rmw_qos_profile_t profile = rmw_fastrtps::best_available_for_subscription(
      *qos_policies, other_side(impl, GraphCache::Kind::kWriter, topic_name, *qos_policies));
  rmw_subscription_t* subscription =
      rmw_fastrtps::create_subscription(*impl.participant, *type_support, topic_name, profile, *subscription_options);
  rmw_fastrtps::set_node(*subscription, *node);
  try {
    set_faults_of(*subscription, rmw_message_faults::Side::kTake, topic_name, node);
    rmw_fastrtps::enter_graph(node, {rmw_fastrtps::identity_of(*subscription)});
  } catch (...) {
    impl.graph.remove_endpoint(rmw_fastrtps::identity_of(*subscription).gid);
    rmw_fastrtps::destroy_subscription(subscription);
    throw;
  }
  return subscription;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return nullptr;
}

rmw_ret_t rmw_destroy_subscription(rmw_node_t* node, rmw_subscription_t* subscription) try {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  std::lock_guard lock(node->context->impl->mutex);
  const EndpointIdentity identity = rmw_fastrtps::identity_of(*subscription);
  rmw_fastrtps::destroy_subscription(subscription);
  rmw_fastrtps::leave_graph(node, {identity});
  return RMW_RET_OK;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return RMW_RET_ERROR;
}
