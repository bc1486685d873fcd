#include "topic_name.hpp"

namespace rmw_fastrtps {
namespace {

constexpr std::string_view kTopicPrefix = "rt";
constexpr std::string_view kTypeInfix = "dds_::";
constexpr std::string_view kScope = "::";

}  // namespace

std::string mangled_topic(std::string_view topic) {
  return std::string(kTopicPrefix).append(topic);
}

std::optional<std::string> demangled_topic(std::string_view dds_topic) {
  if (!dds_topic.starts_with(kTopicPrefix) || !dds_topic.substr(kTopicPrefix.size()).starts_with('/')) {
    return std::nullopt;
  }
  return std::string(dds_topic.substr(kTopicPrefix.size()));
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

}  // namespace rmw_fastrtps
