// SPDX-License-Identifier: Apache-2.0
// The floor of start-up and discovery: the roles of stack_discovery_worker.cpp on Fast DDS alone.
//   latency_bare_discovery listener|first|one_of N
#include <cstdint>
#include <cstdlib>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <memory>
#include <string_view>

#include "bare_dds.hpp"
#include "worker.hpp"

namespace {

namespace fdds = eprosima::fastdds::dds;

class Listener final : public fdds::DataWriterListener, public fdds::DataReaderListener {
 public:
  explicit Listener(int wanted) : matches(wanted) {}
  void on_publication_matched(fdds::DataWriter*, const fdds::PublicationMatchedStatus& info) override {
    matches.add(info.current_count_change);
  }
  void on_subscription_matched(fdds::DataReader*, const fdds::SubscriptionMatchedStatus& info) override {
    matches.add(info.current_count_change);
  }
  void on_data_available(fdds::DataReader* reader) override {
    fdds::SampleInfo info;
    while (reader->take_next_sample(message_.get(), &info) == rmw_fastrtps::return_code::kOk) {
      if (info.valid_data) {
        latency::tell({message_->sent, message_->remaining, latency::monotonic_now()});
      }
    }
  }

  latency::Matches matches;

 private:
  std::unique_ptr<latency::Message> message_ = std::make_unique<latency::Message>();
};

// One participant with one topic.
class Participant {
 public:
  explicit Participant(const char* topic) : participant_(*latency::create_participant()) {
    fdds::TypeSupport type(new latency::MessageType(latency::kSizes.front()));
    type.register_type(&participant_);
    topic_ = participant_.create_topic(topic, type.get_type_name(), participant_.get_default_topic_qos());
  }

  fdds::DataWriter* create_writer(Listener& listener, fdds::DurabilityQosPolicyKind durability) {
    fdds::Publisher* const publisher = participant_.create_publisher(participant_.get_default_publisher_qos());
    fdds::DataWriterQos qos = latency::like_rmw(publisher->get_default_datawriter_qos());
    qos.publish_mode().kind = fdds::SYNCHRONOUS_PUBLISH_MODE;
    qos.durability().kind = durability;
    return publisher->create_datawriter(topic_, qos, &listener, fdds::StatusMask::publication_matched());
  }
  void create_reader(Listener& listener, fdds::DurabilityQosPolicyKind durability) {
    fdds::Subscriber* const subscriber = participant_.create_subscriber(participant_.get_default_subscriber_qos());
    fdds::DataReaderQos qos = latency::like_rmw(subscriber->get_default_datareader_qos());
    qos.durability().kind = durability;
    subscriber->create_datareader(topic_, qos, &listener,
                                  fdds::StatusMask::subscription_matched() << fdds::StatusMask::data_available());
  }

 private:
  fdds::DomainParticipant& participant_;
  fdds::Topic* topic_ = nullptr;
};

void listen() {
  Listener listener(0);
  Participant participant("rt/first");
  participant.create_reader(listener, fdds::TRANSIENT_LOCAL_DURABILITY_QOS);
  latency::tell_ready();
  latency::wait_for_end();
}

void publish_first(std::int64_t main_begun) {
  Listener listener(0);
  Participant participant("rt/first");
  fdds::DataWriter* const writer = participant.create_writer(listener, fdds::TRANSIENT_LOCAL_DURABILITY_QOS);
  latency::Message message{};
  message.sent = main_begun;
  message.remaining = latency::monotonic_now();
  writer->write(&message);
  latency::wait_for_end();
}

void find_all(int participants) {
  Listener listener(2 * participants);
  Participant participant("rt/all");
  participant.create_writer(listener, fdds::VOLATILE_DURABILITY_QOS);
  participant.create_reader(listener, fdds::VOLATILE_DURABILITY_QOS);
  listener.matches.wait_for_all();
  latency::tell({latency::monotonic_now()});
  latency::wait_for_end();
}

}  // namespace

int main(int argc, char** argv) {
  const std::int64_t begun = latency::monotonic_now();
  const std::string_view role = argc >= 2 ? argv[1] : "";
  if (role == "listener") {
    listen();
  } else if (role == "first") {
    publish_first(begun);
  } else if (argc == 3) {
    find_all(std::atoi(argv[2]));
  }
  // The listeners must outlive the participant, and nothing needs to be told to others.
  std::_Exit(EXIT_SUCCESS);
}
