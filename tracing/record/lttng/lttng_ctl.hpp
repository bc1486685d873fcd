// SPDX-License-Identifier: Apache-2.0
// The functions of liblttng-ctl. The library is loaded when the first of them is called: it brings libxml2 and others,
// and most commands and launches have nothing to do with LTTng. Code in this namespace calls the functions as LTTng's
// documentation says, and includes this header instead of lttng/lttng.h.
#pragma once

#include <lttng/lttng.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string_view>

#include "tracing/record/lttng/answer_limit.hpp"

namespace tracing {

// The address of a function of the library, for any thread. Throws TraceError.
void* lttng_address(const char* name);

template <std::size_t size>
struct LttngName {
  consteval LttngName(const char (&name)[size]) { std::copy_n(name, size, text); }  // NOLINT: a string is meant
  char text[size];
};

// Held while the library uses its connection to the session daemon. The library keeps this connection in variables of
// the process and protects it with nothing: two threads would share a connection, read each other's answers and close a
// descriptor twice.
std::unique_lock<std::mutex> lttng_lock();

// These functions have connections of their own and wait for long.
constexpr bool has_own_connection(std::string_view name) {
  return name.starts_with("lttng_notification_channel_") || name.ends_with("_wait_for_completion");
}

template <LttngName name, typename Function>
struct LttngFunction;

// A call is for any thread. It waits while another thread is in a call, and fails if the session daemon does not answer
// (answer_limit.hpp). Converts to the pointer to the function, for an
// owner that destroys an object. Both throw TraceError if the library can't be loaded.
template <LttngName name, typename Result, typename... Arguments>
struct LttngFunction<name, Result(Arguments...)> {
  using Pointer = Result (*)(Arguments...);

  Result operator()(Arguments... arguments) const {
    const Pointer function = *this;
    if constexpr (has_own_connection(name.text)) {
      return function(arguments...);
    } else {
      const std::unique_lock<std::mutex> lock = lttng_lock();
      const AnswerLimit limit;
      return function(arguments...);
    }
  }

