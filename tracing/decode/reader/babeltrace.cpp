// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/babeltrace.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>

#include "tracing/decode/reader/trace_read_error.hpp"

namespace tracing::babeltrace {

void throw_noted_error(const std::string& what, const std::string& remedy) {
  std::string reason;
  std::string details;
  if (const bt_error* error = bt_current_thread_take_error()) {
    for (std::uint64_t i = 0; i < bt_error_get_cause_count(error); ++i) {  // the first cause is the innermost
      const bt_error_cause* cause = bt_error_borrow_cause_by_index(error, i);
      const std::string message = bt_error_cause_get_message(cause);
      if (i == 0) {
        reason = message;
      }
      details.insert(0, fmt::format("{}: {}\n", bt_error_cause_get_module_name(cause), message));
    }
    bt_error_release(error);
  }
  throw TraceReadError(reason.empty() ? what : fmt::format("{}: {}", what, reason), remedy, details);
}

void check(int status, const char* call) {
  constexpr int kOk = BT_GRAPH_RUN_STATUS_OK;  // the same value in every status enumeration of the library
  if (status != kOk) {
    throw_noted_error(fmt::format("libbabeltrace2: {} failed", call), "");
  }
}

Plugin find_plugin(const char* name) {
  const bt_plugin* plugin = nullptr;
  const bt_plugin_find_status status = bt_plugin_find(name, BT_TRUE, BT_TRUE, BT_TRUE, BT_TRUE, BT_FALSE, &plugin);
  if (status != BT_PLUGIN_FIND_STATUS_OK) {
    throw_noted_error(fmt::format("babeltrace2's plugin '{}' was not found", name),
                      "install libbabeltrace2-0, or correct the environment variable BABELTRACE_PLUGIN_PATH");
  }
  return Plugin(plugin);
}

Plugin find_plugin_beside(const Plugin& other, const char* name) {
  const char* const path = bt_plugin_get_path(other.get());
  const std::string directory = path != nullptr ? std::filesystem::path(path).parent_path().string() : std::string();
  const bt_plugin_set* set = nullptr;
  const std::string file = fmt::format("{}/babeltrace-plugin-{}.so", directory, name);
  if (directory.empty() ||
      bt_plugin_find_all_from_file(file.c_str(), BT_FALSE, &set) != BT_PLUGIN_FIND_ALL_FROM_FILE_STATUS_OK) {
    return find_plugin(name);
  }
  const bt_plugin* const plugin = bt_plugin_set_borrow_plugin_by_index_const(set, 0);
  bt_plugin_get_ref(plugin);
  bt_plugin_set_put_ref(set);
  return Plugin(plugin);
}

}  // namespace tracing::babeltrace
