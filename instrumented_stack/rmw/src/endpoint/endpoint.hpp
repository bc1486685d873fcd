// SPDX-License-Identifier: Apache-2.0
// Creates publishers and subscriptions without a node, for rmw_create_publisher() and for ros_discovery_info.
#pragma once

#include <memory>
#include <string>

#include "faults/message_faults.hpp"
#include "graph/graph_cache.hpp"
#include "rmw/rmw.h"
#include "types/gid.hpp"

namespace rmw_fastrtps {

class Participant;

// An endpoint as the graph knows it.
struct EndpointIdentity {
  Gid gid;
  GraphCache::Endpoint names;
};

// When a reliable writer asks its readers what they have received: also with messages, as Fast DDS does, or only from
// time to time.
enum class Heartbeats { kWithMessages, kPeriodic };

// Throw std::runtime_error. They fire rmw_publisher_init and rmw_subscription_init.
rmw_publisher_t* create_publisher(Participant& participant, const rosidl_message_type_support_t& type_support,
                                  const std::string& topic_name, const rmw_qos_profile_t& profile,
                                  const rmw_publisher_options_t& options,
                                  Heartbeats heartbeats = Heartbeats::kWithMessages);
rmw_subscription_t* create_subscription(Participant& participant, const rosidl_message_type_support_t& type_support,
                                        const std::string& topic_name, const rmw_qos_profile_t& profile,
                                        const rmw_subscription_options_t& options);

// Sets the node whose mutex and graph a subscription uses when its reader changes.
void set_node(const rmw_subscription_t& subscription, const rmw_node_t& node);

// The messages that go out, or are taken, suffer these faults. Their memory is not on loan from now on.
void set_faults(rmw_publisher_t& publisher, std::unique_ptr<MessageFaults> faults);
void set_faults(rmw_subscription_t& subscription, std::unique_ptr<MessageFaults> faults);

void destroy_publisher(rmw_publisher_t* publisher);
void destroy_subscription(rmw_subscription_t* subscription);

const EndpointIdentity& identity_of(const rmw_publisher_t& publisher);
const EndpointIdentity& identity_of(const rmw_subscription_t& subscription);

}  // namespace rmw_fastrtps
