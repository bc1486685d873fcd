// SPDX-License-Identifier: Apache-2.0
// What the events of publishers and subscriptions tell. Totals count since the endpoint was created, changes since the
// event was last taken.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "rmw/qos_policy_kind.h"

#ifdef __cplusplus
extern "C" {
#endif

// Of a publisher: its own lease ran out. It is told once per loss.
typedef struct rmw_liveliness_lost_status_s {
  int32_t total_count;
  int32_t total_count_change;
} rmw_liveliness_lost_status_t;

// Of a subscription: its matched publishers came alive, or ceased to be.
typedef struct rmw_liveliness_changed_status_s {
  int32_t alive_count;
  int32_t not_alive_count;
  int32_t alive_count_change;
  int32_t not_alive_count_change;
} rmw_liveliness_changed_status_t;

// Periods without a message.
typedef struct rmw_offered_deadline_missed_status_s {
  int32_t total_count;
  int32_t total_count_change;
} rmw_offered_deadline_missed_status_t;
typedef rmw_offered_deadline_missed_status_t rmw_requested_deadline_missed_status_t;

// Endpoints of the topic that cannot match, and the first policy at fault with the last of them.
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

// Endpoints of the topic at the other side that have another type.
typedef struct rmw_incompatible_type_status_s {
  int32_t total_count;
  int32_t total_count_change;
} rmw_incompatible_type_status_t;

// Matched endpoints at the other side: ever, and now.
typedef struct rmw_matched_status_s {
  size_t total_count;
  size_t total_count_change;
  size_t current_count;
  int32_t current_count_change;
} rmw_matched_status_t;

#ifdef __cplusplus
}
#endif
