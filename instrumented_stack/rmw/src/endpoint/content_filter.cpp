// SPDX-License-Identifier: Apache-2.0
#include "endpoint/content_filter.hpp"

#include <atomic>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/topic/ContentFilteredTopic.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <stdexcept>

#include "fastdds_versions/names.hpp"
#include "fastdds_versions/type_object.hpp"
#include "process/end_of_process.hpp"

namespace fdds = eprosima::fastdds::dds;

namespace rmw_fastrtps {

namespace {

std::runtime_error invalid(const ContentFilter& filter, const std::string& type_name) {
  return std::runtime_error("the content filter '" + filter.expression + "' with " +
                            std::to_string(filter.parameters.size()) +
                            " parameters is not valid for messages of type '" + type_name + "'");
}

}  // namespace

ContentFilter to_content_filter(const rmw_subscription_content_filter_options_t* options) {
  ContentFilter filter;
  if (options != nullptr && options->filter_expression != nullptr) {
    filter.expression = options->filter_expression;
    const rcutils_string_array_t& parameters = options->expression_parameters;
    filter.parameters.assign(parameters.data, parameters.data + parameters.size);
  }
  return filter;
}

fdds::ContentFilteredTopic& create_filtered_topic(fdds::Topic& topic, const message_type_support_callbacks_t& type,
                                                  const ContentFilter& filter) {
  if (type.description_ == nullptr) {
    throw std::runtime_error("messages of type '" + topic.get_type_name() +
                             "' cannot be filtered by content: the members of the type are not known");
  }
  register_type_object(*type.description_);
  // The name is only known within the participant.
  static std::atomic<std::uint64_t> count{0};
  const std::string name = topic.get_name() + "_filtered_" + std::to_string(++count);
  auto* filtered =
      topic.get_participant()->create_contentfilteredtopic(name, &topic, filter.expression, filter.parameters);
  if (filtered == nullptr) {
    throw invalid(filter, topic.get_type_name());
  }
  return *filtered;
}

void delete_filtered_topic(fdds::ContentFilteredTopic& topic) {
  if (!process_ends()) {
    topic.get_participant()->delete_contentfilteredtopic(&topic);
  }
}

void change_filter(fdds::ContentFilteredTopic& topic, const ContentFilter& filter) {
  if (topic.set_filter_expression(filter.expression, filter.parameters) != rmw_fastrtps::return_code::kOk) {
    throw invalid(filter, topic.get_type_name());
  }
}

ContentFilter filter_of(const fdds::ContentFilteredTopic& topic) {
  ContentFilter filter;
  filter.expression = topic.get_filter_expression();
  topic.get_expression_parameters(filter.parameters);
  return filter;
}

}  // namespace rmw_fastrtps
