// SPDX-License-Identifier: Apache-2.0
// Watching the calls of a service: what its two ends publish of them on a topic beside it.
//
// rcl_service_configure_service_introspection() and rcl_client_configure_service_introspection() turn it on and off.
#pragma once

// After the name of the service. The messages are the events of its type, <Service>_Event.
#define RCL_SERVICE_INTROSPECTION_TOPIC_POSTFIX "/_service_event"

typedef enum rcl_service_introspection_state_e {
  RCL_SERVICE_INTROSPECTION_OFF,       // no publisher
  RCL_SERVICE_INTROSPECTION_METADATA,  // what happened when, by which client; events have no request and no response
  RCL_SERVICE_INTROSPECTION_CONTENTS   // also the request or the response
} rcl_service_introspection_state_t;
