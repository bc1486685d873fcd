// SPDX-License-Identifier: Apache-2.0
#include "rcl/logging_rosout.h"

#include <condition_variable>
#include <cstdio>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

#include "rcl/error_handling.h"
#include "rcl/publisher.h"
#include "rcl_interfaces/msg/log.hpp"
#include "rosidl_typesupport_cpp/message_type_support.hpp"

namespace {

constexpr const char* kTopic = "/rosout";

struct Entry {
  rcl_node_t* node;
  rcl_publisher_t publisher = rcl_get_zero_initialized_publisher();
  bool is_ready = false;  // false while the publisher is being made
  // The threads that publish with it now.
  int users = 0;
};

// Publishers by logger name. The entries keep their addresses, because publisher addresses are handles in traces.
//
// The mutex protects the map and the members of the entries. Nothing of the middleware is called while it is held: the
// middleware may log with its own locks held, and a thread that logs takes this mutex.
struct Publishers {
  std::mutex mutex;
  std::condition_variable unused;
  std::map<std::string, Entry, std::less<>> by_logger;
  std::multiset<std::string> subloggers;
};

// Never destroyed, because nodes in static storage may be destroyed later.
Publishers& publishers() {
  static Publishers& instance = *new Publishers;
  return instance;
}

// A failing middleware can log while this thread publishes. Such messages must not be published.
thread_local bool is_publishing = false;

// The entry with the longest name that is `name` or an ancestor of it. The mutex must be held.
Entry* find_for(Publishers& all, std::string_view name) {
  while (!name.empty()) {
    const auto found = all.by_logger.find(name);
    if (found != all.by_logger.end() && found->second.is_ready) {
      return &found->second;
    }
    const std::size_t separator = name.rfind(RCUTILS_LOGGING_SEPARATOR_CHAR);
    name = separator == std::string_view::npos ? std::string_view() : name.substr(0, separator);
  }
  return nullptr;
}

std::string full_name(const char* logger_name, const char* sublogger_name) {
  return std::string(logger_name) + RCUTILS_LOGGING_SEPARATOR_CHAR + sublogger_name;
}

std::string formatted(const char* format, va_list* args) {
  va_list copy;
  va_copy(copy, *args);
  const int length = std::vsnprintf(nullptr, 0, format, copy);
  va_end(copy);
  std::string text(length < 0 ? 0 : static_cast<std::size_t>(length), '\0');
  va_copy(copy, *args);
  std::vsnprintf(text.data(), text.size() + 1, format, copy);
  va_end(copy);
  return text;
}

}  // namespace

rcl_ret_t rcl_logging_rosout_init_publisher_for_node(rcl_node_t* node) {
  if (!rcl_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  Publishers& all = publishers();
  std::unique_lock lock(all.mutex);
  const auto [entry, is_new] = all.by_logger.try_emplace(rcl_node_get_logger_name(node), Entry{node});
  if (!is_new) {
    return RCL_RET_OK;
  }
  lock.unlock();
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  options.qos = rcl_node_get_options(node)->rosout_qos;
  const rcl_ret_t result = rcl_publisher_init(
      &entry->second.publisher, node,
      rosidl_typesupport_cpp::get_message_type_support_handle<rcl_interfaces::msg::Log>(), kTopic, &options);
  lock.lock();
  if (result == RCL_RET_OK) {
    entry->second.is_ready = true;
  } else {
    all.by_logger.erase(entry);
  }
  return result;
}

rcl_ret_t rcl_logging_rosout_fini_publisher_for_node(rcl_node_t* node) {
  if (!rcl_node_is_valid_except_context(node)) {
    return RCL_RET_NODE_INVALID;
  }
  Publishers& all = publishers();
  std::unique_lock lock(all.mutex);
  const auto entry = all.by_logger.find(std::string_view(rcl_node_get_logger_name(node)));
  if (entry == all.by_logger.end() || entry->second.node != node) {
    return RCL_RET_OK;
  }
  // Nobody finds it any more, and another node of this name gets an entry of its own. It keeps its address.
  auto ending = all.by_logger.extract(entry);
  all.unused.wait(lock, [&] { return ending.mapped().users == 0; });
  lock.unlock();
  return rcl_publisher_fini(&ending.mapped().publisher, node);
}

rcl_ret_t rcl_logging_rosout_add_sublogger(const char* logger_name, const char* sublogger_name) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(logger_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(sublogger_name, RCL_RET_INVALID_ARGUMENT);
  std::string name = full_name(logger_name, sublogger_name);
  Publishers& all = publishers();
  const std::lock_guard lock(all.mutex);
  if (all.by_logger.count(std::string_view(logger_name)) == 0 && all.subloggers.count(logger_name) == 0) {
    RCL_SET_ERROR_MSG_WITH_FORMAT_STRING("no node has logger '%s'", logger_name);
    return RCL_RET_NOT_FOUND;
  }
  all.subloggers.insert(std::move(name));
  return RCL_RET_OK;
}

rcl_ret_t rcl_logging_rosout_remove_sublogger(const char* logger_name, const char* sublogger_name) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(logger_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(sublogger_name, RCL_RET_INVALID_ARGUMENT);
  const std::string name = full_name(logger_name, sublogger_name);
  Publishers& all = publishers();
  const std::lock_guard lock(all.mutex);
  const auto found = all.subloggers.find(name);
  if (found == all.subloggers.end()) {
    RCL_SET_ERROR_MSG_WITH_FORMAT_STRING("logger '%s' is not in use", name.c_str());
    return RCL_RET_NOT_FOUND;
  }
  all.subloggers.erase(found);
  return RCL_RET_OK;
}

void rcl_logging_rosout_output_handler(const rcutils_log_location_t* location, int severity, const char* name,
                                       rcutils_time_point_value_t timestamp, const char* format, va_list* args) {
  if (is_publishing) {
    return;
  }
  Publishers& all = publishers();
  std::unique_lock lock(all.mutex);
  Entry* entry = find_for(all, name == nullptr ? "" : name);
  // Logging continues after shutdown, publishing does not.
  if (entry == nullptr || !rcl_context_is_valid(entry->node->context)) {
    return;
  }
  ++entry->users;
  lock.unlock();

  is_publishing = true;
  rcl_interfaces::msg::Log message;
  message.stamp.sec = static_cast<int32_t>(RCUTILS_NS_TO_S(timestamp));
  message.stamp.nanosec = static_cast<uint32_t>(timestamp % RCUTILS_S_TO_NS(1));
  message.level = static_cast<uint8_t>(severity);
  message.name = name;
  message.msg = formatted(format, args);
  if (location != nullptr) {
    message.file = location->file_name;
    message.function = location->function_name;
    message.line = static_cast<uint32_t>(location->line_number);
  }
  if (rcl_publish(&entry->publisher, &message, nullptr) != RCL_RET_OK) {
    rcl_reset_error();
  }
  is_publishing = false;

  lock.lock();
  if (--entry->users == 0) {
    all.unused.notify_all();
  }
}
