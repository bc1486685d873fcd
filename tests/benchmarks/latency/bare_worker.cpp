// SPDX-License-Identifier: Apache-2.0
// The floor: the same exchange on Fast DDS alone, with the quality of service that the stack's rmw asks for.
//   latency_bare publisher|wait_set|listener
// The subscriber `wait_set` has the threads of the stack: one waits in a wait set, and the one that receives wakes it.
// The subscriber `listener` works in the thread that receives, which is the least that Fast DDS can do.
#include <cstdlib>
#include <fastdds/dds/core/condition/GuardCondition.hpp>
#include <fastdds/dds/core/condition/StatusCondition.hpp>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <memory>
#include <string_view>
#include <vector>

#include "bare_dds.hpp"
#include "worker.hpp"

namespace {

namespace fdds = eprosima::fastdds::dds;

using latency::like_rmw;
using latency::Matches;
using latency::Message;
using latency::MessageType;
using Topics = std::vector<fdds::Topic*>;

constexpr int kTopics = latency::kSizes.size();

class WriterListener final : public fdds::DataWriterListener {
 public:
  void on_publication_matched(fdds::DataWriter*, const fdds::PublicationMatchedStatus& info) override {
    matches.add(info.current_count_change);
  }

  Matches matches{kTopics};
};

class Receiver final : public fdds::DataReaderListener {
 public:
  void on_subscription_matched(fdds::DataReader*, const fdds::SubscriptionMatchedStatus& info) override {
    matches.add(info.current_count_change);
  }
  void on_data_available(fdds::DataReader* reader) override { take_all(*reader); }
  void take_all(fdds::DataReader& reader) {
    fdds::SampleInfo info;
    while (reader.take_next_sample(message_.get(), &info) == rmw_fastrtps::return_code::kOk) {
      if (info.valid_data) {
        log_.received(message_->sent, message_->remaining);
      }
    }
  }

  Matches matches{kTopics};

 private:
  std::unique_ptr<Message> message_ = std::make_unique<Message>();
  latency::LatencyLog log_;
};

void publish(fdds::DomainParticipant& participant, const Topics& topics) {
  WriterListener listener;
  fdds::Publisher* publisher = participant.create_publisher(participant.get_default_publisher_qos());
  fdds::DataWriterQos qos = like_rmw(publisher->get_default_datawriter_qos());
  qos.publish_mode().kind = fdds::SYNCHRONOUS_PUBLISH_MODE;
  std::vector<fdds::DataWriter*> writers;
  for (fdds::Topic* topic : topics) {
    writers.push_back(publisher->create_datawriter(topic, qos, &listener, fdds::StatusMask::publication_matched()));
  }
  listener.matches.wait_for_all();
  latency::tell_ready();
  const auto message = std::make_unique<Message>();
  latency::publish_batches([&](std::size_t size_index, std::int64_t remaining) {
    message->remaining = remaining;
    message->sent = latency::monotonic_now();
    writers[size_index]->write(message.get());
  });
}

[[noreturn]] void subscribe(fdds::DomainParticipant& participant, const Topics& topics, bool in_listener) {
  Receiver receiver;
  fdds::Subscriber* subscriber = participant.create_subscriber(participant.get_default_subscriber_qos());
  fdds::WaitSet wait_set;
  for (fdds::Topic* topic : topics) {
    fdds::StatusMask to_listener = fdds::StatusMask::subscription_matched();
    if (in_listener) {
      to_listener << fdds::StatusMask::data_available();
    }
    fdds::DataReader* reader = subscriber->create_datareader(topic, like_rmw(subscriber->get_default_datareader_qos()),
                                                             &receiver, to_listener);
    reader->get_statuscondition().set_enabled_statuses(fdds::StatusMask::data_available());
    if (!in_listener) {
      wait_set.attach_condition(reader->get_statuscondition());
    }
  }
  receiver.matches.wait_for_all();
  latency::tell_ready();
  // Without a reader in the wait set, `never` keeps the thread asleep.
  fdds::GuardCondition never;
  wait_set.attach_condition(never);
  fdds::ConditionSeq ready;
  while (true) {
    wait_set.wait(ready, rmw_fastrtps::kInfiniteDuration);
    for (fdds::Condition* condition : ready) {
      if (auto* status = dynamic_cast<fdds::StatusCondition*>(condition)) {
        receiver.take_all(*static_cast<fdds::DataReader*>(status->get_entity()));
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view role = argc == 2 ? argv[1] : "";
  auto* participant = latency::create_participant();
  Topics topics;
  for (std::size_t i = 0; i < latency::kSizes.size(); ++i) {
    fdds::TypeSupport type(new MessageType(latency::kSizes[i]));
    type.register_type(participant);
    topics.push_back(participant->create_topic("rt" + latency::topic_of(i), type.get_type_name(),
                                               participant->get_default_topic_qos()));
  }
  if (role == "publisher") {
    publish(*participant, topics);
  } else {
    subscribe(*participant, topics, role == "listener");
  }
  // The benchmark ends both programs, so there is nothing left to clean up.
  std::_Exit(EXIT_SUCCESS);
}
