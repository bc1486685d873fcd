// SPDX-License-Identifier: Apache-2.0
// Events of publishers and subscriptions besides messages. rmw_wait() waits for them.
#pragma once

#include <stdbool.h>

#include "rmw/event_callback_type.h"
#include "rmw/events_statuses.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum rmw_event_type_e {
  // of subscriptions
  RMW_EVENT_LIVELINESS_CHANGED,              // rmw_liveliness_changed_status_t
  RMW_EVENT_REQUESTED_DEADLINE_MISSED,       // rmw_requested_deadline_missed_status_t
  RMW_EVENT_REQUESTED_QOS_INCOMPATIBLE,      // rmw_requested_qos_incompatible_event_status_t
  RMW_EVENT_MESSAGE_LOST,                    // rmw_message_lost_status_t
  RMW_EVENT_SUBSCRIPTION_INCOMPATIBLE_TYPE,  // rmw_incompatible_type_status_t
  RMW_EVENT_SUBSCRIPTION_MATCHED,            // rmw_matched_status_t
  // of publishers
  RMW_EVENT_LIVELINESS_LOST,              // rmw_liveliness_lost_status_t
  RMW_EVENT_OFFERED_DEADLINE_MISSED,      // rmw_offered_deadline_missed_status_t
  RMW_EVENT_OFFERED_QOS_INCOMPATIBLE,     // rmw_offered_qos_incompatible_event_status_t
  RMW_EVENT_PUBLISHER_INCOMPATIBLE_TYPE,  // rmw_incompatible_type_status_t
  RMW_EVENT_PUBLICATION_MATCHED,          // rmw_matched_status_t
  RMW_EVENT_INVALID
} rmw_event_type_t;

// `data` is what rmw_wait() takes. It belongs to the publisher or subscription, which must outlive the event.
typedef struct rmw_event_s {
  const char* implementation_identifier;
  void* data;
  rmw_event_type_t event_type;
} rmw_event_t;

rmw_event_t rmw_get_zero_initialized_event(void);
bool rmw_event_type_is_supported(rmw_event_type_t rmw_event_type);

// Several events of one type share one status: taking it from one takes it from all. Returns RMW_RET_UNSUPPORTED if the
// type does not exist or is not one of this endpoint.
rmw_ret_t rmw_publisher_event_init(rmw_event_t* rmw_event, const rmw_publisher_t* publisher,
                                   rmw_event_type_t event_type);
rmw_ret_t rmw_subscription_event_init(rmw_event_t* rmw_event, const rmw_subscription_t* subscription,
                                      rmw_event_type_t event_type);
rmw_ret_t rmw_event_fini(rmw_event_t* event);

// Copies the status, of the type above, into `event_info` and sets its changes back to 0. `taken` is always true,
// because there is always a status.
rmw_ret_t rmw_take_event(const rmw_event_t* event_handle, void* event_info, bool* taken);

// Null ends the calls: none is running any more when this returns. Must not be called from the callback.
rmw_ret_t rmw_event_set_callback(rmw_event_t* event, rmw_event_callback_t callback, const void* user_data);

#ifdef __cplusplus
}
#endif
