// SPDX-License-Identifier: Apache-2.0
// The functions that rclpy calls, by their names in C: an extension module that was built for them finds each.
#include <dlfcn.h>
#include <gtest/gtest.h>

namespace {

// What the extension of rclpy 9.1.5 (Kilted) leaves to the libraries that it links, without its messages.
constexpr const char* kFunctions[] = {
    "rcl_action_accept_new_goal", "rcl_action_cancel_response_fini",
    "rcl_action_client_configure_action_introspection", "rcl_action_client_fini",
    "rcl_action_client_get_default_options", "rcl_action_client_init",
    "rcl_action_client_wait_set_get_entities_ready", "rcl_action_client_wait_set_get_num_entities",
    "rcl_action_expire_goals", "rcl_action_get_client_names_and_types_by_node", "rcl_action_get_goal_status_array",
    "rcl_action_get_names_and_types", "rcl_action_get_server_names_and_types_by_node",
    "rcl_action_get_zero_initialized_cancel_response", "rcl_action_get_zero_initialized_client",
    "rcl_action_get_zero_initialized_goal_status_array", "rcl_action_get_zero_initialized_server",
    "rcl_action_goal_handle_fini", "rcl_action_goal_handle_get_status", "rcl_action_goal_handle_is_active",
    "rcl_action_goal_status_array_fini", "rcl_action_notify_goal_done", "rcl_action_process_cancel_request",
    "rcl_action_publish_feedback", "rcl_action_publish_status", "rcl_action_send_cancel_request",
    "rcl_action_send_cancel_response", "rcl_action_send_goal_request", "rcl_action_send_goal_response",
    "rcl_action_send_result_request", "rcl_action_send_result_response",
    "rcl_action_server_configure_action_introspection", "rcl_action_server_fini",
    "rcl_action_server_get_default_options", "rcl_action_server_goal_exists", "rcl_action_server_init",
    "rcl_action_server_is_available", "rcl_action_server_wait_set_get_entities_ready",
    "rcl_action_server_wait_set_get_num_entities", "rcl_action_take_cancel_request",
    "rcl_action_take_cancel_response", "rcl_action_take_feedback", "rcl_action_take_goal_request",
    "rcl_action_take_goal_response", "rcl_action_take_result_request", "rcl_action_take_result_response",
    "rcl_action_take_status", "rcl_action_update_goal_state", "rcl_action_wait_set_add_action_client",
    "rcl_action_wait_set_add_action_server", "rcl_arguments_fini", "rcl_arguments_get_count_unparsed_ros",
    "rcl_arguments_get_param_overrides", "rcl_arguments_get_unparsed_ros",
    "rcl_client_configure_service_introspection", "rcl_client_fini", "rcl_client_get_default_options",
    "rcl_client_get_service_name", "rcl_client_init", "rcl_client_set_on_new_response_callback",
    "rcl_clock_add_jump_callback", "rcl_clock_fini", "rcl_clock_get_now", "rcl_clock_init",
    "rcl_clock_remove_jump_callback", "rcl_context_fini", "rcl_context_get_domain_id", "rcl_context_is_valid",
    "rcl_count_clients", "rcl_count_publishers", "rcl_count_services", "rcl_count_subscribers",
    "rcl_difference_times", "rcl_disable_ros_time_override", "rcl_enable_ros_time_override", "rcl_event_fini",
    "rcl_event_set_callback", "rcl_expand_topic_name", "rcl_get_client_names_and_types_by_node",
    "rcl_get_default_topic_name_substitutions", "rcl_get_node_names", "rcl_get_node_names_with_enclaves",
    "rcl_get_publisher_names_and_types_by_node", "rcl_get_publishers_info_by_topic",
    "rcl_get_service_names_and_types", "rcl_get_service_names_and_types_by_node",
    "rcl_get_subscriber_names_and_types_by_node", "rcl_get_subscriptions_info_by_topic",
    "rcl_get_topic_names_and_types", "rcl_get_zero_initialized_arguments", "rcl_get_zero_initialized_client",
    "rcl_get_zero_initialized_context", "rcl_get_zero_initialized_event", "rcl_get_zero_initialized_guard_condition",
    "rcl_get_zero_initialized_init_options", "rcl_get_zero_initialized_node", "rcl_get_zero_initialized_publisher",
    "rcl_get_zero_initialized_service", "rcl_get_zero_initialized_subscription",
    "rcl_get_zero_initialized_subscription_content_filter_options", "rcl_get_zero_initialized_timer",
    "rcl_get_zero_initialized_wait_set", "rcl_guard_condition_fini", "rcl_guard_condition_get_default_options",
    "rcl_guard_condition_init", "rcl_init", "rcl_init_options_fini", "rcl_init_options_init",
    "rcl_init_options_set_domain_id", "rcl_is_enabled_ros_time_override",
    "rcl_lifecycle_get_default_state_machine_options", "rcl_lifecycle_get_transition_by_label",
    "rcl_lifecycle_get_zero_initialized_state_machine", "rcl_lifecycle_state_machine_fini",
    "rcl_lifecycle_state_machine_init", "rcl_lifecycle_state_machine_is_initialized",
    "rcl_lifecycle_transition_error_label", "rcl_lifecycle_transition_failure_label",
    "rcl_lifecycle_transition_success_label", "rcl_lifecycle_trigger_transition_by_id",
    "rcl_lifecycle_trigger_transition_by_label", "rcl_logging_configure_with_output_handler", "rcl_logging_fini",
    "rcl_logging_get_logging_directory", "rcl_logging_multiple_output_handler", "rcl_logging_rosout_add_sublogger",
    "rcl_logging_rosout_enabled", "rcl_logging_rosout_fini_publisher_for_node",
    "rcl_logging_rosout_init_publisher_for_node", "rcl_logging_rosout_remove_sublogger", "rcl_names_and_types_fini",
    "rcl_node_fini", "rcl_node_get_default_options", "rcl_node_get_fully_qualified_name", "rcl_node_get_logger_name",
    "rcl_node_get_name", "rcl_node_get_namespace", "rcl_node_get_options", "rcl_node_init", "rcl_node_resolve_name",
    "rcl_node_type_description_service_handle_request", "rcl_node_type_description_service_init",
    "rcl_parse_arguments", "rcl_publish", "rcl_publish_serialized_message", "rcl_publisher_assert_liveliness",
    "rcl_publisher_event_init", "rcl_publisher_fini", "rcl_publisher_get_default_options",
    "rcl_publisher_get_subscription_count", "rcl_publisher_get_topic_name", "rcl_publisher_init",
    "rcl_publisher_wait_for_all_acked", "rcl_remap_topic_name", "rcl_remove_ros_arguments", "rcl_send_request",
    "rcl_send_response", "rcl_service_configure_service_introspection", "rcl_service_fini",
    "rcl_service_get_default_options", "rcl_service_get_options", "rcl_service_get_service_name", "rcl_service_init",
    "rcl_service_server_is_available", "rcl_service_set_on_new_request_callback", "rcl_set_ros_time_override",
    "rcl_shutdown", "rcl_subscription_content_filter_options_fini", "rcl_subscription_content_filter_options_init",
    "rcl_subscription_event_init", "rcl_subscription_fini", "rcl_subscription_get_content_filter",
    "rcl_subscription_get_default_options", "rcl_subscription_get_publisher_count", "rcl_subscription_get_topic_name",
    "rcl_subscription_init", "rcl_subscription_is_cft_enabled", "rcl_subscription_options_set_content_filter_options",
    "rcl_subscription_set_content_filter", "rcl_subscription_set_on_new_message_callback", "rcl_take",
    "rcl_take_event", "rcl_take_request_with_info", "rcl_take_response_with_info", "rcl_take_serialized_message",
    "rcl_timer_call", "rcl_timer_call_with_info", "rcl_timer_cancel", "rcl_timer_clock", "rcl_timer_exchange_period",
    "rcl_timer_fini", "rcl_timer_get_next_call_time", "rcl_timer_get_period", "rcl_timer_get_time_since_last_call",
    "rcl_timer_get_time_until_next_call", "rcl_timer_init2", "rcl_timer_is_canceled", "rcl_timer_is_ready",
    "rcl_timer_reset", "rcl_timer_set_on_reset_callback", "rcl_topic_name_validation_result_string",
    "rcl_trigger_guard_condition", "rcl_validate_topic_name", "rcl_wait", "rcl_wait_set_add_client",
    "rcl_wait_set_add_event", "rcl_wait_set_add_guard_condition", "rcl_wait_set_add_service",
    "rcl_wait_set_add_subscription", "rcl_wait_set_add_timer", "rcl_wait_set_clear", "rcl_wait_set_fini",
    "rcl_wait_set_init", "rcl_yaml_node_struct_fini", "rcutils_get_default_allocator", "rcutils_get_error_string",
    "rcutils_get_zero_initialized_string_array", "rcutils_get_zero_initialized_string_map",
    "rcutils_get_zero_initialized_uint8_array", "rcutils_log", "rcutils_log_internal",
    "rcutils_logging_get_logger_effective_level", "rcutils_logging_get_logger_level", "rcutils_logging_initialize",
    "rcutils_logging_logger_is_enabled_for", "rcutils_logging_set_logger_level",
    "rcutils_logging_severity_level_from_string", "rcutils_logging_shutdown", "rcutils_reset_error",
    "rcutils_string_array_fini", "rcutils_string_map_fini", "rcutils_string_map_init", "rcutils_uint8_array_fini",
    "rcutils_uint8_array_init", "rmw_deserialize", "rmw_full_topic_name_validation_result_string",
    "rmw_get_implementation_identifier", "rmw_get_zero_initialized_names_and_types",
    "rmw_get_zero_initialized_topic_endpoint_info_array", "rmw_namespace_validation_result_string",
    "rmw_node_name_validation_result_string", "rmw_qos_profile_check_compatible", "rmw_serialize",
    "rmw_time_total_nsec", "rmw_topic_endpoint_info_array_fini", "rmw_validate_full_topic_name",
    "rmw_validate_namespace", "rmw_validate_node_name"};

TEST(ClientLibrary, FindsEveryFunctionThatRclpyCalls) {
  for (const char* library : {"librcl.so", "librcl_action.so", "librcl_lifecycle.so", "librcl_logging_interface.so"}) {
    ASSERT_NE(dlopen(library, RTLD_NOW | RTLD_GLOBAL), nullptr) << dlerror();
  }
  for (const char* function : kFunctions) {
    EXPECT_NE(dlsym(RTLD_DEFAULT, function), nullptr) << function;
  }
}

}  // namespace
