// SPDX-License-Identifier: Apache-2.0
// How the middleware tells of messages, requests, responses and events to whoever does not wait for them.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Called from threads of the middleware, and once from the function that sets it if something came before: it must only
// take note. `number_of_events` are new since the last call.
typedef void (*rmw_event_callback_t)(const void* user_data, size_t number_of_events);

#ifdef __cplusplus
}
#endif
