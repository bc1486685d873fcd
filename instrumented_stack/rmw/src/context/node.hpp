// SPDX-License-Identifier: Apache-2.0
// Steps shared by the creation of all entities of a node. The mutex of the node's context must be held.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>

#include "endpoint/endpoint.hpp"
#include "faults/message_faults.hpp"
#include "rmw/types.h"

namespace rmw_fastrtps {

// Throws std::invalid_argument unless the name is the full name of a topic or service.
void check_topic_name(const char* topic_name);

// The faults of a test that name an endpoint of the node; null: none. `name` is that of its topic or service.
std::unique_ptr<MessageFaults> faults_of(rmw_message_faults::Side side, const std::string& name,
                                         const rmw_node_t* node);

// An entity enters the graph after its creation and leaves it before its destruction. All of its endpoints do so at
// once, in one announcement. Throw std::runtime_error.
void enter_graph(const rmw_node_t* node, std::initializer_list<EndpointIdentity> endpoints);
void leave_graph(const rmw_node_t* node, std::initializer_list<EndpointIdentity> endpoints);

}  // namespace rmw_fastrtps
