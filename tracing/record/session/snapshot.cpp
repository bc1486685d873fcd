// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/snapshot.hpp"

#include <fmt/core.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <memory>
#include <utility>

#include "base/monotonic_clock.hpp"
#include "tracing/record/account/absence.hpp"
#include "tracing/record/account/counters/event_counters.hpp"
#include "tracing/record/account/counters/launch_processes.hpp"
#include "tracing/record/account/loss_text.hpp"
#include "tracing/record/account/readable_traces.hpp"
#include "tracing/record/account/stream_packets.hpp"
#include "tracing/record/account/unwritten_data.hpp"
#include "tracing/record/account/verdict.hpp"
#include "tracing/record/kernel/kernel_recorder.hpp"
#include "tracing/record/lttng/answer_limit.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/session/session_listing.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

// In sub-buffers of the userspace channel: ten as in ros2_tracing, or all where there are more processors than that is
// enough for. LTTng refuses less than one for each.
std::uint64_t largest_snapshot(const TraceConfig& config) {
  return std::max<std::uint64_t>(10, static_cast<std::uint64_t>(get_nprocs_conf()) * config.ust.subbuffer_count);
}

// LTTng numbers the snapshots of a session in their names: snapshot-20261121-190000-17.
long number_of(const fs::path& snapshot) {
  const std::string name = snapshot.filename();
  const std::size_t digits = name.rfind('-') + 1;
  long number = -1;
  std::from_chars(name.data() + digits, name.data() + name.size(), number);
  return number;
}

// Takes a snapshot with LTTng, then adds the buffers of the kernel recorder to it. Both parts hold the events before
// the reason for the snapshot.
std::uint64_t record(const std::string& name, bool clear) {
  check_daemons_not_stopped();
  const auto asked = static_cast<std::uint64_t>(launch::monotonic_time());
  check_lttng(lttng_snapshot_record(name.c_str(), nullptr, 0), fmt::format("record a snapshot of session '{}'", name));
  const std::optional<fs::path> directory = snapshot_directory(name);
  if (!directory) {
    return asked;
  }
  const std::vector<fs::path> snapshots = snapshots_in(*directory);
  if (!snapshots.empty()) {
    take_kernel_snapshot(*directory, snapshots.back(), clear);
  }
  return asked;
}

// Of a processor whose oldest events were overwritten before the snapshot: what happened at the moment is not in it.
std::string missing_at_begin(const std::vector<Stream>& streams, std::int64_t moment) {
  std::uint64_t begins = 0;
  for (const Stream& stream : streams) {
    if (!stream.packets.empty() && stream.packets.front().sequence_number.value_or(0) > 0) {
      begins = std::max(begins, stream.packets.front().begin);
    }
  }
  if (moment <= 0 || begins <= static_cast<std::uint64_t>(moment)) {
    return {};
  }
  return fmt::format("the snapshot begins {:.3f} s after its reason: the buffers did not hold more",
                     to_seconds(begins - static_cast<std::uint64_t>(moment)));
}

}  // namespace

void add_snapshot_output(const TraceConfig& config) {
  const std::string doing = fmt::format("add the output of snapshot session '{}'", config.lttng_session_name());
  const LttngOwned<lttng_snapshot_output> output(lttng_snapshot_output_create(), lttng_snapshot_output_destroy);
  if (!output) {
    throw lttng_error(LTTNG_ERR_NOMEM, doing);
  }
  check_lttng(lttng_snapshot_output_set_name(kSnapshotName, output.get()), doing);
  if (config.over_network()) {
    check_lttng(lttng_snapshot_output_set_network_url(config.url.c_str(), output.get()), doing);
  } else {
    const std::string url = "file://" + config.trace_directory();
    check_lttng(lttng_snapshot_output_set_local_path(url.c_str(), output.get()), doing);
  }
  const std::uint64_t size =
      config.snapshot_size != 0 ? config.snapshot_size : largest_snapshot(config) * config.ust.subbuffer_size;
  check_lttng(lttng_snapshot_output_set_size(size, output.get()), doing);
  check_lttng(lttng_snapshot_add_output(config.lttng_session_name().c_str(), output.get()), doing);
}

