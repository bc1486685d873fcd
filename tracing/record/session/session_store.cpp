// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/session_store.hpp"

#include <fmt/core.h>
#include <lttng/lttng-error.h>

#include <filesystem>
#include <memory>

#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

// The session daemon has another current directory.
std::string absolute(const std::string& directory) {
  return std::filesystem::absolute(directory).lexically_normal().string();
}

}  // namespace

void save_session(const std::string& name, const std::string& directory) {
  const std::string doing = fmt::format("save trace session '{}'", name);
  const LttngOwned<lttng_save_session_attr> attributes(lttng_save_session_attr_create(),
                                                       lttng_save_session_attr_destroy);
  if (!attributes) {
    throw lttng_error(LTTNG_ERR_NOMEM, doing);
  }
  check_lttng(lttng_save_session_attr_set_session_name(attributes.get(), name.c_str()), doing);
  check_lttng(lttng_save_session_attr_set_overwrite(attributes.get(), 1), doing);
  if (!directory.empty()) {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error) {
      throw TraceError(fmt::format("cannot {}: {}: {}", doing, directory, error.message()));
    }
    check_lttng(lttng_save_session_attr_set_output_url(attributes.get(), absolute(directory).c_str()), doing);
  }
  check_lttng(lttng_save_session(attributes.get()), doing);
}

void load_session(const std::string& name, const std::string& directory) {
  const std::string doing = fmt::format("load trace session '{}'", name);
  const LttngOwned<lttng_load_session_attr> attributes(lttng_load_session_attr_create(),
                                                       lttng_load_session_attr_destroy);
  if (!attributes) {
    throw lttng_error(LTTNG_ERR_NOMEM, doing);
  }
  check_lttng(lttng_load_session_attr_set_session_name(attributes.get(), name.c_str()), doing);
  if (!directory.empty()) {
    check_lttng(lttng_load_session_attr_set_input_url(attributes.get(), absolute(directory).c_str()), doing);
  }
  const int result = lttng_load_session(attributes.get());
  if (result == -LTTNG_ERR_LOAD_SESSION_NOENT) {
    throw TraceError(fmt::format("there is no saved session '{}'", name), "`launch trace save` writes one");
  }
  check_lttng(result, doing);
}

}  // namespace tracing
