// SPDX-License-Identifier: Apache-2.0
#include "rcutils/logging.h"

#include <strings.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <string_view>
#include <utility>

#include "log_line.hpp"
#include "rcutils/error_handling.h"
#include "rcutils/format_log_line.hpp"

namespace {

constexpr std::array<std::pair<int, const char*>, 6> kSeverities{{
    {RCUTILS_LOG_SEVERITY_UNSET, "UNSET"},
    {RCUTILS_LOG_SEVERITY_DEBUG, "DEBUG"},
    {RCUTILS_LOG_SEVERITY_INFO, "INFO"},
    {RCUTILS_LOG_SEVERITY_WARN, "WARN"},
    {RCUTILS_LOG_SEVERITY_ERROR, "ERROR"},
    {RCUTILS_LOG_SEVERITY_FATAL, "FATAL"},
}};

struct Logging {
  std::shared_mutex mutex;  // guards everything that is not atomic
  std::atomic<bool> initialized{false};
  std::atomic<int> default_level{RCUTILS_DEFAULT_LOGGER_DEFAULT_LEVEL};
  std::atomic<rcutils_logging_output_handler_t> handler{rcutils_logging_console_output_handler};
  std::atomic<bool> has_levels{false};  // avoids the lock in the usual case: only the default level is set
  std::map<std::string, int, std::less<>> levels;
  rcutils::LogLine line;
  FILE* stream = stderr;
  bool colorized = false;
};

// Never destroyed: static objects of other libraries may log while the process ends.
Logging& logging() {
  static Logging& instance = *new Logging;
  return instance;
}

// The value of a variable that may be 0 or 1. `unset` if it is absent or empty; -1, with the error set, if it is wrong.
int read_switch(const char* variable, int unset) {
  const char* value = std::getenv(variable);
  if (value == nullptr || *value == '\0') {
    return unset;
  }
  if (std::strcmp(value, "0") == 0) {
    return 0;
  }
  if (std::strcmp(value, "1") == 0) {
    return 1;
  }
  RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING("%s is '%s', but must be 0 or 1", variable, value);
  return -1;
}

rcutils_ret_t read_environment(Logging& log) {
  rcutils_ret_t result = RCUTILS_RET_OK;
  const auto read = [&](const char* variable, int unset) {
    const int value = read_switch(variable, unset);
    if (value == -1) {
      result = RCUTILS_RET_INVALID_ARGUMENT;
    }
    return value == -1 ? unset : value;
  };
  constexpr int kUnset = 2;
  log.stream = read("RCUTILS_LOGGING_USE_STDOUT", 0) == 1 ? stdout : stderr;
  const int buffered = read("RCUTILS_LOGGING_BUFFERED_STREAM", kUnset);
  if (buffered != kUnset) {
    std::setvbuf(log.stream, nullptr, buffered == 1 ? _IOLBF : _IONBF, 0);
  }
  const int colorized = read("RCUTILS_COLORIZED_OUTPUT", kUnset);
  log.colorized = colorized == kUnset ? isatty(fileno(log.stream)) == 1 : colorized == 1;
  const char* format = std::getenv("RCUTILS_CONSOLE_OUTPUT_FORMAT");
  log.line = rcutils::LogLine(format == nullptr || *format == '\0' ? rcutils::LogLine::kDefaultFormat
                                                                   : std::string_view(format));
  return result;
}

void log_valist(const rcutils_log_location_t* location, int severity, const char* name, const char* format,
                va_list* args) {
  rcutils_time_point_value_t now = 0;
  (void)rcutils_system_time_now(&now);
  const auto handler = logging().handler.load(std::memory_order_acquire);
  if (handler != nullptr) {
    handler(location, severity, name == nullptr ? "" : name, now, format, args);
  }
}

}  // namespace

bool g_rcutils_logging_initialized = false;

