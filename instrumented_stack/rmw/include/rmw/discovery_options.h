// SPDX-License-Identifier: Apache-2.0
// How far a context looks for other participants.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum rmw_automatic_discovery_range_e {
  RMW_AUTOMATIC_DISCOVERY_RANGE_NOT_SET = 0,
  RMW_AUTOMATIC_DISCOVERY_RANGE_OFF = 1,
  RMW_AUTOMATIC_DISCOVERY_RANGE_LOCALHOST = 2,
  RMW_AUTOMATIC_DISCOVERY_RANGE_SUBNET = 3,
  RMW_AUTOMATIC_DISCOVERY_RANGE_SYSTEM_DEFAULT = 4,
} rmw_automatic_discovery_range_t;

#define RMW_DISCOVERY_OPTIONS_STATIC_PEERS_MAX_LENGTH 256
#define RMW_DISCOVERY_OPTIONS_STATIC_PEERS_MAX_COUNT 32

typedef struct rmw_discovery_options_s {
  rmw_automatic_discovery_range_t automatic_discovery_range;
  // Host names or addresses that are contacted directly.
  char static_peers[RMW_DISCOVERY_OPTIONS_STATIC_PEERS_MAX_COUNT][RMW_DISCOVERY_OPTIONS_STATIC_PEERS_MAX_LENGTH];
  size_t static_peers_count;
} rmw_discovery_options_t;

// No range, no peers.
rmw_discovery_options_t rmw_get_zero_initialized_discovery_options(void);

#ifdef __cplusplus
}
#endif
