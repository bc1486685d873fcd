// SPDX-License-Identifier: Apache-2.0
// Handles, options and quality of service of the middleware layer.
//
// The tracepoints of this layer report the addresses of rmw_publisher_t, rmw_subscription_t, rmw_service_t and
// rmw_client_t.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rcutils/allocator.h"
#include "rmw/ret_types.h"
#include "rmw/serialized_message.h"
#include "rmw/subscription_content_filter_options.h"
#include "rmw/time.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RMW_GID_STORAGE_SIZE 16u

struct rmw_context_s;
typedef struct rmw_context_s rmw_context_t;

typedef struct rmw_node_s {
  const char* implementation_identifier;
  void* data;
  const char* name;
  const char* namespace_;
  rmw_context_t* context;
} rmw_node_t;

typedef enum rmw_unique_network_flow_endpoints_requirement_e {
  RMW_UNIQUE_NETWORK_FLOW_ENDPOINTS_NOT_REQUIRED = 0,
  RMW_UNIQUE_NETWORK_FLOW_ENDPOINTS_STRICTLY_REQUIRED,
  RMW_UNIQUE_NETWORK_FLOW_ENDPOINTS_OPTIONALLY_REQUIRED,
  RMW_UNIQUE_NETWORK_FLOW_ENDPOINTS_SYSTEM_DEFAULT
} rmw_unique_network_flow_endpoints_requirement_t;

typedef struct rmw_publisher_options_s {
  void* rmw_specific_publisher_payload;  // unused
  rmw_unique_network_flow_endpoints_requirement_t require_unique_network_flow_endpoints;
} rmw_publisher_options_t;

typedef struct rmw_subscription_options_s {
  void* rmw_specific_subscription_payload;  // unused
  bool ignore_local_publications;           // drop messages of publishers of the same context
  rmw_unique_network_flow_endpoints_requirement_t require_unique_network_flow_endpoints;
  // Null: every message is wanted. Only read during creation.
  rmw_subscription_content_filter_options_t* content_filter_options;
} rmw_subscription_options_t;

typedef struct rmw_publisher_s {
  const char* implementation_identifier;
  void* data;
  const char* topic_name;
  rmw_publisher_options_t options;
  bool can_loan_messages;
} rmw_publisher_t;

typedef struct rmw_subscription_s {
  const char* implementation_identifier;
  void* data;
  const char* topic_name;
  rmw_subscription_options_t options;
  bool can_loan_messages;
  bool is_cft_enabled;  // whether there is a content filter
} rmw_subscription_t;

typedef struct rmw_service_s {
  const char* implementation_identifier;
  void* data;
  const char* service_name;
} rmw_service_t;

typedef struct rmw_client_s {
  const char* implementation_identifier;
  void* data;
  const char* service_name;
} rmw_client_t;

typedef struct rmw_guard_condition_s {
  const char* implementation_identifier;
  void* data;
  rmw_context_t* context;
} rmw_guard_condition_t;

// Optional memory hints of publish and take; none of their fields is used.
typedef struct rmw_publisher_allocation_s {
  const char* implementation_identifier;
  void* data;
} rmw_publisher_allocation_t;

typedef struct rmw_subscription_allocation_s {
  const char* implementation_identifier;
  void* data;
} rmw_subscription_allocation_t;

// The entities that rmw_wait() waits for: arrays of the `data` members of handles. After the wait, entries that are not
// ready are null.
typedef struct rmw_subscriptions_s {
  size_t subscriber_count;
  void** subscribers;
} rmw_subscriptions_t;

typedef struct rmw_services_s {
  size_t service_count;
  void** services;
} rmw_services_t;

typedef struct rmw_clients_s {
  size_t client_count;
  void** clients;
} rmw_clients_t;

typedef struct rmw_events_s {
  size_t event_count;
  void** events;
} rmw_events_t;

typedef struct rmw_guard_conditions_s {
  size_t guard_condition_count;
  void** guard_conditions;
} rmw_guard_conditions_t;

typedef struct rmw_wait_set_s {
  const char* implementation_identifier;
  rmw_guard_conditions_t* guard_conditions;
  void* data;
} rmw_wait_set_t;

