// SPDX-License-Identifier: Apache-2.0
// How rcl reports messages, requests, responses, events and timer resets: see rmw/event_callback_type.h.
#pragma once

#include "rmw/event_callback_type.h"

typedef rmw_event_callback_t rcl_event_callback_t;
