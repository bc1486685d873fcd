// SPDX-License-Identifier: Apache-2.0
// The statuses of the events of publishers and subscriptions. Totals count since the endpoint was created, changes
// since the event was last taken.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "rmw/qos_policy_kind.h"

#ifdef __cplusplus
extern "C" {
#endif

// Of a publisher: its own lease ran out. Each loss is reported once.
typedef struct rmw_liveliness_lost_status_s {
  int32_t total_count;
  int32_t total_count_change;
} rmw_liveliness_lost_status_t;

// Of a subscription: its matched publishers became alive or stopped being alive.
typedef struct rmw_liveliness_changed_status_s {
  int32_t alive_count;
  int32_t not_alive_count;
  int32_t alive_count_change;
  int32_t not_alive_count_change;
} rmw_liveliness_changed_status_t;

// Deadline periods without a message.
typedef struct rmw_offered_deadline_missed_status_s {
  int32_t total_count;
  int32_t total_count_change;
} rmw_offered_deadline_missed_status_t;

typedef struct rmw_requested_deadline_missed_status_s {
  int32_t total_count;
  int32_t total_count_change;
} rmw_requested_deadline_missed_status_t;

// Endpoints of the topic that cannot match. The policy is the first one that the last of them violates.
typedef struct rmw_qos_incompatible_event_status_s {
  int32_t total_count;
  int32_t total_count_change;
  rmw_qos_policy_kind_t last_policy_kind;
} rmw_qos_incompatible_event_status_t;
typedef rmw_qos_incompatible_event_status_t rmw_requested_qos_incompatible_event_status_t;
typedef rmw_qos_incompatible_event_status_t rmw_offered_qos_incompatible_event_status_t;

// Messages that a subscription never got.
typedef struct rmw_message_lost_status_s {
  size_t total_count;
  size_t total_count_change;
} rmw_message_lost_status_t;

// Endpoints at the other side of the topic that have another type.
typedef struct rmw_incompatible_type_status_s {
  int32_t total_count;
  int32_t total_count_change;
} rmw_incompatible_type_status_t;

// Matched endpoints at the other side: all so far, and the current ones.
typedef struct rmw_matched_status_s {
  size_t total_count;
  size_t total_count_change;
  size_t current_count;
  int32_t current_count_change;
} rmw_matched_status_t;

#ifdef __cplusplus
}
#endif
