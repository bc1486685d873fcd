// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/loss_counters.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <utility>

#include "tracing/record/lttng/channels.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/lttng/lttng_list.hpp"
#include "tracing/record/plan/channel_plan.hpp"

namespace tracing {
namespace {

// LTTng 2.13 now and then returns the count of a userspace channel with the highest bit set.
constexpr std::uint64_t kCountBits = ~(std::uint64_t{1} << 63);

void read_domain(const std::string& session, const lttng_domain& domain, LossAccount& account) {
  const DomainHandle handle = domain_handle(session, domain);
  const std::string doing = fmt::format("read the lost events of session '{}'", session);
  for (lttng_channel& channel : LttngList<lttng_channel>(doing, lttng_list_channels, handle.get())) {
    ChannelLoss loss{.domain = domain_name(domain.type), .channel = channel.name};
    loss.counted_by = LossSource::kDaemon;
    loss.subbuffer_size = channel.attr.subbuf_size;
    loss.subbuffer_count = channel.attr.num_subbuf;
    loss.overwrite = channel.attr.overwrite != 0;
    loss.tracefile_size = channel.attr.tracefile_size;
    loss.tracefile_count = channel.attr.tracefile_count;
    check_lttng(lttng_channel_get_discarded_event_count(&channel, &loss.discarded_events), doing);
    check_lttng(lttng_channel_get_lost_packet_count(&channel, &loss.lost_packets), doing);
    loss.discarded_events &= kCountBits;
    loss.lost_packets &= kCountBits;
    account.channels.push_back(std::move(loss));
  }
}

}  // namespace

LossAccount read_losses(const std::string& lttng_session_name) {
  LossAccount account;
  const LttngList<lttng_domain> domains(fmt::format("list the domains of session '{}'", lttng_session_name),
                                        lttng_list_domains, lttng_session_name.c_str());
  for (const lttng_domain& domain : domains) {
    if (has_channels(domain)) {
      read_domain(lttng_session_name, domain, account);
    }
  }
  return account;
}

}  // namespace tracing
