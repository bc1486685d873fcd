// SPDX-License-Identifier: Apache-2.0
// Adds statuses of DDS to statuses of rmw. DDS counts changes since the last call. rmw counts changes since the user
// last took the status.
#pragma once

#include <fastdds/dds/core/status/IncompatibleQosStatus.hpp>
#include <fastdds/dds/core/status/MatchedStatus.hpp>

#include "rmw/events_statuses.h"

namespace rmw_fastrtps {

inline rmw_qos_policy_kind_t policy_kind(eprosima::fastdds::dds::QosPolicyId_t id) {
  using namespace eprosima::fastdds::dds;
  switch (id) {
    case DURABILITY_QOS_POLICY_ID:
      return RMW_QOS_POLICY_DURABILITY;
    case DEADLINE_QOS_POLICY_ID:
      return RMW_QOS_POLICY_DEADLINE;
    case LIVELINESS_QOS_POLICY_ID:
      return RMW_QOS_POLICY_LIVELINESS;
    case RELIABILITY_QOS_POLICY_ID:
      return RMW_QOS_POLICY_RELIABILITY;
    case HISTORY_QOS_POLICY_ID:
      return RMW_QOS_POLICY_HISTORY;
    case LIFESPAN_QOS_POLICY_ID:
      return RMW_QOS_POLICY_LIFESPAN;
    default:
      return RMW_QOS_POLICY_INVALID;
  }
}

// Statuses with a total and its change.
template <typename DdsStatusT, typename StatusT>
void add_total(const DdsStatusT& told, StatusT& status) {
  using CountT = decltype(status.total_count);
  status.total_count = static_cast<CountT>(told.total_count);
  status.total_count_change += static_cast<CountT>(told.total_count_change);
}

inline void add_incompatible(const eprosima::fastdds::dds::IncompatibleQosStatus& told,
                             rmw_qos_incompatible_event_status_t& status) {
  add_total(told, status);
  status.last_policy_kind = policy_kind(told.last_policy_id);
}

inline void add_matched(const eprosima::fastdds::dds::MatchedStatus& told, rmw_matched_status_t& status) {
  add_total(told, status);
  status.current_count = static_cast<size_t>(told.current_count);
  status.current_count_change += told.current_count_change;
}

}  // namespace rmw_fastrtps