const char* const g_rcutils_log_severity_names[RCUTILS_LOG_SEVERITY_FATAL + 1] = {
    "UNSET", nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,  // 0
    "DEBUG", nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,  // 10
    "INFO",  nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,  // 20
    "WARN",  nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,  // 30
    "ERROR", nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,  // 40
    "FATAL"};

rcutils_ret_t rcutils_logging_initialize_with_allocator(rcutils_allocator_t allocator) {
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(&allocator, "Provided allocator is invalid.", return RCUTILS_RET_INVALID_ARGUMENT)
  return rcutils_logging_initialize();
}

rcutils_ret_t rcutils_logging_initialize(void) {
  Logging& log = logging();
  if (log.initialized.load(std::memory_order_acquire)) {
    return RCUTILS_RET_OK;
  }
  std::unique_lock lock(log.mutex);
  if (log.initialized.load(std::memory_order_relaxed)) {
    return RCUTILS_RET_OK;
  }
  const rcutils_ret_t result = read_environment(log);
  g_rcutils_logging_initialized = true;
  log.initialized.store(true, std::memory_order_release);
  return result;
}

rcutils_ret_t rcutils_logging_shutdown(void) {
  Logging& log = logging();
  std::unique_lock lock(log.mutex);
  log.levels.clear();
  log.has_levels = false;
  log.default_level = RCUTILS_DEFAULT_LOGGER_DEFAULT_LEVEL;
  log.handler = rcutils_logging_console_output_handler;
  log.initialized = false;
  g_rcutils_logging_initialized = false;
  return RCUTILS_RET_OK;
}

rcutils_logging_output_handler_t rcutils_logging_get_output_handler(void) {
  RCUTILS_LOGGING_AUTOINIT;
  return logging().handler;
}

void rcutils_logging_set_output_handler(rcutils_logging_output_handler_t handler) {
  RCUTILS_LOGGING_AUTOINIT;
  logging().handler = handler;
}

int rcutils_logging_get_default_logger_level(void) {
  return logging().default_level;
}

void rcutils_logging_set_default_logger_level(int level) {
  logging().default_level = level == RCUTILS_LOG_SEVERITY_UNSET ? RCUTILS_DEFAULT_LOGGER_DEFAULT_LEVEL : level;
}

int rcutils_logging_get_logger_level(const char* name) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(name, -1);
  return rcutils_logging_get_logger_leveln(name, std::strlen(name));
}

int rcutils_logging_get_logger_leveln(const char* name, size_t name_length) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(name, -1);
  if (name_length == 0) {
    return rcutils_logging_get_default_logger_level();
  }
  Logging& log = logging();
  std::shared_lock lock(log.mutex);
  const auto found = log.levels.find(std::string_view(name, name_length));
  return found == log.levels.end() ? static_cast<int>(RCUTILS_LOG_SEVERITY_UNSET) : found->second;
}

rcutils_ret_t rcutils_logging_set_logger_level(const char* name, int level) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(name, RCUTILS_RET_INVALID_ARGUMENT);
  if (rcutils_logging_severity_name(level) == nullptr) {
    RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING("%d is no log level", level);
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  if (*name == '\0') {
    logging().default_level = level;  // UNSET lets every message pass
    return RCUTILS_RET_OK;
  }
  Logging& log = logging();
  std::unique_lock lock(log.mutex);
  if (level == RCUTILS_LOG_SEVERITY_UNSET) {
    log.levels.erase(name);
  } else {
    log.levels[name] = level;
  }
  log.has_levels = !log.levels.empty();
  return RCUTILS_RET_OK;
}

int rcutils_logging_get_logger_effective_level(const char* name) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(name, -1);
  Logging& log = logging();
  if (log.has_levels.load(std::memory_order_acquire)) {
    std::shared_lock lock(log.mutex);
    for (std::string_view rest = name; !rest.empty();) {
      const auto found = log.levels.find(rest);
      if (found != log.levels.end()) {
        return found->second;
      }
      const size_t separator = rest.rfind(RCUTILS_LOGGING_SEPARATOR_CHAR);
      rest = separator == std::string_view::npos ? std::string_view() : rest.substr(0, separator);
    }
  }
  return log.default_level;
}

