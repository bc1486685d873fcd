// SPDX-License-Identifier: Apache-2.0
#include "recording/fetch_plan.hpp"

#include <lttng/ust-events.h>

namespace tracetools {
namespace {

constexpr std::size_t kLine = 64;  // bytes

using Address = std::atomic<std::uintptr_t>;

void fetch_data(const Address& address, std::size_t offset = 0) {
  __builtin_prefetch(reinterpret_cast<const void*>(address.load(std::memory_order_relaxed) + offset));
}

// Usually nothing has changed. Then the plan is only read, and stays in the caches of all processors.
void keep(Address& address, const void* pointer) {
  const auto value = reinterpret_cast<std::uintptr_t>(pointer);
  if (address.load(std::memory_order_relaxed) != value) {
    address.store(value, std::memory_order_relaxed);
  }
}

// A thread renews a plan with every 17th message that it publishes or takes. Seldom is a message exchanged in a pattern
// of 17, so each plan has its turn.
constexpr unsigned kTurns = 16;
thread_local constinit unsigned turns [[gnu::tls_model("initial-exec")]] = 0;

}  // namespace

[[gnu::hot]] void FetchPlan::fetch() const noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    const OfEvent& each = of_events_[i];
    fetch_data(each.probe);
    fetch_data(each.event, offsetof(lttng_ust_event_common, type));
    fetch_data(each.event, offsetof(lttng_ust_event_common, eval_filter));
    fetch_data(each.recorder, offsetof(lttng_ust_event_recorder, chan));
    fetch_data(each.recorder_private);
  }
  fetch_data(of_channel_.channel);
  fetch_data(of_channel_.parent);
  fetch_data(of_channel_.channel_private);
  fetch_data(of_channel_.channel_private, kLine);
  fetch_data(of_channel_.session);
  fetch_data(of_channel_.functions);
}

[[gnu::hot]] void FetchPlan::renew() noexcept {
  if (turns-- != 0) {
    return;
  }
  turns = kTurns;
  find_addresses();
}

void FetchPlan::find_addresses() noexcept {
  const ProbesInUse probes;
  const lttng_ust_channel_buffer* channel = nullptr;
  for (std::size_t i = 0; i < count_; ++i) {
    const Probe* const probe = probes.of(*followers_[i]);
    const lttng_ust_event_recorder* const recorder = probe == nullptr ? nullptr : recorder_of(*probe);
    if (recorder == nullptr) {
      continue;
    }
    keep(of_events_[i].probe, probe);
    keep(of_events_[i].event, recorder->parent);
    keep(of_events_[i].recorder, recorder);
    keep(of_events_[i].recorder_private, recorder->priv);
    channel = recorder->chan;
  }
  if (channel == nullptr) {
    return;
  }
  keep(of_channel_.channel, channel);
  keep(of_channel_.parent, channel->parent);
  keep(of_channel_.channel_private, channel->priv);
  keep(of_channel_.session, channel->parent->session);
  keep(of_channel_.functions, channel->ops);
}

[[gnu::hot]] void record_first(const Tracepoint& tracepoint, CountedEvent event, const void* payload, std::size_t size,
                               ProbeCall call, FetchPlan& followers) {
  followers.fetch();
  record(tracepoint, event, payload, size, call);
  followers.renew();
}

}  // namespace tracetools
