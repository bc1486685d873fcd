#include "tracing/session/snapshot.hpp"

#include <fmt/core.h>
#include <lttng/lttng.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <memory>

#include "tracing/session/lttng_error.hpp"

namespace tracing {
namespace {

// In sub-buffers of the userspace channel: ten as in ros2_tracing, or all where there are more processors than that is
// enough for. LTTng refuses less than one for each.
std::uint64_t largest_snapshot(const TraceConfig& config) {
  return std::max<std::uint64_t>(10, static_cast<std::uint64_t>(get_nprocs_conf()) * config.subbuffer_count_ust);
}

constexpr int kWaitForever = -1;

}  // namespace

void add_snapshot_output(const TraceConfig& config) {
  const std::string doing = fmt::format("add the output of snapshot session '{}'", config.lttng_session_name());
  const std::unique_ptr<lttng_snapshot_output, decltype(&lttng_snapshot_output_destroy)> output(
      lttng_snapshot_output_create(), &lttng_snapshot_output_destroy);
  if (!output) throw lttng_error(LTTNG_ERR_NOMEM, doing);
  check_lttng(lttng_snapshot_output_set_name(kSnapshotName, output.get()), doing);
  if (config.over_network()) {
    check_lttng(lttng_snapshot_output_set_network_url(config.url.c_str(), output.get()), doing);
  } else {
    const std::string url = "file://" + config.trace_directory();
    check_lttng(lttng_snapshot_output_set_local_path(url.c_str(), output.get()), doing);
  }
  const std::uint64_t size =
      config.snapshot_size != 0 ? config.snapshot_size : largest_snapshot(config) * config.subbuffer_size_ust;
  check_lttng(lttng_snapshot_output_set_size(size, output.get()), doing);
  check_lttng(lttng_snapshot_add_output(config.lttng_session_name().c_str(), output.get()), doing);
}

void record_snapshot(const std::string& name) {
  check_lttng(lttng_snapshot_record(name.c_str(), nullptr, 0), fmt::format("record a snapshot of session '{}'", name));
}

void record_and_clear(const std::string& name) {
  record_snapshot(name);

  const std::string doing = fmt::format("clear session '{}' after its snapshot", name);
  lttng_clear_handle* started = nullptr;
  if (const lttng_error_code code = lttng_clear_session(name.c_str(), &started); code != LTTNG_OK) {
    throw lttng_error(code, doing);
  }
  const std::unique_ptr<lttng_clear_handle, decltype(&lttng_clear_handle_destroy)> handle(started,
                                                                                          &lttng_clear_handle_destroy);
  lttng_error_code result = LTTNG_ERR_UNK;
  if (lttng_clear_handle_wait_for_completion(handle.get(), kWaitForever) != LTTNG_CLEAR_HANDLE_STATUS_COMPLETED ||
      lttng_clear_handle_get_result(handle.get(), &result) != LTTNG_CLEAR_HANDLE_STATUS_OK || result != LTTNG_OK) {
    throw lttng_error(result, doing);
  }
}

}  // namespace tracing
