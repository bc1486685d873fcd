// SPDX-License-Identifier: Apache-2.0
// The middleware interface: publishers, subscriptions, services, clients, waiting and the graph, on Fast DDS.
//
// A context (rmw/init.h) holds one DDS participant. On errors, creation functions return null and the others a code
// other than RMW_RET_OK; both leave a message for rmw_get_error_string(). A handle must be destroyed before its node, a
// node before its context. Publish, take and trigger may be called from several threads. A wait set serves one thread
// at a time.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rcutils/types/string_array.h"
#include "rmw/event.h"
#include "rmw/event_callback_type.h"
#include "rmw/init.h"
#include "rmw/names_and_types.h"
#include "rmw/network_flow_endpoint.h"
#include "rmw/qos_profiles.h"
#include "rmw/types.h"
#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

// `rmw_fastrtps_cpp`: the name in ROS 2 of the middleware that speaks this wire format.
const char* rmw_get_implementation_identifier(void);
const char* rmw_get_serialization_format(void);

// ---- nodes
rmw_node_t* rmw_create_node(rmw_context_t* context, const char* name, const char* namespace_);
rmw_ret_t rmw_destroy_node(rmw_node_t* node);

// Triggered whenever the graph changes. Owned by the context, and shared by its nodes.
const rmw_guard_condition_t* rmw_node_get_graph_guard_condition(const rmw_node_t* node);

// ---- publishers
rmw_publisher_options_t rmw_get_default_publisher_options(void);
rmw_publisher_t* rmw_create_publisher(const rmw_node_t* node, const rosidl_message_type_support_t* type_support,
                                      const char* topic_name, const rmw_qos_profile_t* qos_profile,
                                      const rmw_publisher_options_t* publisher_options);
rmw_ret_t rmw_destroy_publisher(rmw_node_t* node, rmw_publisher_t* publisher);

// Writes a message. Its source timestamp is the value that the rmw_publish tracepoint reports.
rmw_ret_t rmw_publish(const rmw_publisher_t* publisher, const void* ros_message,
                      rmw_publisher_allocation_t* allocation);
rmw_ret_t rmw_publish_serialized_message(const rmw_publisher_t* publisher,
                                         const rmw_serialized_message_t* serialized_message,
                                         rmw_publisher_allocation_t* allocation);

// Borrows memory of the middleware for a message, which is then sent without a copy. The memory is not initialised, and
// must be given back by one of the other two functions. Works only for publishers whose can_loan_messages is set: their
// type has the same layout in memory and on the wire. Otherwise returns RMW_RET_UNSUPPORTED.
rmw_ret_t rmw_borrow_loaned_message(const rmw_publisher_t* publisher, const rosidl_message_type_support_t* type_support,
                                    void** ros_message);
rmw_ret_t rmw_return_loaned_message_from_publisher(const rmw_publisher_t* publisher, void* loaned_message);
rmw_ret_t rmw_publish_loaned_message(const rmw_publisher_t* publisher, void* ros_message,
                                     rmw_publisher_allocation_t* allocation);

rmw_ret_t rmw_publisher_count_matched_subscriptions(const rmw_publisher_t* publisher, size_t* subscription_count);
rmw_ret_t rmw_publisher_get_actual_qos(const rmw_publisher_t* publisher, rmw_qos_profile_t* qos);
rmw_ret_t rmw_publisher_assert_liveliness(const rmw_publisher_t* publisher);

// Waits until every matched reliable subscription has acknowledged everything written so far. Returns RMW_RET_TIMEOUT
// if that takes longer than `wait_timeout`.
rmw_ret_t rmw_publisher_wait_for_all_acked(const rmw_publisher_t* publisher, rmw_time_t wait_timeout);
// The addresses that the publisher may send from. The caller passes `network_flow_endpoint_array` zero initialised and
// finalises it.
rmw_ret_t rmw_publisher_get_network_flow_endpoints(const rmw_publisher_t* publisher, rcutils_allocator_t* allocator,
                                                   rmw_network_flow_endpoint_array_t* network_flow_endpoint_array);
rmw_ret_t rmw_get_gid_for_publisher(const rmw_publisher_t* publisher, rmw_gid_t* gid);
rmw_ret_t rmw_compare_gids_equal(const rmw_gid_t* gid1, const rmw_gid_t* gid2, bool* result);

// ---- subscriptions
rmw_subscription_options_t rmw_get_default_subscription_options(void);
rmw_subscription_t* rmw_create_subscription(const rmw_node_t* node, const rosidl_message_type_support_t* type_support,
                                            const char* topic_name, const rmw_qos_profile_t* qos_policies,
                                            const rmw_subscription_options_t* subscription_options);
