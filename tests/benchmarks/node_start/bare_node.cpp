// SPDX-License-Identifier: Apache-2.0
// The floor: a participant of Fast DDS with one writer and one reader, which waits in a wait set as a node does.
#include <signal.h>

#include <fastdds/dds/core/condition/GuardCondition.hpp>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>

#include "ready_node.hpp"
#include "tests/benchmarks/latency/bare_dds.hpp"

namespace {

namespace fdds = eprosima::fastdds::dds;

}  // namespace

int main() {
  const std::int64_t begun = node_start::now(CLOCK_MONOTONIC);
  sigset_t end;
  sigemptyset(&end);
  sigaddset(&end, SIGINT);
  sigprocmask(SIG_BLOCK, &end, nullptr);
  fdds::DomainParticipant* const participant = latency::create_participant();
  fdds::TypeSupport type(new latency::MessageType(latency::kSizes.front()));
  type.register_type(participant);
  fdds::Topic* const topic =
      participant->create_topic("rt/topic", type.get_type_name(), participant->get_default_topic_qos());
  fdds::Publisher* const publisher = participant->create_publisher(participant->get_default_publisher_qos());
  publisher->create_datawriter(topic, latency::like_rmw(publisher->get_default_datawriter_qos()));
  fdds::Subscriber* const subscriber = participant->create_subscriber(participant->get_default_subscriber_qos());
  subscriber->create_datareader(topic, latency::like_rmw(subscriber->get_default_datareader_qos()));
  fdds::GuardCondition condition;
  fdds::WaitSet wait_set;
  wait_set.attach_condition(condition);
  fdds::ConditionSeq active;
  wait_set.wait(active, {0, 0});
  node_start::tell_ready(begun);
  int signal = 0;
  sigwait(&end, &signal);
  wait_set.detach_condition(condition);
  participant->delete_contained_entities();
  fdds::DomainParticipantFactory::get_instance()->delete_participant(participant);
}