typedef enum rmw_qos_reliability_policy_e {
  RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT,
  RMW_QOS_POLICY_RELIABILITY_RELIABLE,
  RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT,
  RMW_QOS_POLICY_RELIABILITY_UNKNOWN,
  RMW_QOS_POLICY_RELIABILITY_BEST_AVAILABLE
} rmw_qos_reliability_policy_t;

typedef enum rmw_qos_history_policy_e {
  RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT,
  RMW_QOS_POLICY_HISTORY_KEEP_LAST,
  RMW_QOS_POLICY_HISTORY_KEEP_ALL,
  RMW_QOS_POLICY_HISTORY_UNKNOWN
} rmw_qos_history_policy_t;

typedef enum rmw_qos_durability_policy_e {
  RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT,
  RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL,
  RMW_QOS_POLICY_DURABILITY_VOLATILE,
  RMW_QOS_POLICY_DURABILITY_UNKNOWN,
  RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE
} rmw_qos_durability_policy_t;

typedef enum rmw_qos_liveliness_policy_e {
  RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT = 0,
  RMW_QOS_POLICY_LIVELINESS_AUTOMATIC = 1,
  // 2 was "manual by node", which was removed.
  RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC = 3,
  RMW_QOS_POLICY_LIVELINESS_UNKNOWN = 4,
  RMW_QOS_POLICY_LIVELINESS_BEST_AVAILABLE = 5
} rmw_qos_liveliness_policy_t;

#define RMW_QOS_DEADLINE_DEFAULT RMW_DURATION_UNSPECIFIED
// A nanosecond less than the infinite duration.
#define RMW_QOS_DEADLINE_BEST_AVAILABLE \
  { 9223372036LL, 854775806LL }
#define RMW_QOS_LIFESPAN_DEFAULT RMW_DURATION_UNSPECIFIED
#define RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT RMW_DURATION_UNSPECIFIED
#define RMW_QOS_LIVELINESS_LEASE_DURATION_BEST_AVAILABLE RMW_QOS_DEADLINE_BEST_AVAILABLE

typedef struct rmw_qos_profile_s {
  enum rmw_qos_history_policy_e history;
  size_t depth;  // for keep-last
  enum rmw_qos_reliability_policy_e reliability;
  enum rmw_qos_durability_policy_e durability;
  struct rmw_time_s deadline;
  struct rmw_time_s lifespan;
  enum rmw_qos_liveliness_policy_e liveliness;
  struct rmw_time_s liveliness_lease_duration;
  bool avoid_ros_namespace_conventions;  // the DDS topic gets no `rt` prefix
} rmw_qos_profile_t;

// Identity of a publisher or subscription in the whole system: the 16 bytes of its DDS GUID.
typedef struct rmw_gid_s {
  const char* implementation_identifier;
  uint8_t data[RMW_GID_STORAGE_SIZE];
} rmw_gid_t;

#define RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED UINT64_MAX

typedef struct rmw_message_info_s {
  rmw_time_point_value_t source_timestamp;    // system clock of the publisher, ns since 1970
  rmw_time_point_value_t received_timestamp;  // system clock of this host, ns since 1970
  uint64_t publication_sequence_number;
  uint64_t reception_sequence_number;  // RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED
  rmw_gid_t publisher_gid;
  bool from_intra_process;
} rmw_message_info_t;

rmw_message_info_t rmw_get_zero_initialized_message_info(void);

// Identifies a request and its client. A response must carry it.
typedef struct rmw_request_id_s {
  int8_t writer_guid[RMW_GID_STORAGE_SIZE];  // the GUID of the client's response reader
  int64_t sequence_number;                   // counts the requests of this client
} rmw_request_id_t;

typedef struct rmw_service_info_s {
  rmw_time_point_value_t source_timestamp;    // system clock of the sender, ns since 1970
  rmw_time_point_value_t received_timestamp;  // system clock of this host, ns since 1970
  rmw_request_id_t request_id;
} rmw_service_info_t;

enum { RMW_QOS_POLICY_DEPTH_SYSTEM_DEFAULT = 0 };

typedef enum rmw_endpoint_type_e {
  RMW_ENDPOINT_INVALID = 0,
  RMW_ENDPOINT_PUBLISHER,
  RMW_ENDPOINT_SUBSCRIPTION,
  RMW_ENDPOINT_CLIENT,
  RMW_ENDPOINT_SERVER
} rmw_endpoint_type_t;

#ifdef __cplusplus
}
#endif
