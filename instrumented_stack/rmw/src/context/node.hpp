// SPDX-License-Identifier: Apache-2.0
// What the creation of every entity of a node shares. The mutex of the node's context must be held.
#pragma once

#include <initializer_list>

#include "endpoint/endpoint.hpp"
#include "rmw/types.h"

namespace rmw_fastrtps {

// Throws std::invalid_argument unless the name is that of a topic, or service, in full.
void check_topic_name(const char* topic_name);

// An entity enters the graph after its creation and leaves it before its destruction, all of its endpoints at once: one
// announcement. Throw std::runtime_error.
void enter_graph(const rmw_node_t* node, std::initializer_list<EndpointIdentity> endpoints);
void leave_graph(const rmw_node_t* node, std::initializer_list<EndpointIdentity> endpoints);

}  // namespace rmw_fastrtps