std::optional<fs::path> snapshot_directory(const std::string& name) {
  lttng_snapshot_output_list* listed = nullptr;
  if (lttng_snapshot_list_output(name.c_str(), &listed) != 0) {
    return std::nullopt;
  }
  const LttngOwned<lttng_snapshot_output_list> outputs(listed, lttng_snapshot_output_list_destroy);
  const lttng_snapshot_output* const output = lttng_snapshot_output_list_get_next(outputs.get());
  if (output == nullptr) {
    return std::nullopt;
  }
  const std::string url = lttng_snapshot_output_get_ctrl_url(output);
  if (url.starts_with('/')) {
    return url;
  }
  constexpr std::string_view kFile = "file://";
  if (url.starts_with(kFile)) {
    return url.substr(kFile.size());
  }
  return std::nullopt;
}

std::vector<fs::path> snapshots_in(const fs::path& directory) {
  std::vector<fs::path> snapshots;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, none)) {
    if (entry.path().filename().string().starts_with(std::string(kSnapshotName) + "-")) {
      snapshots.push_back(entry.path());
    }
  }
  std::sort(snapshots.begin(), snapshots.end(),
            [](const fs::path& a, const fs::path& b) { return number_of(a) < number_of(b); });
  return snapshots;
}

std::string recorder_directory(const std::string& name) {
  if (const auto snapshots = snapshot_directory(name)) {
    return *snapshots;
  }
  const std::optional<SessionSummary> session = find_session(name);
  return session ? session->path : "";
}

std::string judge_snapshot(const fs::path& snapshot, const std::string& name, const std::string& counters,
                           const std::vector<std::string>& reasons, const SnapshotMoment& moment) {
  SnapshotAccount account{.reasons = reasons, .absences = put_unreadable_aside(snapshot)};
  const std::vector<Stream> streams = read_streams(snapshot);
  const std::vector<EventCounts> counts =
      counters.empty() ? std::vector<EventCounts>() : EventCounters(counters).read();
  account.launch_processes = read_launch_processes(counters, counts);
  if (has_buffers_of_processes(name)) {
    // Programs that do not count their events are not among these.
    std::vector<Absence> ended = absent_from_snapshot(counts, streams);
    const bool is_empty =
        std::all_of(streams.begin(), streams.end(), [](const Stream& stream) { return stream.packets.empty(); });
    if (ended.empty() && (counters.empty() || !moment.died.empty() || is_empty)) {
      ended.push_back({"each process has buffers of its own: programs that had ended are not in the snapshot"});
    }
    std::move(ended.begin(), ended.end(), std::back_inserter(account.absences));
  }
  if (std::string missing = missing_at_begin(streams, moment.of_reason); !missing.empty()) {
    account.absences.push_back({std::move(missing)});
  }
  account.unwritten = unfinished_streams(streams, moment.asked);
  for (UnwrittenRange& range : account.unwritten) {
    range.after_losses = false;  // buffers that overwrite are never full
  }
  const std::vector<std::string> killed = killed_processes(counts);
  account.damage = describe_unfinished(account.unwritten, killed.empty() ? moment.died : killed);
  write_snapshot_verdict(snapshot, name, account, streams);
  const std::string lost = describe_snapshot_losses(streams);
  return account.damage + (account.damage.empty() || lost.empty() ? "" : "; ") + lost;
}

std::uint64_t record_snapshot(const std::string& name) {
  return record(name, false);
}

void have_objects_told_again(const std::string& name) {
  lttng_regenerate_statedump(name.c_str());  // an error costs names in later snapshots, and nothing else
}

std::uint64_t record_and_clear(const std::string& name) {
  const std::uint64_t asked = record(name, true);

  const std::string doing = fmt::format("clear session '{}' after its snapshot", name);
  lttng_clear_handle* started = nullptr;
  if (const lttng_error_code code = lttng_clear_session(name.c_str(), &started); code != LTTNG_OK) {
    throw lttng_error(code, doing);
  }
  const LttngOwned<lttng_clear_handle> handle(started, lttng_clear_handle_destroy);
  lttng_error_code result = LTTNG_ERR_UNK;
  const auto longest = static_cast<int>(longest_silence().count());
  if (lttng_clear_handle_wait_for_completion(handle.get(), longest) != LTTNG_CLEAR_HANDLE_STATUS_COMPLETED ||
      lttng_clear_handle_get_result(handle.get(), &result) != LTTNG_CLEAR_HANDLE_STATUS_OK || result != LTTNG_OK) {
    throw lttng_error(result, doing);
  }
  return asked;
}

}  // namespace tracing
