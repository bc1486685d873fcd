// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/lttng_ctl.hpp"

#include <dlfcn.h>
#include <fmt/core.h>

#include "tracing/record/plan/trace_error.hpp"

namespace tracing {

void* lttng_address(const char* name) {
  static void* const library = ::dlopen("liblttng-ctl.so.0", RTLD_NOW | RTLD_LOCAL);
  void* const address = library == nullptr ? nullptr : ::dlsym(library, name);
  if (address == nullptr) {
    throw TraceError(fmt::format("cannot use LTTng's control library: {}", ::dlerror()), "install lttng-tools");
  }
  return address;
}

std::unique_lock<std::mutex> lttng_lock() {
  static std::mutex mutex;
  return std::unique_lock(mutex);
}

lttng_endpoint* lttng_notification_endpoint() {
  return *static_cast<lttng_endpoint**>(lttng_address("lttng_session_daemon_notification_endpoint"));
}

}  // namespace tracing
