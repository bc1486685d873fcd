// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "counters/event_counters.hpp"
#include "probes/probes.hpp"

namespace tracetools {

// Objects of different kinds may share an address: a struct and its first member.
enum class ObjectKind {
  kContext,
  kNode,
  kRmwPublisher,
  kPublisher,
  kRmwSubscription,
  kSubscription,
  kRclcppSubscription,
  kRmwService,
  kService,
  kRmwClient,
  kClient,
  kTimer,
  kCallback,
  kStateMachine,
  kIntraProcessBuffer,
  kRingBuffer,
};

struct ObjectKey {
  ObjectKind kind;
  const void* address;
  bool operator==(const ObjectKey&) const = default;
};

// An event about objects, with its arguments, as it is kept for later sessions.
struct InitEvent {
  std::vector<ObjectKey> objects;  // at least one
  // Another event of this name about the same first object takes its place. It lives as long as the process. An event
  // without a name (null) replaces no other.
  const char* name;
  const Tracepoint* tracepoint;
  CountedEvent counted;
  std::function<void(const Probe&)> record;  // through one probe of the tracepoint

  std::uint64_t number = 0;                  // in the order of their creation, from 1 on
  std::vector<std::uint32_t> got_live = {};  // the marks of the sessions that recorded it when it was fired
};

// A tracepoint and how one of its probes is called.
template <typename... Parameters>
struct Recorder {
  const Tracepoint* tracepoint;
  CountedEvent counted;

  void operator()(const Probe& probe, Parameters... values) const {
    reinterpret_cast<void (*)(void*, Parameters...)>(probe.func)(probe.data, values...);
  }
};

// From the function by which LTTng calls all probes of the tracepoint, whose parameters are those of the probes.
template <typename Callback>
struct RecorderOf;
template <typename... Parameters>
struct RecorderOf<void(Parameters...)> {
  using type = Recorder<Parameters...>;
};

// The recorder of an event, from LTTng's declaration of its tracepoint.
#define TRACETOOLS_RECORDER(provider, name)                                               \
  (tracetools::RecorderOf<decltype(lttng_ust_tracepoint_cb_##provider##___##name)>::type{ \
      &lttng_ust_tracepoint_##provider##___##name, tracetools::CountedEvent::name})

}  // namespace tracetools
