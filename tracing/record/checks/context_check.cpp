// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/checks/context_check.hpp"

#include <fmt/core.h>
#include <linux/perf_event.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "tracing/record/account/stream_packets.hpp"
#include "tracing/record/lttng/channels.hpp"
#include "tracing/record/lttng/installed_program.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProbe = "launch-trace-probe";
constexpr const char* kProbeEvent = "launch_probe:fired";
constexpr std::uint64_t kBytesWithoutEvents = 84;  // of a packet: its header and its context

bool is_perf(const std::string& field) {
  return field.starts_with("perf:");
}

// A directory and a session that are gone at the end of the scope.
class TrialSession {
 public:
  TrialSession() : name_(fmt::format("launch-check-{}", getpid())) {
    std::string pattern = (fs::temp_directory_path() / "launch-check-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw TraceError(fmt::format("cannot create {}", pattern));
    }
    directory_ = pattern;
    check_lttng(lttng_create_session(name_.c_str(), directory_.c_str()), "create a session to try context fields");
  }
  ~TrialSession() {
    lttng_destroy_session(name_.c_str());
    std::error_code ignored;
    fs::remove_all(directory_, ignored);
  }
  TrialSession(const TrialSession&) = delete;
  TrialSession& operator=(const TrialSession&) = delete;

  const std::string& name() const { return name_; }
  const fs::path& directory() const { return directory_; }

 private:
  std::string name_;
  fs::path directory_;
};

}  // namespace

bool records_an_event(const std::vector<std::string>& context_fields, const fs::path& probe) {
  const TrialSession session;
  ChannelPlan plan;
  plan.channel = "trial";
  plan.events = {{.pattern = kProbeEvent}};
  plan.context_fields = context_fields;
  plan.subbuffer_size = static_cast<std::uint64_t>(getpagesize());
  plan.subbuffer_count = 2;
  plan.read_timer = 0;
  enable_channel(session.name(), plan);
  enable_events(session.name(), plan);
  add_contexts(session.name(), plan);
  const std::string doing = "try context fields";
  check_lttng(lttng_start_tracing(session.name().c_str()), doing);
  run_program(probe);
  check_lttng(lttng_stop_tracing(session.name().c_str()), doing);
  const std::vector<Stream> streams = read_streams(session.directory());
  return std::any_of(streams.begin(), streams.end(), [](const Stream& stream) {
    return std::any_of(stream.packets.begin(), stream.packets.end(),
                       [](const Packet& packet) { return packet.bytes > kBytesWithoutEvents; });
  });
}

std::vector<std::string> context_warnings(const std::vector<ChannelPlan>& channels) {
  std::vector<std::string> warnings;
  const std::optional<fs::path> probe = installed_program(kProbe);
  for (const ChannelPlan& channel : channels) {
    std::vector<std::string> counters;
    std::copy_if(channel.context_fields.begin(), channel.context_fields.end(), std::back_inserter(counters), is_perf);
    if (channel.domain != LTTNG_DOMAIN_UST || counters.empty()) {
      continue;
    }
    if (probe && records_an_event(counters, *probe)) {
      continue;
    }
    const std::vector<std::string> reasons = perf_warnings(counters);
    warnings.insert(warnings.end(), reasons.begin(), reasons.end());
    if (probe && reasons.empty()) {
      warnings.push_back(
          fmt::format("with the performance counters of channel '{}' LTTng records no events here: leave them out",
                      channel.channel));
    }
  }
  return warnings;
}

std::string why_not_countable(const PerfCounter& counter) {
  perf_event_attr attributes{};
  attributes.size = sizeof attributes;
  attributes.type = counter.type;
  attributes.config = counter.config;
  attributes.disabled = 1;
  attributes.exclude_kernel = 1;  // as LTTng-UST does where it must
  const long fd = syscall(SYS_perf_event_open, &attributes, 0, -1, -1, PERF_FLAG_FD_CLOEXEC);
  if (fd < 0) {
    return std::strerror(errno);
  }
  close(static_cast<int>(fd));
  return {};
}

std::vector<std::string> perf_warnings(const std::vector<std::string>& context_fields_ust) {
  constexpr std::string_view kPrefix = "perf:thread:";
  std::vector<std::string> warnings;
  for (const std::string& name : context_fields_ust) {
    if (!name.starts_with(kPrefix)) {
      continue;
    }
    const auto counter = find_perf_counter(name.substr(kPrefix.size()));
    if (!counter) {
      continue;
    }
    if (const std::string reason = why_not_countable(*counter); !reason.empty()) {
      warnings.push_back(
          fmt::format("context field '{}' cannot be counted here ({}): LTTng will record no events; leave it "
                      "out, or see whether /proc/sys/kernel/perf_event_paranoid forbids it",
                      name, reason));
    }
  }
  return warnings;
}

}  // namespace tracing
