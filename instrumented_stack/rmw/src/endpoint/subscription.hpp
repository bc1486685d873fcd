// SPDX-License-Identifier: Apache-2.0
// The parts of a subscription, for the files that implement it.
#pragma once

#include <fastdds/dds/core/LoanableSequence.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <string>

#include "endpoint/endpoint.hpp"
#include "event/endpoint_events.hpp"
#include "faults/take_faults.hpp"
#include "rmw/types.h"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"

namespace eprosima::fastdds::dds {
class ContentFilteredTopic;
class Topic;
}  // namespace eprosima::fastdds::dds

namespace rmw_fastrtps {

// A sample that stays in the reader until it is returned.
struct Loan {
  eprosima::fastdds::dds::LoanableSequence<unsigned char> samples;  // works for any type: it gets pointers, no elements
  eprosima::fastdds::dds::SampleInfoSeq infos;
};

struct Subscription final : ReaderEvents {
  void on_subscription_matched(eprosima::fastdds::dds::DataReader* of_reader,
                               const eprosima::fastdds::dds::SubscriptionMatchedStatus& info) override;

  [[gnu::hot]] bool is_ready() override {
    if (const auto known = is_known_to_be_ready()) {
      return *known;
    }
    const std::shared_lock lock(reader_mutex);
    return ReaderEvents::is_ready() || stays_ready(faults != nullptr && faults->has_message());
  }

  rmw_subscription_t handle{};
  std::string topic_name;  // the handle points to it
  Participant* participant = nullptr;
  const rmw_node_t* node = nullptr;  // null for the context's own subscription
  const message_type_support_callbacks_t* type = nullptr;
  eprosima::fastdds::dds::Topic* topic = nullptr;
  eprosima::fastdds::dds::ContentFilteredTopic* filtered_topic = nullptr;  // null: there is no filter
  eprosima::fastdds::dds::DataReaderQos reader_qos;
  EndpointIdentity identity{};

  std::unique_ptr<TakeFaults<rmw_message_info_t>> faults;  // of a test; null: none

  // Held shared by all users of the reader, because a filter that is added or removed creates a new reader.
  std::shared_mutex reader_mutex;

  std::mutex loans_mutex;
  std::map<const void*, std::unique_ptr<Loan>> loans;
};

// rmw_wait() takes `data` as a Waitable.
inline Subscription& subscription_of(const rmw_subscription_t& handle) {
  return *static_cast<Subscription*>(static_cast<Waitable*>(handle.data));
}

// Creates the reader on the topic, or on the filtered topic, and its identity for the graph. Throws std::runtime_error.
void create_reader(Subscription& subscription);

// Fires ros2_ext:rmw_subscription_qos. To be called when the subscription has its reader, and again for another reader.
void trace_qos(const Subscription& subscription);

}  // namespace rmw_fastrtps
