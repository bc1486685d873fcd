// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "provider/provider_fields.h"
#include "state/object_state.hpp"
#include "tracetools/events.h"
#include "tracetools/events_ext.h"

// Which events begin and end which objects, and how their arguments are kept for a state dump.
namespace tracetools {

// One empty type per event, to describe it at compile time.
namespace event {
#define DECLARE_TAG(name, parameters, arguments) \
  struct name {};
TRACETOOLS_EVENTS(DECLARE_TAG)
TRACETOOLS_EXT_EVENTS(DECLARE_TAG)
#undef DECLARE_TAG
}  // namespace event

// An init event: the kind of the object that it belongs to, and which argument is the address of that object.
template <typename Event>
struct Begins {
  static constexpr bool value = false;
};
// The end of an object: its kind. The only argument is the address.
template <typename Event>
struct Ends {
  static constexpr bool value = false;
};

#define BEGINS(event_, kind_, argument_)                  \
  template <>                                             \
  struct Begins<event::event_> {                          \
    static constexpr bool value = true;                   \
    static constexpr ObjectKind kind = ObjectKind::kind_; \
    static constexpr std::size_t argument = argument_;    \
  };
#define ENDS(event_, kind_)                               \
  template <>                                             \
  struct Ends<event::event_> {                            \
    static constexpr bool value = true;                   \
    static constexpr ObjectKind kind = ObjectKind::kind_; \
  };

BEGINS(rcl_init, kContext, 0)
BEGINS(rcl_node_init, kNode, 0)
BEGINS(rmw_publisher_init, kRmwPublisher, 0)
BEGINS(rcl_publisher_init, kPublisher, 0)
BEGINS(rmw_subscription_init, kRmwSubscription, 0)
BEGINS(rcl_subscription_init, kSubscription, 0)
BEGINS(rclcpp_subscription_init, kRclcppSubscription, 1)
BEGINS(rclcpp_subscription_callback_added, kRclcppSubscription, 0)
BEGINS(rmw_service_init, kRmwService, 0)
BEGINS(rmw_publisher_qos, kRmwPublisher, 0)
BEGINS(rmw_subscription_qos, kRmwSubscription, 0)
BEGINS(rcl_service_init, kService, 0)
BEGINS(rclcpp_service_callback_added, kCallback, 1)
BEGINS(rmw_client_init, kRmwClient, 0)
BEGINS(rcl_client_init, kClient, 0)
BEGINS(rcl_timer_init, kTimer, 0)
BEGINS(rclcpp_timer_callback_added, kCallback, 1)
BEGINS(rclcpp_timer_link_node, kTimer, 0)
BEGINS(rclcpp_callback_register, kCallback, 0)
BEGINS(rcl_lifecycle_state_machine_init, kStateMachine, 1)
BEGINS(rclcpp_ipb_to_subscription, kIntraProcessBuffer, 0)
BEGINS(rclcpp_buffer_to_ipb, kRingBuffer, 0)
BEGINS(rclcpp_construct_ring_buffer, kRingBuffer, 0)

ENDS(rcl_context_fini, kContext)
ENDS(rcl_node_fini, kNode)
ENDS(rmw_publisher_fini, kRmwPublisher)
ENDS(rcl_publisher_fini, kPublisher)
ENDS(rmw_subscription_fini, kRmwSubscription)
ENDS(rcl_subscription_fini, kSubscription)
ENDS(rclcpp_subscription_fini, kRclcppSubscription)
ENDS(rmw_service_fini, kRmwService)
ENDS(rcl_service_fini, kService)
ENDS(rmw_client_fini, kRmwClient)
ENDS(rcl_client_fini, kClient)
ENDS(rcl_timer_fini, kTimer)
ENDS(rclcpp_callback_fini, kCallback)
ENDS(rcl_lifecycle_state_machine_fini, kStateMachine)
ENDS(rclcpp_ipb_fini, kIntraProcessBuffer)
ENDS(rclcpp_ring_buffer_fini, kRingBuffer)

#undef BEGINS
#undef ENDS

// Links between messages: init events of all the endpoints that they name.
template <typename Event>
inline constexpr bool is_message_link = false;
template <>
inline constexpr bool is_message_link<event::message_link_periodic_async> = true;
template <>
inline constexpr bool is_message_link<event::message_link_partial_sync> = true;

template <typename Event>
inline constexpr bool is_init_event = Begins<Event>::value || is_message_link<Event>;

template <typename Event>
inline constexpr bool is_transition = std::is_same_v<Event, event::rcl_lifecycle_transition>;

// The table says which events begin or end an object; BEGINS and ENDS say which object.
#define CHECK_EVENT(given, name, Struct, group, ...)                                                         \
  static_assert(is_init_event<event::name> == (std::string_view(#group) == "init"),                          \
                #name " needs a row of BEGINS if it is in group init of event_table.h, and none otherwise"); \
  static_assert(Ends<event::name>::value == (std::string_view(#group) == "end"),                             \
                #name " needs a row of ENDS if it is in group end of event_table.h, and none otherwise");
TRACETOOLS_EVENT_TABLE(CHECK_EVENT, )
TRACETOOLS_EXT_EVENT_TABLE(CHECK_EVENT, )
#undef CHECK_EVENT

// Whether an event changes the kept events, and is none of them.
template <typename Event>
inline constexpr bool is_noted = Ends<Event>::value || is_transition<Event>;

// Bytes of the gid that the middleware gives. Versions 5.1 to 8.3 record 24 bytes of it, although there are 16 since
// then; the others are zero here.
inline constexpr std::size_t kGivenGidSize = TRACETOOLS_INTERFACE < 501 ? 24 : 16;

// A copy of an argument that outlives the call.
template <typename Argument>
struct Kept {
  explicit Kept(Argument argument) : value(argument) {}
  Argument get() const { return value; }
  Argument value;
};
template <>
struct Kept<const char*> {
  explicit Kept(const char* text) {
    if (text != nullptr) {
      value = text;
    }
  }
  const char* get() const { return value ? value->c_str() : nullptr; }
  std::optional<std::string> value;
};
template <>
struct Kept<const std::uint8_t*> {  // a gid
  explicit Kept(const std::uint8_t* gid) { std::memcpy(value.data(), gid, kGivenGidSize); }
  const std::uint8_t* get() const { return value.data(); }
  std::array<std::uint8_t, TRACETOOLS_GID_SIZE> value = {};
};

// Keeps a link between messages. A node may link several pairs, so no link replaces another.
template <typename Recorder>
void keep_message_link(Recorder recorder, const void** subs, std::size_t num_subs, const void** pubs,
                       std::size_t num_pubs) {
  std::vector<ObjectKey> objects;
  for (std::size_t i = 0; i < num_subs; ++i) {
    objects.push_back({ObjectKind::kSubscription, subs[i]});
  }
  for (std::size_t i = 0; i < num_pubs; ++i) {
    objects.push_back({ObjectKind::kPublisher, pubs[i]});
  }
  // A link of nothing belongs to no object, and no object could end it.
  if (objects.empty()) {
    objects.push_back({ObjectKind::kContext, nullptr});
  }
  ObjectState::instance().keep(
      {.objects = std::move(objects),
       .name = nullptr,
       .tracepoint = recorder.tracepoint,
       .counted = recorder.counted,
       .record = [recorder, kept_subs = std::vector<const void*>(subs, subs + num_subs),
                  kept_pubs = std::vector<const void*>(pubs, pubs + num_pubs)](const Probe& probe) mutable {
         recorder(probe, kept_subs.data(), kept_subs.size(), kept_pubs.data(), kept_pubs.size());
       }});
}

// An event with copies of its arguments.
template <typename Recorder, typename... Arguments>
InitEvent kept_event(ObjectKey object, const char* name, Recorder recorder, Arguments... arguments) {
  return {.objects = {object},
          .name = name,
          .tracepoint = recorder.tracepoint,
          .counted = recorder.counted,
          .record = [recorder, kept = std::tuple(Kept<Arguments>(arguments)...)](const Probe& probe) {
            std::apply([&](const auto&... each) { recorder(probe, each.get()...); }, kept);
          }};
}

// Records an init event, and keeps it for sessions that start later.
template <typename Event, typename Recorder, typename... Arguments>
void keep(const char* name, Recorder recorder, Arguments... arguments) {
  if constexpr (is_message_link<Event>) {
    keep_message_link(recorder, arguments...);
  } else {
    const void* const object = std::get<Begins<Event>::argument>(std::tie(arguments...));
    ObjectState::instance().keep(kept_event({Begins<Event>::kind, object}, name, recorder, arguments...));
  }
}

// Forgets an object that ends, and keeps the current state of a state machine, because no init event records it. Does
// nothing for other events. `state` records ros2_ext:rcl_lifecycle_state.
template <typename Event, typename Recorder, typename... Arguments>
void note(Recorder state, Arguments... arguments) {
  if constexpr (Ends<Event>::value) {
    ObjectState::instance().forget({Ends<Event>::kind, arguments...});
  } else if constexpr (is_transition<Event>) {
    const auto& [state_machine, start_label, goal_label] = std::tie(arguments...);
    ObjectState::instance().keep_for_dumps(kept_event({ObjectKind::kStateMachine, state_machine}, "rcl_lifecycle_state",
                                                      state, state_machine, goal_label));
  }
}

}  // namespace tracetools
