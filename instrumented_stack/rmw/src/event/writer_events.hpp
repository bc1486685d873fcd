// SPDX-License-Identifier: Apache-2.0
// Turns what DDS reports of a DataWriter into events of a publisher.
#pragma once

#include <atomic>
#include <cstddef>
#include <fastdds/dds/core/status/StatusMask.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <memory>

#include "event/dds_status.hpp"
#include "event/status_event.hpp"
#include "rmw/event.h"

namespace rmw_fastrtps {

// The listener of a writer, for the statuses of mask().
class WriterEvents : public eprosima::fastdds::dds::DataWriterListener {
 public:
  static eprosima::fastdds::dds::StatusMask mask() {
    using Mask = eprosima::fastdds::dds::StatusMask;
    return Mask::publication_matched() << Mask::liveliness_lost() << Mask::offered_deadline_missed()
                                       << Mask::offered_incompatible_qos();
  }

  void on_publication_matched(eprosima::fastdds::dds::DataWriter*,
                              const eprosima::fastdds::dds::PublicationMatchedStatus& info) override {
    matched_ = static_cast<std::size_t>(info.current_count);
    matched_event_.update([&info](rmw_matched_status_t& status) { add_matched(info, status); });
  }
  void on_liveliness_lost(eprosima::fastdds::dds::DataWriter*,
                          const eprosima::fastdds::dds::LivelinessLostStatus& info) override {
    liveliness_lost_.update([&info](rmw_liveliness_lost_status_t& status) { add_total(info, status); });
  }
  void on_offered_deadline_missed(eprosima::fastdds::dds::DataWriter*,
                                  const eprosima::fastdds::dds::OfferedDeadlineMissedStatus& info) override {
    deadline_missed_.update([&info](rmw_offered_deadline_missed_status_t& status) { add_total(info, status); });
  }
  void on_offered_incompatible_qos(eprosima::fastdds::dds::DataWriter*,
                                   const eprosima::fastdds::dds::OfferedIncompatibleQosStatus& info) override {
    incompatible_qos_.update(
        [&info](rmw_offered_qos_incompatible_event_status_t& status) { add_incompatible(info, status); });
  }

  // Null for a type that is not an event of publishers.
  StatusEvent* event(rmw_event_type_t type) {
    switch (type) {
      case RMW_EVENT_LIVELINESS_LOST:
        return &liveliness_lost_;
      case RMW_EVENT_OFFERED_DEADLINE_MISSED:
        return &deadline_missed_;
      case RMW_EVENT_OFFERED_QOS_INCOMPATIBLE:
        return &incompatible_qos_;
      case RMW_EVENT_PUBLICATION_MATCHED:
        return &matched_event_;
      case RMW_EVENT_PUBLISHER_INCOMPATIBLE_TYPE:
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
  StatusEventOf<rmw_liveliness_lost_status_t> liveliness_lost_;
  StatusEventOf<rmw_offered_deadline_missed_status_t> deadline_missed_;
  StatusEventOf<rmw_offered_qos_incompatible_event_status_t> incompatible_qos_;
};

}  // namespace rmw_fastrtps
