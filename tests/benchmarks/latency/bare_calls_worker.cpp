// SPDX-License-Identifier: Apache-2.0
// The floor of services: a request and its reply as messages of two topics on Fast DDS alone. Both sides wait in a wait
// set, as the executors of a client and a server do.
//   latency_bare_calls server|client
#include <cstdint>
#include <fastdds/dds/core/condition/StatusCondition.hpp>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "bare_dds.hpp"
#include "worker.hpp"

namespace {

namespace fdds = eprosima::fastdds::dds;

constexpr std::size_t kBytes = 3 * sizeof(std::int64_t);

// A writer of one topic and a reader of the other.
class Side : fdds::DataWriterListener, fdds::DataReaderListener {
 public:
  Side(const std::string& written, const std::string& read) {
    fdds::DomainParticipant& participant = *latency::create_participant();
    type_.register_type(&participant);
    fdds::Publisher* const publisher = participant.create_publisher(participant.get_default_publisher_qos());
    fdds::DataWriterQos writer_qos = latency::like_rmw(publisher->get_default_datawriter_qos());
    writer_qos.publish_mode().kind = fdds::SYNCHRONOUS_PUBLISH_MODE;
    writer_ = publisher->create_datawriter(topic(participant, written), writer_qos, this,
                                           fdds::StatusMask::publication_matched());
    fdds::Subscriber* const subscriber = participant.create_subscriber(participant.get_default_subscriber_qos());
    reader_ = subscriber->create_datareader(topic(participant, read),
                                            latency::like_rmw(subscriber->get_default_datareader_qos()), this,
                                            fdds::StatusMask::subscription_matched());
    reader_->get_statuscondition().set_enabled_statuses(fdds::StatusMask::data_available());
    wait_set_.attach_condition(reader_->get_statuscondition());
    matches_.wait_for_all();
    latency::tell_ready();
  }

  void write() { writer_->write(message_.get()); }
  // Returns when there was at least one message.
  void take() {
    fdds::ConditionSeq ready;
    fdds::SampleInfo info;
    bool taken = false;
    while (!taken) {
      wait_set_.wait(ready, rmw_fastrtps::kInfiniteDuration);
      while (reader_->take_next_sample(message_.get(), &info) == rmw_fastrtps::return_code::kOk) {
        taken = taken || info.valid_data;
      }
    }
  }

 private:
  fdds::Topic* topic(fdds::DomainParticipant& participant, const std::string& name) const {
    return participant.create_topic(name, type_.get_type_name(), participant.get_default_topic_qos());
  }
  void on_publication_matched(fdds::DataWriter*, const fdds::PublicationMatchedStatus& info) override {
    matches_.add(info.current_count_change);
  }
  void on_subscription_matched(fdds::DataReader*, const fdds::SubscriptionMatchedStatus& info) override {
    matches_.add(info.current_count_change);
  }

  fdds::TypeSupport type_{new latency::MessageType(kBytes)};
  latency::Matches matches_{2};
  fdds::WaitSet wait_set_;
  fdds::DataWriter* writer_ = nullptr;
  fdds::DataReader* reader_ = nullptr;
  std::unique_ptr<latency::Message> message_ = std::make_unique<latency::Message>();
};

[[noreturn]] void answer() {
  Side side("rr/call", "rq/call");
  while (true) {
    side.take();
    side.write();
  }
}

void call() {
  Side side("rq/call", "rr/call");
  latency::LatencyLog log;
  latency::publish_batches([&](std::size_t, std::int64_t remaining) {
    const std::int64_t sent = latency::monotonic_now();
    side.write();
    side.take();
    log.received(sent, remaining);
  });
  std::_Exit(EXIT_SUCCESS);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view role = argc == 2 ? argv[1] : "";
  if (role == "server") {
    answer();
  } else {
    call();
  }
}
