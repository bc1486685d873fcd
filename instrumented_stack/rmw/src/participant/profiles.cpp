// SPDX-License-Identifier: Apache-2.0
#include "participant/profiles.hpp"

#include <unistd.h>

#include <cstdlib>

#include "rcutils/logging.h"

namespace rmw_fastrtps {

namespace {

// Null: the variable names no file.
const char* file_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

void expect(bool is_read, const char* variable) {
  if (!is_read) {
    rcutils_log(nullptr, RCUTILS_LOG_SEVERITY_ERROR, "rmw_fastrtps",
                "%s is '%s', whose profiles cannot be read; they have no effect", variable, file_of(variable));
  }
}

}  // namespace

void load_profiles(fdds::DomainParticipantFactory& factory) {
  const char* const names[] = {"FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE"};
  const char* const of_fast_dds = names[RMW_FASTDDS_MAJOR >= 3 ? 1 : 0];
  const char* const other = names[RMW_FASTDDS_MAJOR >= 3 ? 0 : 1];
  if (file_of(of_fast_dds) != nullptr) {
    expect(access(file_of(of_fast_dds), R_OK) == 0, of_fast_dds);  // some releases of Fast DDS do not name the file
  } else if (file_of(other) != nullptr) {
    expect(factory.load_XML_profiles_file(file_of(other)) == return_code::kOk, other);
  }
  factory.load_profiles();
}

}  // namespace rmw_fastrtps
