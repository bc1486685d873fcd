// SPDX-License-Identifier: Apache-2.0
#include "tracing/account/loss_counters.hpp"

#include <fmt/core.h>
#include <lttng/lttng.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>

#include "tracing/lttng/channels.hpp"
#include "tracing/lttng/lttng_error.hpp"
#include "tracing/plan/channel_plan.hpp"

namespace tracing {
namespace {

struct Free {
  void operator()(void* memory) const { std::free(memory); }
};

// LTTng 2.13 now and then returns the count of a userspace channel with the highest bit set.
constexpr std::uint64_t kCountBits = ~(std::uint64_t{1} << 63);

void read_domain(const std::string& session, const lttng_domain& domain, LossAccount& account) {
  const DomainHandle handle = domain_handle(session, domain);
  const std::string doing = fmt::format("read the lost events of session '{}'", session);
  lttng_channel* listed = nullptr;
  const int count = check_lttng(lttng_list_channels(handle.get(), &listed), doing);
  const std::unique_ptr<lttng_channel, Free> channels(listed);
  for (int i = 0; i < count; ++i) {
    ChannelLoss loss{.domain = domain_name(domain.type), .channel = listed[i].name};
    loss.subbuffer_size = listed[i].attr.subbuf_size;
    loss.subbuffer_count = listed[i].attr.num_subbuf;
    check_lttng(lttng_channel_get_discarded_event_count(&listed[i], &loss.discarded_events), doing);
    check_lttng(lttng_channel_get_lost_packet_count(&listed[i], &loss.lost_packets), doing);
    loss.discarded_events &= kCountBits;
    loss.lost_packets &= kCountBits;
    account.channels.push_back(std::move(loss));
  }
}

}  // namespace

LossAccount read_losses(const std::string& lttng_session_name) {
  LossAccount account;
  lttng_domain* listed = nullptr;
  const int count = check_lttng(lttng_list_domains(lttng_session_name.c_str(), &listed),
                                fmt::format("list the domains of session '{}'", lttng_session_name));
  const std::unique_ptr<lttng_domain, Free> domains(listed);
  for (int i = 0; i < count; ++i) read_domain(lttng_session_name, listed[i], account);
  return account;
}

}  // namespace tracing
