// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/session_store.hpp"

#include <fmt/core.h>
#include <lttng/lttng-error.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

#include "base/environment/home_directory.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

// The session daemon has another current directory, and may have another home directory.
std::filesystem::path absolute(const std::string& directory) {
  if (!directory.empty()) {
    return std::filesystem::absolute(directory).lexically_normal();
  }
  const char* const given = std::getenv("LTTNG_HOME");
  const std::filesystem::path home = given != nullptr && *given != '\0' ? given : launch::home_directory();
  return home / ".lttng" / "sessions";
}

}  // namespace

std::string file_of_saved_session(const std::string& name, const std::string& directory) {
  return absolute(directory) / (name + ".lttng");
}

void save_session(const std::string& name, const std::string& directory) {
  const std::string doing = fmt::format("save trace session '{}'", name);
  const LttngOwned<lttng_save_session_attr> attributes(lttng_save_session_attr_create(),
                                                       lttng_save_session_attr_destroy);
  if (!attributes) {
    throw lttng_error(LTTNG_ERR_NOMEM, doing);
  }
  check_lttng(lttng_save_session_attr_set_session_name(attributes.get(), name.c_str()), doing);
  check_lttng(lttng_save_session_attr_set_overwrite(attributes.get(), 1), doing);
  const std::filesystem::path folder = absolute(directory);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw TraceError(fmt::format("cannot {}: {}: {}", doing, folder.string(), error.message()));
  }
  check_lttng(lttng_save_session_attr_set_output_url(attributes.get(), folder.c_str()), doing);
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
  // LTTng takes a directory that is missing for one without sessions, or writes an error of its own.
  const std::string file = file_of_saved_session(name, directory);
  if (!std::filesystem::exists(file)) {
    throw TraceError(fmt::format("there is no saved session '{}': {} does not exist", name, file),
                     "`launch trace save` writes one");
  }
  check_lttng(lttng_load_session_attr_set_input_url(attributes.get(), absolute(directory).c_str()), doing);
  check_lttng(lttng_load_session(attributes.get()), doing);
}

}  // namespace tracing