  operator Pointer() const {  // NOLINT: it stands for the function
    static const auto address = reinterpret_cast<Pointer>(lttng_address(name.text));
    return address;
  }
};

// An object of LTTng with the function that destroys it.
template <typename Object>
using LttngOwned = std::unique_ptr<Object, void (*)(Object*)>;

#define LTTNG_FUNCTION(name) inline constexpr LttngFunction<#name, decltype(::name)> name
LTTNG_FUNCTION(lttng_action_destroy);
LTTNG_FUNCTION(lttng_action_list_add_action);
LTTNG_FUNCTION(lttng_action_list_create);
LTTNG_FUNCTION(lttng_action_notify_create);
LTTNG_FUNCTION(lttng_add_context);
LTTNG_FUNCTION(lttng_channel_create);
LTTNG_FUNCTION(lttng_channel_destroy);
LTTNG_FUNCTION(lttng_channel_get_discarded_event_count);
LTTNG_FUNCTION(lttng_channel_get_lost_packet_count);
LTTNG_FUNCTION(lttng_channel_set_blocking_timeout);
LTTNG_FUNCTION(lttng_clear_handle_destroy);
LTTNG_FUNCTION(lttng_clear_handle_get_result);
LTTNG_FUNCTION(lttng_clear_handle_wait_for_completion);
LTTNG_FUNCTION(lttng_clear_session);
LTTNG_FUNCTION(lttng_condition_destroy);
LTTNG_FUNCTION(lttng_condition_event_rule_matches_create);
LTTNG_FUNCTION(lttng_create_handle);
LTTNG_FUNCTION(lttng_create_session);
LTTNG_FUNCTION(lttng_create_session_live);
LTTNG_FUNCTION(lttng_create_session_snapshot);
LTTNG_FUNCTION(lttng_data_pending);
LTTNG_FUNCTION(lttng_destroy_handle);
LTTNG_FUNCTION(lttng_destroy_session);
LTTNG_FUNCTION(lttng_destroy_session_ext);
LTTNG_FUNCTION(lttng_destroy_session_no_wait);
LTTNG_FUNCTION(lttng_destruction_handle_destroy);
LTTNG_FUNCTION(lttng_destruction_handle_get_result);
LTTNG_FUNCTION(lttng_destruction_handle_wait_for_completion);
LTTNG_FUNCTION(lttng_disable_event);
LTTNG_FUNCTION(lttng_enable_channel);
LTTNG_FUNCTION(lttng_enable_event);
LTTNG_FUNCTION(lttng_enable_event_with_filter);
LTTNG_FUNCTION(lttng_event_create);
LTTNG_FUNCTION(lttng_event_destroy);
LTTNG_FUNCTION(lttng_event_get_exclusion_name);
LTTNG_FUNCTION(lttng_event_get_exclusion_name_count);
LTTNG_FUNCTION(lttng_event_rule_destroy);
LTTNG_FUNCTION(lttng_event_rule_user_tracepoint_create);
LTTNG_FUNCTION(lttng_event_rule_user_tracepoint_set_filter);
LTTNG_FUNCTION(lttng_event_rule_user_tracepoint_set_log_level_rule);
LTTNG_FUNCTION(lttng_event_rule_user_tracepoint_set_name_pattern);
LTTNG_FUNCTION(lttng_list_channels);
LTTNG_FUNCTION(lttng_list_domains);
LTTNG_FUNCTION(lttng_list_events);
LTTNG_FUNCTION(lttng_list_sessions);
LTTNG_FUNCTION(lttng_list_syscalls);
LTTNG_FUNCTION(lttng_list_tracepoints);
LTTNG_FUNCTION(lttng_list_triggers);
LTTNG_FUNCTION(lttng_load_session);
LTTNG_FUNCTION(lttng_load_session_attr_create);
LTTNG_FUNCTION(lttng_load_session_attr_destroy);
LTTNG_FUNCTION(lttng_load_session_attr_set_input_url);
LTTNG_FUNCTION(lttng_load_session_attr_set_session_name);
LTTNG_FUNCTION(lttng_log_level_rule_at_least_as_severe_as_create);
LTTNG_FUNCTION(lttng_log_level_rule_destroy);
LTTNG_FUNCTION(lttng_log_level_rule_exactly_create);
LTTNG_FUNCTION(lttng_notification_channel_create);
LTTNG_FUNCTION(lttng_notification_channel_destroy);
LTTNG_FUNCTION(lttng_notification_channel_get_next_notification);
LTTNG_FUNCTION(lttng_notification_channel_has_pending_notification);
LTTNG_FUNCTION(lttng_notification_channel_subscribe);
LTTNG_FUNCTION(lttng_notification_destroy);
LTTNG_FUNCTION(lttng_notification_get_trigger);
LTTNG_FUNCTION(lttng_regenerate_statedump);
LTTNG_FUNCTION(lttng_register_trigger_with_name);
LTTNG_FUNCTION(lttng_save_session);
LTTNG_FUNCTION(lttng_save_session_attr_create);
LTTNG_FUNCTION(lttng_save_session_attr_destroy);
LTTNG_FUNCTION(lttng_save_session_attr_set_output_url);
LTTNG_FUNCTION(lttng_save_session_attr_set_overwrite);
LTTNG_FUNCTION(lttng_save_session_attr_set_session_name);
LTTNG_FUNCTION(lttng_session_daemon_alive);
LTTNG_FUNCTION(lttng_session_get_creation_time);
LTTNG_FUNCTION(lttng_snapshot_add_output);
LTTNG_FUNCTION(lttng_snapshot_list_output);
LTTNG_FUNCTION(lttng_snapshot_output_create);
LTTNG_FUNCTION(lttng_snapshot_output_destroy);
LTTNG_FUNCTION(lttng_snapshot_output_get_ctrl_url);
LTTNG_FUNCTION(lttng_snapshot_output_list_destroy);
LTTNG_FUNCTION(lttng_snapshot_output_list_get_next);
LTTNG_FUNCTION(lttng_snapshot_output_set_local_path);
LTTNG_FUNCTION(lttng_snapshot_output_set_name);
LTTNG_FUNCTION(lttng_snapshot_output_set_network_url);
LTTNG_FUNCTION(lttng_snapshot_output_set_size);
LTTNG_FUNCTION(lttng_snapshot_record);
LTTNG_FUNCTION(lttng_start_tracing);
LTTNG_FUNCTION(lttng_stop_tracing);
LTTNG_FUNCTION(lttng_stop_tracing_no_wait);
LTTNG_FUNCTION(lttng_strerror);
LTTNG_FUNCTION(lttng_trigger_create);
LTTNG_FUNCTION(lttng_trigger_destroy);
LTTNG_FUNCTION(lttng_trigger_get_name);
LTTNG_FUNCTION(lttng_triggers_destroy);
LTTNG_FUNCTION(lttng_triggers_get_at_index);
LTTNG_FUNCTION(lttng_triggers_get_count);
LTTNG_FUNCTION(lttng_unregister_trigger);
#undef LTTNG_FUNCTION

// The value of the library's variable lttng_session_daemon_notification_endpoint. Throws TraceError.
lttng_endpoint* lttng_notification_endpoint();

}  // namespace tracing
