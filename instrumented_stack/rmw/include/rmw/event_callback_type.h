// SPDX-License-Identifier: Apache-2.0
// How the middleware reports messages, requests, responses and events to code that does not wait for them.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Called from threads of the middleware. The function that sets the callback also calls it once if something came
// before. The callback must only take note. `number_of_events` are new since the last call. A callback is not told of
// what an earlier one was told of, whether or not that was taken.
typedef void (*rmw_event_callback_t)(const void* user_data, size_t number_of_events);

// The user data of a null callback for one who was told of more than was taken, and gives it up. The next callback is
// told of that, too. So do the executors of this stack when an entity leaves them. ROS 2 has nothing like it.
extern const void* const rmw_event_callback_hands_back;

#ifdef __cplusplus
}
#endif
