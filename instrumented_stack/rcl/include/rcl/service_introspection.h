// SPDX-License-Identifier: Apache-2.0
// Introspection of a service: its two ends publish events of their calls on a topic of its own.
//
// rcl_service_configure_service_introspection() and rcl_client_configure_service_introspection() turn it on and off.
#pragma once

// Follows the name of the service. The messages are the events of its type, <Service>_Event.
#define RCL_SERVICE_INTROSPECTION_TOPIC_POSTFIX "/_service_event"

typedef enum rcl_service_introspection_state_e {
  RCL_SERVICE_INTROSPECTION_OFF,       // no publisher
  RCL_SERVICE_INTROSPECTION_METADATA,  // event, time and client; no request and no response
  RCL_SERVICE_INTROSPECTION_CONTENTS   // also the request or the response
} rcl_service_introspection_state_t;
