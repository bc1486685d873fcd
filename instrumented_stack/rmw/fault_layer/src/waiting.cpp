// SPDX-License-Identifier: Apache-2.0
// rmw_wait() with messages that the middleware does not know: late ones, and copies.
#include <algorithm>
#include <chrono>
#include <optional>
#include <span>

#include "endpoints_waited_for.hpp"

namespace rmw_fault_layer {

namespace {

using Clock = std::chrono::steady_clock;

// An entry of one of the arrays whose endpoint has faults.
struct Faulty {
  void** entry;
  void* data;
  std::shared_ptr<IncomingMessages> messages;
};

void add_faulty(std::span<void*> entries, std::vector<Faulty>& faulty) {
  for (void*& entry : entries) {
    if (entry != nullptr) {
      if (auto messages = waited_for().find(entry)) {
        faulty.push_back({&entry, entry, std::move(messages)});
      }
    }
  }
}

// An array as it was before the wait.
class Saved {
 public:
  explicit Saved(std::span<void*> entries) : entries_(entries), before_(entries.begin(), entries.end()) {}
  void restore() const { std::copy(before_.begin(), before_.end(), entries_.begin()); }
  bool is_any_ready() const {
    return std::any_of(entries_.begin(), entries_.end(), [](const void* entry) { return entry != nullptr; });
  }

 private:
  std::span<void*> entries_;
  std::vector<void*> before_;
};

constexpr std::int64_t kSecond = 1'000'000'000;

std::optional<Clock::time_point> end_of(const rmw_time_t* timeout) {
  constexpr std::uint64_t kMostSeconds = 1'000'000'000;  // as good as none
  if (timeout == nullptr || timeout->sec > kMostSeconds) {
    return std::nullopt;
  }
  return Clock::now() + std::chrono::seconds(timeout->sec) + std::chrono::nanoseconds(timeout->nsec);
}

rmw_time_t until(Clock::time_point end) {
  const std::int64_t rest =
      std::max<std::int64_t>(0, std::chrono::duration_cast<std::chrono::nanoseconds>(end - Clock::now()).count());
  return {static_cast<std::uint64_t>(rest / kSecond), static_cast<std::uint64_t>(rest % kSecond)};
}

}  // namespace

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_wait(rmw_subscriptions_t* subscriptions,
                                            rmw_guard_conditions_t* guard_conditions, rmw_services_t* services,
                                            rmw_clients_t* clients, rmw_events_t* events, rmw_wait_set_t* wait_set,
                                            const rmw_time_t* timeout) {
  static auto* const wait_next = next<decltype(::rmw_wait)>("rmw_wait");
  const auto of = [](auto* array, auto count, auto entries) {
    return array == nullptr ? std::span<void*>() : std::span<void*>(array->*entries, array->*count);
  };
  const auto of_subscriptions =
      of(subscriptions, &rmw_subscriptions_t::subscriber_count, &rmw_subscriptions_t::subscribers);
  const auto of_services = of(services, &rmw_services_t::service_count, &rmw_services_t::services);
  std::vector<Faulty> faulty;
  add_faulty(of_subscriptions, faulty);
  add_faulty(of_services, faulty);
  if (faulty.empty()) {
    return wait_next(subscriptions, guard_conditions, services, clients, events, wait_set, timeout);
  }

  const auto of_guards =
      of(guard_conditions, &rmw_guard_conditions_t::guard_condition_count, &rmw_guard_conditions_t::guard_conditions);
  const Saved saved[] = {Saved(of_subscriptions), Saved(of_services),
                         Saved(of(clients, &rmw_clients_t::client_count, &rmw_clients_t::clients)),
                         Saved(of(events, &rmw_events_t::event_count, &rmw_events_t::events)), Saved(of_guards)};
  const std::optional<Clock::time_point> end = end_of(timeout);
  while (true) {
    std::vector<void*> guards(of_guards.begin(), of_guards.end());
    bool is_waiting = false;
    for (const Faulty& each : faulty) {
      guards.push_back(each.messages->guard_condition());
      is_waiting = is_waiting || each.messages->has_message();
    }
    rmw_guard_conditions_t all_guards{guards.size(), guards.data()};
    const rmw_time_t rest = is_waiting || !end ? rmw_time_t{0, 0} : until(*end);
    const rmw_ret_t result =
        wait_next(subscriptions, &all_guards, services, clients, events, wait_set, is_waiting || end ? &rest : nullptr);
    std::copy_n(guards.begin(), of_guards.size(), of_guards.begin());
    if (result != RMW_RET_OK && result != RMW_RET_TIMEOUT) {
      return result;
    }
    for (const Faulty& each : faulty) {
      if (each.messages->has_message()) {
        *each.entry = each.data;
      }
    }
    if (std::any_of(std::begin(saved), std::end(saved), [](const Saved& array) { return array.is_any_ready(); })) {
      return RMW_RET_OK;
    }
    if (result == RMW_RET_TIMEOUT && !is_waiting) {
      return RMW_RET_TIMEOUT;
    }
    // The guard condition told of a message that another thread has taken since then.
    for (const Saved& array : saved) {
      array.restore();
    }
  }
}

}  // namespace rmw_fault_layer