bool rcutils_logging_logger_is_enabled_for(const char* name, int severity) {
  return severity >= rcutils_logging_get_logger_effective_level(name == nullptr ? "" : name);
}

const char* rcutils_logging_severity_name(int severity) {
  for (const auto& [level, name] : kSeverities) {
    if (level == severity) {
      return name;
    }
  }
  return nullptr;
}

rcutils_ret_t rcutils_logging_severity_level_from_string(const char* severity_string, rcutils_allocator_t,
                                                         int* severity) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(severity_string, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(severity, RCUTILS_RET_INVALID_ARGUMENT);
  for (const auto& [level, name] : kSeverities) {
    if (strcasecmp(name, severity_string) == 0) {
      *severity = level;
      return RCUTILS_RET_OK;
    }
  }
  return RCUTILS_RET_LOGGING_SEVERITY_STRING_INVALID;
}

void rcutils_log(const rcutils_log_location_t* location, int severity, const char* name, const char* format, ...) {
  if (!rcutils_logging_logger_is_enabled_for(name, severity)) {
    return;
  }
  va_list args;
  va_start(args, format);
  log_valist(location, severity, name, format, &args);
  va_end(args);
}

void rcutils_log_internal(const rcutils_log_location_t* location, int severity, const char* name, const char* format,
                          ...) {
  va_list args;
  va_start(args, format);
  log_valist(location, severity, name, format, &args);
  va_end(args);
}

namespace rcutils {
namespace {

// Kept on the stack unless it is long. The arguments stay usable for the next handler.
class Message {
 public:
  Message(const char* format, va_list* args) {
    va_list copy;
    va_copy(copy, *args);
    const int length = std::vsnprintf(buffer_, sizeof(buffer_), format, copy);
    va_end(copy);
    text_ = {buffer_, static_cast<size_t>(std::max(length, 0))};
    if (text_.size() >= sizeof(buffer_)) {
      long_text_.resize(text_.size());
      va_copy(copy, *args);
      std::vsnprintf(long_text_.data(), long_text_.size() + 1, format, copy);
      va_end(copy);
      text_ = long_text_;
    }
  }
  std::string_view text() const { return text_; }

 private:
  char buffer_[1024];
  std::string long_text_;
  std::string_view text_;
};

}  // namespace

std::string format_log_line(const rcutils_log_location_t* location, int severity, const char* name,
                            rcutils_time_point_value_t timestamp, const char* format, va_list* args) {
  RCUTILS_LOGGING_AUTOINIT;
  const Message message(format, args);
  Logging& log = logging();
  std::shared_lock lock(log.mutex);
  return log.line.fill(location, severity, name, timestamp, message.text(), false);
}

}  // namespace rcutils

void rcutils_logging_console_output_handler(const rcutils_log_location_t* location, int severity, const char* name,
                                            rcutils_time_point_value_t timestamp, const char* format, va_list* args) {
  RCUTILS_LOGGING_AUTOINIT;
  const rcutils::Message message(format, args);
  Logging& log = logging();
  std::string line;
  FILE* stream;
  {
    std::shared_lock lock(log.mutex);
    line = log.line.fill(location, severity, name, timestamp, message.text(), log.colorized);
    stream = log.stream;
  }
  std::fwrite(line.data(), 1, line.size(), stream);
}

rcutils_ret_t rcutils_logging_format_message(const rcutils_log_location_t* location, int severity, const char* name,
                                             rcutils_time_point_value_t timestamp, const char* msg,
                                             rcutils_char_array_t* logging_output) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(msg, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(logging_output, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_LOGGING_AUTOINIT;
  Logging& log = logging();
  std::shared_lock lock(log.mutex);
  std::string line = log.line.fill(location, severity, name, timestamp, msg, false);
  line.pop_back();  // the newline
  return rcutils_char_array_strncat(logging_output, line.data(), line.size());
}
