// SPDX-License-Identifier: Apache-2.0
// Turns what DDS reports of a DataReader into messages and events of a subscription.
#pragma once

#include <atomic>
#include <cstddef>
#include <fastdds/dds/core/status/StatusMask.hpp>
#include <memory>

#include "event/dds_status.hpp"
#include "event/status_event.hpp"
#include "rmw/event.h"
#include "wait/data_reader_waitable.hpp"

namespace rmw_fastrtps {

// The listener of a reader, for the statuses of mask().
class ReaderEvents : public DataReaderWaitable {
 public:
  static eprosima::fastdds::dds::StatusMask mask() {
    using Mask = eprosima::fastdds::dds::StatusMask;
    return Mask::data_available() << Mask::subscription_matched() << Mask::liveliness_changed()
                                  << Mask::requested_deadline_missed() << Mask::requested_incompatible_qos()
                                  << Mask::sample_lost();
  }

  void on_subscription_matched(eprosima::fastdds::dds::DataReader*,
                               const eprosima::fastdds::dds::SubscriptionMatchedStatus& info) override {
    matched_ = static_cast<std::size_t>(info.current_count);
    matched_event_.update([&info](rmw_matched_status_t& status) { add_matched(info, status); });
  }
  void on_liveliness_changed(eprosima::fastdds::dds::DataReader*,
                             const eprosima::fastrtps::LivelinessChangedStatus& info) override {
    liveliness_changed_.update([&info](rmw_liveliness_changed_status_t& status) {
      status.alive_count = info.alive_count;
      status.not_alive_count = info.not_alive_count;
      status.alive_count_change += info.alive_count_change;
      status.not_alive_count_change += info.not_alive_count_change;
    });
  }
  void on_requested_deadline_missed(eprosima::fastdds::dds::DataReader*,
                                    const eprosima::fastrtps::RequestedDeadlineMissedStatus& info) override {
    deadline_missed_.update([&info](rmw_requested_deadline_missed_status_t& status) { add_total(info, status); });
  }
  void on_requested_incompatible_qos(eprosima::fastdds::dds::DataReader*,
                                     const eprosima::fastdds::dds::RequestedIncompatibleQosStatus& info) override {
    incompatible_qos_.update(
        [&info](rmw_requested_qos_incompatible_event_status_t& status) { add_incompatible(info, status); });
  }
  void on_sample_lost(eprosima::fastdds::dds::DataReader*,
                      const eprosima::fastdds::dds::SampleLostStatus& info) override {
    message_lost_.update([&info](rmw_message_lost_status_t& status) { add_total(info, status); });
  }

  // Null for a type that is not an event of subscriptions.
  StatusEvent* event(rmw_event_type_t type) {
    switch (type) {
      case RMW_EVENT_LIVELINESS_CHANGED:
        return &liveliness_changed_;
      case RMW_EVENT_REQUESTED_DEADLINE_MISSED:
        return &deadline_missed_;
      case RMW_EVENT_REQUESTED_QOS_INCOMPATIBLE:
        return &incompatible_qos_;
      case RMW_EVENT_MESSAGE_LOST:
        return &message_lost_;
      case RMW_EVENT_SUBSCRIPTION_MATCHED:
        return &matched_event_;
      case RMW_EVENT_SUBSCRIPTION_INCOMPATIBLE_TYPE:
        return incompatible_type_.get();
      default:
        return nullptr;
    }
  }

  std::size_t matched() const { return matched_; }

  // For the graph, which knows the types of the other endpoints.
  const std::shared_ptr<StatusEventOf<rmw_incompatible_type_status_t>>& incompatible_type() const {
    return incompatible_type_;
  }

 private:
  std::atomic<std::size_t> matched_{0};
  std::shared_ptr<StatusEventOf<rmw_incompatible_type_status_t>> incompatible_type_ =
      std::make_shared<StatusEventOf<rmw_incompatible_type_status_t>>();
  StatusEventOf<rmw_matched_status_t> matched_event_;
  StatusEventOf<rmw_liveliness_changed_status_t> liveliness_changed_;
  StatusEventOf<rmw_requested_deadline_missed_status_t> deadline_missed_;
  StatusEventOf<rmw_requested_qos_incompatible_event_status_t> incompatible_qos_;
  StatusEventOf<rmw_message_lost_status_t> message_lost_;
};

}  // namespace rmw_fastrtps
