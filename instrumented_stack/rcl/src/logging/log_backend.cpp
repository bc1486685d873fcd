// SPDX-License-Identifier: Apache-2.0
#include "logging/log_backend.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "logging/log_file.hpp"
#include "rcl_logging_interface/rcl_logging_interface.h"
#include "rcutils/error_handling.h"

namespace rcl {

namespace {

// A library with the functions of rcl_logging_interface. It stays loaded, because other threads may still be in it.
class LogLibrary final : public ExternalLog {
 public:
  // Throws std::runtime_error.
  LogLibrary(const std::string& name, const std::string& file_name_prefix, const std::string& config_file, int level)
      : library_("lib" + name + ".so"), handle_(dlopen(library_.c_str(), RTLD_LAZY | RTLD_LOCAL)) {
    if (handle_ == nullptr) {
      throw std::runtime_error("no library for RCL_LOGGING_IMPLEMENTATION=" + name + ": " + dlerror());
    }
    const auto initialize = function<decltype(rcl_logging_external_initialize)>("rcl_logging_external_initialize");
    shutdown_ = function<decltype(rcl_logging_external_shutdown)>("rcl_logging_external_shutdown");
    log_ = function<decltype(rcl_logging_external_log)>("rcl_logging_external_log");
    const auto set_level =
        function<decltype(rcl_logging_external_set_logger_level)>("rcl_logging_external_set_logger_level");
    const auto given = [](const std::string& text) { return text.empty() ? nullptr : text.c_str(); };
    check(initialize(given(file_name_prefix), given(config_file), rcutils_get_default_allocator()), "begin");
    check(set_level(nullptr, level), "set its level");
  }
  ~LogLibrary() override { (void)shutdown_(); }
  LogLibrary(const LogLibrary&) = delete;
  LogLibrary& operator=(const LogLibrary&) = delete;

  void write(int severity, const char* name, std::string line) override {
    if (line.ends_with('\n')) {
      line.pop_back();
    }
    log_(severity, name, line.c_str());
  }

 private:
  template <typename FunctionT>
  FunctionT* function(const char* name) const {
    void* const symbol = dlsym(handle_, name);
    if (symbol == nullptr) {
      throw std::runtime_error(library_ + " is no logging backend: it has no function " + name + "()");
    }
    return reinterpret_cast<FunctionT*>(symbol);
  }

  void check(rcl_logging_ret_t result, const char* what) const {
    if (result != RCL_LOGGING_RET_OK) {
      const std::string reason = rcutils_error_is_set() ? std::string(": ") + rcutils_get_error_state()->message : "";
      throw std::runtime_error("the logging backend " + library_ + " could not " + what + reason);
    }
  }

  std::string library_;
  void* handle_;
  decltype(rcl_logging_external_shutdown)* shutdown_ = nullptr;
  decltype(rcl_logging_external_log)* log_ = nullptr;
};

}  // namespace

std::unique_ptr<ExternalLog> open_external_log(const std::string& file_name_prefix, const std::string& config_file,
                                               int level) {
  const char* const variable = std::getenv("RCL_LOGGING_IMPLEMENTATION");
  const std::string name = variable == nullptr ? "" : variable;
  if (name == "rcl_logging_noop") {
    return nullptr;
  }
  if (name.empty() || name == "rcl_logging_spdlog") {
    return std::make_unique<LogFile>(file_name_prefix);
  }
  return std::make_unique<LogLibrary>(name, file_name_prefix, config_file, level);
}

}  // namespace rcl
