// SPDX-License-Identifier: Apache-2.0
#include "names/topic_name.hpp"

namespace rmw_fastrtps {
namespace {

constexpr std::string_view kTopicPrefix = "rt";
constexpr std::string_view kRequestPrefix = "rq";
constexpr std::string_view kRequestSuffix = "Request";
constexpr std::string_view kResponsePrefix = "rr";
constexpr std::string_view kResponseSuffix = "Reply";
constexpr std::string_view kTypeInfix = "dds_::";
constexpr std::string_view kScope = "::";

// The ROS name between prefix and suffix.
std::optional<std::string> between(std::string_view dds_topic, std::string_view prefix, std::string_view suffix) {
  if (!dds_topic.starts_with(prefix) || !dds_topic.substr(prefix.size()).starts_with('/') ||
      !dds_topic.ends_with(suffix)) {
    return std::nullopt;
  }
  dds_topic.remove_prefix(prefix.size());
  dds_topic.remove_suffix(suffix.size());
  return std::string(dds_topic);
}

}  // namespace

std::string mangled_topic(std::string_view topic) {
  return std::string(kTopicPrefix).append(topic);
}

std::optional<std::string> demangled_topic(std::string_view dds_topic) {
  return between(dds_topic, kTopicPrefix, "");
}

std::string mangled_request_topic(std::string_view service) {
  return std::string(kRequestPrefix).append(service).append(kRequestSuffix);
}

std::string mangled_response_topic(std::string_view service) {
  return std::string(kResponsePrefix).append(service).append(kResponseSuffix);
}

std::optional<std::string> demangled_service(std::string_view dds_topic) {
  if (auto service = between(dds_topic, kRequestPrefix, kRequestSuffix)) {
    return service;
  }
  return between(dds_topic, kResponsePrefix, kResponseSuffix);
}

std::string demangled_type(std::string_view dds_type) {
  const std::size_t infix = dds_type.find(kTypeInfix);
  if (infix == std::string_view::npos || !dds_type.ends_with('_')) {
    return std::string(dds_type);
  }
  std::string_view name = dds_type.substr(infix + kTypeInfix.size());
  name.remove_suffix(1);
  std::string result;
  for (std::string_view rest = dds_type.substr(0, infix); !rest.empty();) {
    const std::size_t end = rest.find(kScope);
    result.append(rest.substr(0, end)).append("/");
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + kScope.size());
  }
  return result.append(name);
}

std::string demangled_service_type(std::string_view dds_type) {
  std::string type = demangled_type(dds_type);
  for (const std::string_view suffix : {"_Request", "_Response"}) {
    if (type.ends_with(suffix)) {
      type.resize(type.size() - suffix.size());
      break;
    }
  }
  return type;
}

}  // namespace rmw_fastrtps