rmw_ret_t rmw_destroy_subscription(rmw_node_t* node, rmw_subscription_t* subscription);
rmw_ret_t rmw_subscription_count_matched_publishers(const rmw_subscription_t* subscription, size_t* publisher_count);
rmw_ret_t rmw_subscription_get_actual_qos(const rmw_subscription_t* subscription, rmw_qos_profile_t* qos);

// `callback` is called for every message that arrives from now on, and at once for those that wait to be taken. It may
// count more messages than can be taken, but never fewer. Null ends the calls: none is running any more when this
// returns. Must not be called from the callback. All this holds for services and clients below, too.
rmw_ret_t rmw_subscription_set_on_new_message_callback(rmw_subscription_t* subscription, rmw_event_callback_t callback,
                                                       const void* user_data);

// Sets the messages that are wanted from now on; an empty expression ends the filter. Returns RMW_RET_ERROR and changes
// nothing if the filter does not fit the type, if it is empty and there is none, or while messages are on loan. The
// middleware makes another reader when a filter is first set or is removed: messages not taken by then are lost.
rmw_ret_t rmw_subscription_set_content_filter(rmw_subscription_t* subscription,
                                              const rmw_subscription_content_filter_options_t* options);
// Copies the filter into zero initialised `options`, which the caller finalizes. Returns RMW_RET_ERROR without a
// filter.
rmw_ret_t rmw_subscription_get_content_filter(const rmw_subscription_t* subscription, rcutils_allocator_t* allocator,
                                              rmw_subscription_content_filter_options_t* options);

rmw_ret_t rmw_take(const rmw_subscription_t* subscription, void* ros_message, bool* taken,
                   rmw_subscription_allocation_t* allocation);
rmw_ret_t rmw_take_with_info(const rmw_subscription_t* subscription, void* ros_message, bool* taken,
                             rmw_message_info_t* message_info, rmw_subscription_allocation_t* allocation);
// Takes the next message without copying it from the memory of the middleware. The caller must return it and must not
// write to it. Works only for subscriptions whose can_loan_messages is set: otherwise returns RMW_RET_UNSUPPORTED.
rmw_ret_t rmw_take_loaned_message_with_info(const rmw_subscription_t* subscription, void** loaned_message, bool* taken,
                                            rmw_message_info_t* message_info,
                                            rmw_subscription_allocation_t* allocation);
rmw_ret_t rmw_return_loaned_message_from_subscription(const rmw_subscription_t* subscription, void* loaned_message);

// The addresses at which the subscription listens; see rmw_publisher_get_network_flow_endpoints().
rmw_ret_t rmw_subscription_get_network_flow_endpoints(const rmw_subscription_t* subscription,
                                                      rcutils_allocator_t* allocator,
                                                      rmw_network_flow_endpoint_array_t* network_flow_endpoint_array);

rmw_ret_t rmw_take_serialized_message(const rmw_subscription_t* subscription,
                                      rmw_serialized_message_t* serialized_message, bool* taken,
                                      rmw_subscription_allocation_t* allocation);
rmw_ret_t rmw_take_serialized_message_with_info(const rmw_subscription_t* subscription,
                                                rmw_serialized_message_t* serialized_message, bool* taken,
                                                rmw_message_info_t* message_info,
                                                rmw_subscription_allocation_t* allocation);

// ---- services
rmw_service_t* rmw_create_service(const rmw_node_t* node, const rosidl_service_type_support_t* type_support,
                                  const char* service_name, const rmw_qos_profile_t* qos_policies);
rmw_ret_t rmw_destroy_service(rmw_node_t* node, rmw_service_t* service);

// Takes the next request without waiting; `taken` is false when there is none. The response must carry
// `request_header->request_id`.
rmw_ret_t rmw_take_request(const rmw_service_t* service, rmw_service_info_t* request_header, void* ros_request,
                           bool* taken);
// Waits briefly until the client's reader is known, then returns RMW_RET_TIMEOUT. Returns RMW_RET_OK and sends nothing
// if the client is gone.
rmw_ret_t rmw_send_response(const rmw_service_t* service, rmw_request_id_t* request_header, void* ros_response);
rmw_ret_t rmw_service_set_on_new_request_callback(rmw_service_t* service, rmw_event_callback_t callback,
                                                  const void* user_data);
rmw_ret_t rmw_service_request_subscription_get_actual_qos(const rmw_service_t* service, rmw_qos_profile_t* qos);
rmw_ret_t rmw_service_response_publisher_get_actual_qos(const rmw_service_t* service, rmw_qos_profile_t* qos);

