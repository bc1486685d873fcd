// SPDX-License-Identifier: Apache-2.0
// Policies that are "best available": each becomes the strictest one that matches all endpoints at the other side of
// the topic that are known when the publisher or subscription is created. Later endpoints change nothing.
#pragma once

#include <vector>

#include "graph/graph_cache.hpp"
#include "rmw/types.h"

namespace rmw_fastrtps {

bool asks_for_best_available(const rmw_qos_profile_t& profile);

// Without publishers the policies are reliable, transient local and manual by topic, as in ROS 2.
rmw_qos_profile_t best_available_for_subscription(const rmw_qos_profile_t& profile,
                                                  const std::vector<GraphCache::OwnedEndpoint>& publishers);

// Reliable and transient local. The liveliness and the durations are those that the strictest subscription asks for.
rmw_qos_profile_t best_available_for_publisher(const rmw_qos_profile_t& profile,
                                               const std::vector<GraphCache::OwnedEndpoint>& subscriptions);

// Those of rmw_qos_profile_services_default.
rmw_qos_profile_t best_available_for_service(const rmw_qos_profile_t& profile);

}  // namespace rmw_fastrtps
