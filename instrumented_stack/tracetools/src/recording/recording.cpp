// SPDX-License-Identifier: Apache-2.0
#include "recording/recording.hpp"

#include <lttng/ust-ringbuffer-context.h>

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace tracetools {
namespace {

// The generated probes of all providers are in one library. Between the lowest and the highest address are no other
// functions that anybody attaches to a tracepoint.
std::atomic<std::uintptr_t> lowest_probe{UINTPTR_MAX};
std::atomic<std::uintptr_t> highest_probe{0};

bool is_generated(const Probe& probe) {
  const auto address = reinterpret_cast<std::uintptr_t>(probe.func);
  return address >= lowest_probe.load(std::memory_order_relaxed) &&
         address <= highest_probe.load(std::memory_order_relaxed);
}

// Null if the function of the probe does something else than to record into a channel.
[[gnu::always_inline]] inline lttng_ust_event_recorder* recorder(const Probe& probe) {
  if (!is_generated(probe)) {
    return nullptr;
  }
  auto* const event = static_cast<lttng_ust_event_common*>(probe.data);
  return event->type == LTTNG_UST_EVENT_TYPE_RECORDER ? static_cast<lttng_ust_event_recorder*>(event->child) : nullptr;
}

// Into the channel of the probe. False if its function has to be called.
[[gnu::always_inline]] inline bool write(const Probe& probe, const void* payload, std::size_t size, void* caller) {
  lttng_ust_event_recorder* const to = recorder(probe);
  if (to == nullptr) {
    return false;
  }
  const lttng_ust_event_common* const event = static_cast<lttng_ust_event_common*>(probe.data);
  if (CMM_LOAD_SHARED(event->eval_filter) != 0) {
    return false;
  }
  lttng_ust_channel_buffer* const channel = to->chan;
  if (CMM_LOAD_SHARED(event->enabled) == 0 || CMM_LOAD_SHARED(channel->parent->enabled) == 0 ||
      !records(*channel->parent->session)) {
    return true;
  }
  lttng_ust_probe_ctx probe_context{.struct_size = sizeof(lttng_ust_probe_ctx), .ip = caller};
  lttng_ust_ring_buffer_ctx context;
  lttng_ust_ring_buffer_ctx_init(&context, to, size, 1, &probe_context);
  if (channel->ops->event_reserve(&context) < 0) {
    return true;
  }
  if (size != 0) {
    channel->ops->event_write(&context, payload, size, 1);
  }
  channel->ops->event_commit(&context);
  return true;
}

}  // namespace

[[gnu::hot]] void record(const Tracepoint& tracepoint, CountedEvent event, const void* payload, std::size_t size,
                         ProbeCall call) {
  void* const caller = __builtin_return_address(0);
  count(event);
  const ProbesInUse probes;
  for_each_probe(probes, tracepoint, [&](const Probe& probe) {
    if (!write(probe, payload, size, caller)) {
      call(probe, payload);
    }
  });
}

const lttng_ust_event_recorder* recorder_of(const Probe& probe) noexcept {
  return recorder(probe);
}

void add_generated_probes(const lttng_ust_probe_desc& provider) noexcept {
  for (unsigned int i = 0; i < provider.nr_events; ++i) {
    const auto probe = reinterpret_cast<std::uintptr_t>(provider.event_desc[i]->tp_class->probe_callback);
    lowest_probe = std::min(lowest_probe.load(), probe);
    highest_probe = std::max(highest_probe.load(), probe);
  }
}

}  // namespace tracetools
