// SPDX-License-Identifier: Apache-2.0
// Turns what DDS reports of readers and writers into messages and events of subscriptions and publishers. DDS counts
// changes since the last call. rmw counts changes since the user last took the status.
#pragma once

#include <atomic>
#include <cstddef>
#include <fastdds/dds/core/status/StatusMask.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <memory>

#include "event/status_event.hpp"
#include "rmw/event.h"
#include "wait/data_reader_waitable.hpp"

namespace rmw_fastrtps {

inline rmw_qos_policy_kind_t policy_kind(eprosima::fastdds::dds::QosPolicyId_t id) {
  using namespace eprosima::fastdds::dds;
  switch (id) {
    case DURABILITY_QOS_POLICY_ID:
      return RMW_QOS_POLICY_DURABILITY;
    case DEADLINE_QOS_POLICY_ID:
      return RMW_QOS_POLICY_DEADLINE;
    case LIVELINESS_QOS_POLICY_ID:
      return RMW_QOS_POLICY_LIVELINESS;
    case RELIABILITY_QOS_POLICY_ID:
      return RMW_QOS_POLICY_RELIABILITY;
    case HISTORY_QOS_POLICY_ID:
      return RMW_QOS_POLICY_HISTORY;
    case LIFESPAN_QOS_POLICY_ID:
      return RMW_QOS_POLICY_LIFESPAN;
    default:
      return RMW_QOS_POLICY_INVALID;
  }
}

// What readers and writers have alike.
class EndpointEvents {
 public:
  std::size_t matched() const { return matched_; }

  // For the graph, which knows the types of the other endpoints.
  const std::shared_ptr<StatusEventOf<rmw_incompatible_type_status_t>>& incompatible_type() const {
    return incompatible_type_;
  }

 protected:
  // Adds a status of DDS that has a total and its change.
  template <typename StatusT, typename DdsStatusT>
  static void add_total(StatusT& status, const DdsStatusT& told) {
    using CountT = decltype(status.total_count);
    status.total_count = static_cast<CountT>(told.total_count);
    status.total_count_change += static_cast<CountT>(told.total_count_change);
  }
  template <typename StatusT, typename DdsStatusT>
  static void add(StatusEventOf<StatusT>& event, const DdsStatusT& told) {
    event.update([&told](StatusT& status) { add_total(status, told); });
  }

  void add_matched(const eprosima::fastdds::dds::MatchedStatus& told) {
    matched_ = static_cast<std::size_t>(told.current_count);
    matched_event_.update([&told](rmw_matched_status_t& status) {
      add_total(status, told);
      status.current_count = static_cast<std::size_t>(told.current_count);
      status.current_count_change += told.current_count_change;
    });
  }
  void add_incompatible_qos(const eprosima::fastdds::dds::IncompatibleQosStatus& told) {
    incompatible_qos_.update([&told](rmw_qos_incompatible_event_status_t& status) {
      add_total(status, told);
      status.last_policy_kind = policy_kind(told.last_policy_id);
    });
  }

  std::atomic<std::size_t> matched_{0};
  std::shared_ptr<StatusEventOf<rmw_incompatible_type_status_t>> incompatible_type_ =
      std::make_shared<StatusEventOf<rmw_incompatible_type_status_t>>();
  StatusEventOf<rmw_matched_status_t> matched_event_;
  StatusEventOf<rmw_offered_deadline_missed_status_t> deadline_missed_;  // requested, for a reader
  StatusEventOf<rmw_qos_incompatible_event_status_t> incompatible_qos_{
      rmw_qos_incompatible_event_status_t{0, 0, RMW_QOS_POLICY_INVALID}};
};

// The listener of a reader, for the statuses of mask().
class ReaderEvents : public DataReaderWaitable, public EndpointEvents {
 public:
  static eprosima::fastdds::dds::StatusMask mask() {
    using Mask = eprosima::fastdds::dds::StatusMask;
    return Mask::data_available() << Mask::subscription_matched() << Mask::liveliness_changed()
                                  << Mask::requested_deadline_missed() << Mask::requested_incompatible_qos()
                                  << Mask::sample_lost();
  }

  void on_subscription_matched(eprosima::fastdds::dds::DataReader*,
                               const eprosima::fastdds::dds::SubscriptionMatchedStatus& info) override {
    add_matched(info);
  }
  void on_liveliness_changed(eprosima::fastdds::dds::DataReader*,
                             const eprosima::fastdds::dds::LivelinessChangedStatus& info) override {
    liveliness_changed_.update([&info](rmw_liveliness_changed_status_t& status) {
      status.alive_count = info.alive_count;
      status.not_alive_count = info.not_alive_count;
      status.alive_count_change += info.alive_count_change;
      status.not_alive_count_change += info.not_alive_count_change;
    });
  }
  void on_requested_deadline_missed(eprosima::fastdds::dds::DataReader*,
                                    const eprosima::fastdds::dds::RequestedDeadlineMissedStatus& info) override {
    add(deadline_missed_, info);
  }
  void on_requested_incompatible_qos(eprosima::fastdds::dds::DataReader*,
                                     const eprosima::fastdds::dds::RequestedIncompatibleQosStatus& info) override {
    add_incompatible_qos(info);
  }
  void on_sample_lost(eprosima::fastdds::dds::DataReader*,
                      const eprosima::fastdds::dds::SampleLostStatus& info) override {
    add(message_lost_, info);
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

 private:
  StatusEventOf<rmw_liveliness_changed_status_t> liveliness_changed_;
  StatusEventOf<rmw_message_lost_status_t> message_lost_;
};

// The listener of a writer, for the statuses of mask().
class WriterEvents : public eprosima::fastdds::dds::DataWriterListener, public EndpointEvents {
 public:
  static eprosima::fastdds::dds::StatusMask mask() {
    using Mask = eprosima::fastdds::dds::StatusMask;
    return Mask::publication_matched() << Mask::liveliness_lost() << Mask::offered_deadline_missed()
                                       << Mask::offered_incompatible_qos();
  }

  void on_publication_matched(eprosima::fastdds::dds::DataWriter*,
                              const eprosima::fastdds::dds::PublicationMatchedStatus& info) override {
    add_matched(info);
  }
  void on_liveliness_lost(eprosima::fastdds::dds::DataWriter*,
                          const eprosima::fastdds::dds::LivelinessLostStatus& info) override {
    add(liveliness_lost_, info);
  }
  void on_offered_deadline_missed(eprosima::fastdds::dds::DataWriter*,
                                  const eprosima::fastdds::dds::OfferedDeadlineMissedStatus& info) override {
    add(deadline_missed_, info);
  }
  void on_offered_incompatible_qos(eprosima::fastdds::dds::DataWriter*,
                                   const eprosima::fastdds::dds::OfferedIncompatibleQosStatus& info) override {
    add_incompatible_qos(info);
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

 private:
  StatusEventOf<rmw_liveliness_lost_status_t> liveliness_lost_;
};

}  // namespace rmw_fastrtps
