// SPDX-License-Identifier: Apache-2.0
#include "tests/support/trace_writer/ping_pong_sequence.hpp"

namespace tracing::testing {

namespace {

// clang-format off
enum : ros2::Handle {
  kC1 = 0x100, kN1, kRmwN1, kS1, kRmwS1, kP1, kRmwP1, kT1, kO1, kCallbackA, kCallbackT, kDiscovery1,
  kC2 = 0x200, kN2, kRmwN2, kS2, kRmwS2, kP2, kRmwP2, kO2, kCallbackB, kDiscovery2,
  kM1 = 0x300, kM2, kM3, kM4,
};
// clang-format on

constexpr std::int64_t us(double microseconds) {
  return kPingPongBegin + static_cast<std::int64_t>(microseconds * 1000);
}

constexpr std::int64_t kPingSent = kPingPongBegin + 506'920'000;
constexpr std::int64_t kPongSent = kPingPongBegin + 507'105'000;

}  // namespace

std::vector<SequenceEvent> ping_pong_sequence() {
  using namespace ros2;
  return {
      {us(0), kPing, RclInit{kC1, "8.10.1"}},
      {us(900), kPing, RmwPublisherInit{kDiscovery1, {}}},
      {us(910), kPing, RmwPublish{kDiscovery1, kM4, kPingPongBegin + 1}},
      {us(1200), kPing, RclNodeInit{kN1, kRmwN1, "ping", "/"}},
      {us(6000), kPing, RmwSubscriptionInit{kRmwS1, {}}},
      {us(6100), kPing, RclSubscriptionInit{kS1, kN1, kRmwS1, "/pong", 10}},
      {us(6110), kPing, RclcppSubscriptionInit{kS1, kO1}},
      {us(6120), kPing, RclcppSubscriptionCallbackAdded{kO1, kCallbackA}},
      {us(6130), kPing,
       RclcppCallbackRegister{
           kCallbackA,
           "std::_Bind<void (Ping::*(Ping*, "
           "std::_Placeholder<1>))(std::shared_ptr<std_msgs::msg::String_<std::allocator<void> > >)>"}},
      {us(6500), kPing, RmwPublisherInit{kRmwP1, {}}},
      {us(6600), kPing, RclPublisherInit{kP1, kN1, kRmwP1, "/ping", 10}},
      {us(6800), kPing, RclTimerInit{kT1, 500'000'000}},
      {us(6810), kPing, RclcppTimerCallbackAdded{kT1, kCallbackT}},
      {us(6820), kPing, RclcppCallbackRegister{kCallbackT, "std::_Bind<void (Ping::*(Ping*))()>"}},
      {us(6830), kPing, RclcppTimerLinkNode{kT1, kN1}},
      {us(7000), kPing, RclcppExecutorGetNextReady{}},
      {us(7010), kPing, RclcppExecutorWaitForWork{-1}},
      {us(20000), kPong, RclInit{kC2, "8.10.1"}},
      {us(20900), kPong, RmwSubscriptionInit{kDiscovery2, {}}},
      {us(21200), kPong, RclNodeInit{kN2, kRmwN2, "pong", "/"}},
      {us(26000), kPong, RmwSubscriptionInit{kRmwS2, {}}},
      {us(26100), kPong, RclSubscriptionInit{kS2, kN2, kRmwS2, "/ping", 10}},
      {us(26110), kPong, RclcppSubscriptionInit{kS2, kO2}},
      {us(26120), kPong, RclcppSubscriptionCallbackAdded{kO2, kCallbackB}},
      {us(26130), kPong,
       RclcppCallbackRegister{kCallbackB, "Pong::on_ping(std_msgs::msg::String_<std::allocator<void> > const&)"}},
      {us(26500), kPong, RmwPublisherInit{kRmwP2, {}}},
      {us(26600), kPong, RclPublisherInit{kP2, kN2, kRmwP2, "/pong", 10}},
      {us(27000), kPong, RclcppExecutorGetNextReady{}},
      {us(27010), kPong, RclcppExecutorWaitForWork{-1}},
      {us(27020), kPong, RmwTake{kDiscovery2, kM4, 0, true}},
      {us(27030), kPong, RmwTake{kDiscovery2, kM4, 0, false}},
      {us(506900), kPing, RclcppExecutorGetNextReady{}},
      {us(506905), kPing, RclcppExecutorExecute{kT1}},
      {us(506908), kPing, CallbackStart{kCallbackT, false}},
      {us(506910), kPing, RclcppPublish{kM1}},
      {us(506915), kPing, RclPublish{kP1, kM1}},
      {us(506920), kPing, RmwPublish{kRmwP1, kM1, kPingSent}},
      {us(506968), kPing, CallbackEnd{kCallbackT}},
      {us(506970), kPing, RclcppExecutorGetNextReady{}},
      {us(506975), kPing, RclcppExecutorWaitForWork{-1}},
      {us(507050), kPong, RclcppExecutorGetNextReady{}},
      {us(507055), kPong, RclcppExecutorExecute{kS2}},
      {us(507060), kPong, RmwTake{kRmwS2, kM2, kPingSent, true}},
      {us(507062), kPong, RclTake{kM2}},
      {us(507064), kPong, RclcppTake{kM2}},
      {us(507070), kPong, CallbackStart{kCallbackB, false}},
      {us(507100), kPong, RclcppPublish{kM3}},
      {us(507102), kPong, RclPublish{kP2, kM3}},
      {us(507105), kPong, RmwPublish{kRmwP2, kM3, kPongSent}},
      {us(507150), kPong, CallbackEnd{kCallbackB}},
      {us(507200), kPing, RclcppExecutorGetNextReady{}},
      {us(507205), kPing, RclcppExecutorExecute{kS1}},
      {us(507210), kPing, RmwTake{kRmwS1, kM1, kPongSent, true}},
      {us(507212), kPing, RclTake{kM1}},
      {us(507214), kPing, RclcppTake{kM1}},
      {us(507220), kPing, CallbackStart{kCallbackA, false}},
      {us(507250), kPing, CallbackEnd{kCallbackA}},
  };
}

}  // namespace tracing::testing
