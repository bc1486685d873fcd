// SPDX-License-Identifier: Apache-2.0
// How the middleware reports messages, requests, responses and events to code that does not wait for them.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Called from threads of the middleware. The function that sets the callback also calls it once if something came
// before. The callback must only take note. `number_of_events` are new since the last call.
typedef void (*rmw_event_callback_t)(const void* user_data, size_t number_of_events);

#ifdef __cplusplus
}
#endif
