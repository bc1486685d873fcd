// SPDX-License-Identifier: Apache-2.0
// Statuses of incompatible qualities of service: see rmw/events_statuses.h.
#pragma once

#include "rmw/events_statuses.h"
