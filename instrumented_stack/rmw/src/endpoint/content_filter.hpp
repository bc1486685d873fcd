// SPDX-License-Identifier: Apache-2.0
// DDS topics that pass only the messages that match a filter to the reader.
#pragma once

#include <string>
#include <vector>

#include "rmw/subscription_content_filter_options.h"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"

namespace eprosima::fastdds::dds {
class ContentFilteredTopic;
class Topic;
}  // namespace eprosima::fastdds::dds

namespace rmw_fastrtps {

struct ContentFilter {
  std::string expression;  // empty: no filter
  std::vector<std::string> parameters;
};

ContentFilter to_content_filter(const rmw_subscription_content_filter_options_t* options);

// Throws std::runtime_error, naming the expression, if the expression does not fit the type.
eprosima::fastdds::dds::ContentFilteredTopic& create_filtered_topic(eprosima::fastdds::dds::Topic& topic,
                                                                    const message_type_support_callbacks_t& type,
                                                                    const ContentFilter& filter);
// No reader may use the topic any more.
void delete_filtered_topic(eprosima::fastdds::dds::ContentFilteredTopic& topic);

// Changes the filter of readers in use. Throws std::runtime_error and keeps the old filter on errors.
void change_filter(eprosima::fastdds::dds::ContentFilteredTopic& topic, const ContentFilter& filter);
ContentFilter filter_of(const eprosima::fastdds::dds::ContentFilteredTopic& topic);

}  // namespace rmw_fastrtps