// ---- clients
rmw_client_t* rmw_create_client(const rmw_node_t* node, const rosidl_service_type_support_t* type_support,
                                const char* service_name, const rmw_qos_profile_t* qos_policies);
rmw_ret_t rmw_destroy_client(rmw_node_t* node, rmw_client_t* client);

// Identifies the client; services find it in rmw_request_id_t::writer_guid.
rmw_ret_t rmw_get_gid_for_client(const rmw_client_t* client, rmw_gid_t* gid);

// `sequence_id` gets the number that the response will carry.
rmw_ret_t rmw_send_request(const rmw_client_t* client, const void* ros_request, int64_t* sequence_id);
// Takes the next response without waiting. `taken` is false if there is none, and also if the next one is for another
// client.
rmw_ret_t rmw_take_response(const rmw_client_t* client, rmw_service_info_t* request_header, void* ros_response,
                            bool* taken);
rmw_ret_t rmw_client_set_on_new_response_callback(rmw_client_t* client, rmw_event_callback_t callback,
                                                  const void* user_data);
rmw_ret_t rmw_client_request_publisher_get_actual_qos(const rmw_client_t* client, rmw_qos_profile_t* qos);
rmw_ret_t rmw_client_response_subscription_get_actual_qos(const rmw_client_t* client, rmw_qos_profile_t* qos);

// Whether a request reaches a service and the response comes back. Changes trigger the graph guard condition.
rmw_ret_t rmw_service_server_is_available(const rmw_node_t* node, const rmw_client_t* client, bool* is_available);

// ---- serialization without a middleware entity
rmw_ret_t rmw_serialize(const void* ros_message, const rosidl_message_type_support_t* type_support,
                        rmw_serialized_message_t* serialized_message);
rmw_ret_t rmw_deserialize(const rmw_serialized_message_t* serialized_message,
                          const rosidl_message_type_support_t* type_support, void* ros_message);

// ---- waiting
rmw_guard_condition_t* rmw_create_guard_condition(rmw_context_t* context);
rmw_ret_t rmw_destroy_guard_condition(rmw_guard_condition_t* guard_condition);
rmw_ret_t rmw_trigger_guard_condition(const rmw_guard_condition_t* guard_condition);

// `max_conditions` is a hint of how many entities will be waited for.
rmw_wait_set_t* rmw_create_wait_set(rmw_context_t* context, size_t max_conditions);
rmw_ret_t rmw_destroy_wait_set(rmw_wait_set_t* wait_set);

// Blocks until an entity is ready or the timeout has passed (null: wait forever; zero: do not wait). Entries that are
// not ready become null; triggered guard conditions are reset. Returns RMW_RET_TIMEOUT if nothing became ready.
rmw_ret_t rmw_wait(rmw_subscriptions_t* subscriptions, rmw_guard_conditions_t* guard_conditions,
                   rmw_services_t* services, rmw_clients_t* clients, rmw_events_t* events, rmw_wait_set_t* wait_set,
                   const rmw_time_t* wait_timeout);

// ---- graph
rmw_ret_t rmw_get_node_names(const rmw_node_t* node, rcutils_string_array_t* node_names,
                             rcutils_string_array_t* node_namespaces);
rmw_ret_t rmw_get_node_names_with_enclaves(const rmw_node_t* node, rcutils_string_array_t* node_names,
                                           rcutils_string_array_t* node_namespaces, rcutils_string_array_t* enclaves);

// Counts publishers and subscriptions of a full topic name in the whole system, including this process.
rmw_ret_t rmw_count_publishers(const rmw_node_t* node, const char* topic_name, size_t* count);
rmw_ret_t rmw_count_subscribers(const rmw_node_t* node, const char* topic_name, size_t* count);

// Topics with their types, as ROS 2 names (`/chatter`, `std_msgs/msg/String`) or, with `no_demangle`, as DDS has them.
rmw_ret_t rmw_get_topic_names_and_types(const rmw_node_t* node, rcutils_allocator_t* allocator, bool no_demangle,
                                        rmw_names_and_types_t* topic_names_and_types);

// Services with their types, if at least one end exists: `/add`, `example_interfaces/srv/AddTwoInts`.
rmw_ret_t rmw_get_service_names_and_types(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                          rmw_names_and_types_t* service_names_and_types);
rmw_ret_t rmw_count_services(const rmw_node_t* node, const char* service_name, size_t* count);
rmw_ret_t rmw_count_clients(const rmw_node_t* node, const char* service_name, size_t* count);

#ifdef __cplusplus
}
#endif
