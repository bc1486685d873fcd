// SPDX-License-Identifier: Apache-2.0
// Reads domain and discovery options from the environment.
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "rcl/discovery_options.h"
#include "rcl/domain_id.h"
#include "rcl/error_handling.h"

namespace {

// Domain ids above this one would give port numbers above 65535.
constexpr unsigned long kLargestDomainId = 232;

const char* value_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr || *value == '\0' ? nullptr : value;
}

}  // namespace

rcl_ret_t rcl_get_default_domain_id(size_t* domain_id) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(domain_id, RCL_RET_INVALID_ARGUMENT);
  const char* value = value_of("ROS_DOMAIN_ID");
  if (value == nullptr) {
    return RCL_RET_OK;
  }
  char* end = nullptr;
  errno = 0;
  const unsigned long number = std::strtoul(value, &end, 0);
  if (errno != 0 || *end != '\0' || number > kLargestDomainId) {
    RCL_SET_ERROR_MSG_WITH_FORMAT_STRING("ROS_DOMAIN_ID is '%s', but must be a number from 0 to %lu", value,
                                         kLargestDomainId);
    return RCL_RET_ERROR;
  }
  *domain_id = number;
  return RCL_RET_OK;
}

rcl_ret_t rcl_get_automatic_discovery_range(rmw_discovery_options_t* discovery_options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(discovery_options, RCL_RET_INVALID_ARGUMENT);
  if (const char* only = value_of("ROS_LOCALHOST_ONLY"); only != nullptr && std::strcmp(only, "1") == 0) {
    discovery_options->automatic_discovery_range = RMW_AUTOMATIC_DISCOVERY_RANGE_LOCALHOST;
    return RCL_RET_OK;
  }
  const char* value = value_of("ROS_AUTOMATIC_DISCOVERY_RANGE");
  constexpr struct {
    std::string_view name;
    rmw_automatic_discovery_range_t range;
  } kRanges[] = {
      {"OFF", RMW_AUTOMATIC_DISCOVERY_RANGE_OFF},
      {"LOCALHOST", RMW_AUTOMATIC_DISCOVERY_RANGE_LOCALHOST},
      {"SUBNET", RMW_AUTOMATIC_DISCOVERY_RANGE_SUBNET},
      {"SYSTEM_DEFAULT", RMW_AUTOMATIC_DISCOVERY_RANGE_SYSTEM_DEFAULT},
  };
  for (const auto& known : kRanges) {
    if (known.name == (value == nullptr ? "SUBNET" : value)) {
      discovery_options->automatic_discovery_range = known.range;
      return RCL_RET_OK;
    }
  }
  RCL_SET_ERROR_MSG_WITH_FORMAT_STRING(
      "ROS_AUTOMATIC_DISCOVERY_RANGE is '%s', but must be OFF, LOCALHOST, SUBNET or SYSTEM_DEFAULT", value);
  return RCL_RET_ERROR;
}

rcl_ret_t rcl_get_discovery_static_peers(rmw_discovery_options_t* discovery_options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(discovery_options, RCL_RET_INVALID_ARGUMENT);
  const char* value = value_of("ROS_STATIC_PEERS");
  discovery_options->static_peers_count = 0;
  for (std::string_view rest = value == nullptr ? "" : value; !rest.empty();) {
    const std::string_view peer = rest.substr(0, rest.find(';'));
    rest.remove_prefix(peer.size() == rest.size() ? rest.size() : peer.size() + 1);
    if (peer.empty()) {
      continue;
    }
    if (peer.size() >= RMW_DISCOVERY_OPTIONS_STATIC_PEERS_MAX_LENGTH) {
      RCL_SET_ERROR_MSG_WITH_FORMAT_STRING("ROS_STATIC_PEERS has a name of more than %d characters",
                                           RMW_DISCOVERY_OPTIONS_STATIC_PEERS_MAX_LENGTH - 1);
      return RCL_RET_ERROR;
    }
    if (discovery_options->static_peers_count == RMW_DISCOVERY_OPTIONS_STATIC_PEERS_MAX_COUNT) {
      RCL_SET_ERROR_MSG_WITH_FORMAT_STRING("ROS_STATIC_PEERS has more than %d names",
                                           RMW_DISCOVERY_OPTIONS_STATIC_PEERS_MAX_COUNT);
      return RCL_RET_ERROR;
    }
    char* slot = discovery_options->static_peers[discovery_options->static_peers_count++];
    std::memcpy(slot, peer.data(), peer.size());
    slot[peer.size()] = '\0';
  }
  return RCL_RET_OK;
}
