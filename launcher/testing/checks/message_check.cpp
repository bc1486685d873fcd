// SPDX-License-Identifier: Apache-2.0
// <message topic="…"/>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "launcher/testing/checks/check.hpp"

namespace launch {

namespace {

class MessageCheck final : public Check {
 public:
  explicit MessageCheck(const Expectation& expectation)
      : Check(expectation), expected_(std::get<ExpectedMessages>(expectation.what)) {}

  // A rate and an upper limit hold until the end. A test that ends at once still waits for the publisher that an upper
  // limit is about.
  bool is_waited_for() const override {
    return seen_.matching < expected_.least || !holds_until_end() || (expected_.most && !could_have_come());
  }

 protected:
  void on_begin(EventLoop& loop) override {
    expected_.watch->watch(loop, [this](const std::optional<std::string>& failure, const SeenMessages& seen) {
      if (failure) {
        fail({fmt::format("the messages of '{}' can't be watched", expected_.watch->topic()), expectation().where,
              count_text(), *failure});
      } else if (is_open() && !in_shutdown()) {
        take(seen);
      }
    });
  }

  std::optional<Failure> verdict(const std::string& when) override {
    if (seen_.matching < expected_.least) {
      return with_messages(
          {fmt::format("there was not {} {}", enough_text(), when), expectation().where, count_text(), seen_text()});
    }
    if (expected_.most && !could_have_come()) {
      return Failure{.message = fmt::format("{} could not come", message_text()),
                     .where = expectation().where,
                     .expected = count_text(),
                     .seen = seen_text(),
                     .help = seen_.publishers == 0 ? "without_publisher=\"true\" allows that nobody publishes" : ""};
    }
    if (!expected_.least_rate && !expected_.most_rate) {
      return std::nullopt;
    }
    const double rate = rate_of(seen_);
    if ((expected_.least_rate && rate < *expected_.least_rate) ||
        (expected_.most_rate && rate > *expected_.most_rate)) {
      return with_messages({fmt::format("{} does not come at the rate that is expected", message_text()),
                            expectation().where, rate_text(),
                            fmt::format("{:.1f} in a second, in {} of them", rate, seen_.matching)});
    }
    return std::nullopt;
  }

 private:
  // An upper limit says something only of a topic that has had a publisher of the type.
  bool could_have_come() const {
    return seen_.all != 0 || (seen_.publishers == 0 && expected_.without_publisher) || is_of_type();
  }
  bool is_of_type() const {
    return std::find(seen_.types.begin(), seen_.types.end(), expected_.watch->type()) != seen_.types.end();
  }

  bool holds_until_end() const { return expected_.most || expected_.least_rate || expected_.most_rate; }

  void take(const SeenMessages& seen) {
    const bool was_waited_for = is_waited_for();
    seen_ = seen;
    if (expected_.most && seen_.matching > *expected_.most) {
      const std::string what =
          *expected_.most == 0 ? fmt::format("there is {}", message_text())
                               : fmt::format("there are more than {} messages of {}", *expected_.most, message_text());
      fail(with_messages({what, expectation().where, count_text(), seen_text()}));
    } else if (seen_.matching >= expected_.least && !holds_until_end()) {
      meet();
    } else if (was_waited_for != is_waited_for()) {
      reconsider();
    }
  }

  static double rate_of(const SeenMessages& seen) {
    constexpr double kNanoseconds = 1e9;
    const auto time = static_cast<double>(seen.last_ns - seen.first_ns) / kNanoseconds;
    return time > 0 ? static_cast<double>(seen.matching - 1) / time : 0;
  }

  // "a message on '/chatter' with data > 3"
  std::string message_text() const {
    const MessageWatch& watch = *expected_.watch;
    return fmt::format("a message on '{}'{}", watch.topic(),
                       watch.condition().empty() ? "" : fmt::format(" with {}", watch.condition()));
  }
  std::string enough_text() const {
    return expected_.least == 1 ? message_text() : fmt::format("{} times {}", expected_.least, message_text());
  }
  std::string count_text() const {
    if (expected_.most && *expected_.most == 0) {
      return fmt::format("never {}", message_text());
    }
    if (expected_.most) {
      return expected_.least == 0 ? fmt::format("at most {} times {}", *expected_.most, message_text())
                                  : fmt::format("{} to {} times {}", expected_.least, *expected_.most, message_text());
    }
    return expected_.least == 1 ? message_text() : fmt::format("at least {} times {}", expected_.least, message_text());
  }
  std::string rate_text() const {
    if (expected_.least_rate && expected_.most_rate) {
      return fmt::format("{:g} to {:g} in a second", *expected_.least_rate, *expected_.most_rate);
    }
    return expected_.least_rate ? fmt::format("at least {:g} in a second", *expected_.least_rate)
                                : fmt::format("at most {:g} in a second", *expected_.most_rate);
  }

  std::string seen_text() const {
    if (seen_.all != 0) {
      return seen_.matching == 0
                 ? fmt::format("none in {} message{}", seen_.all, seen_.all == 1 ? "" : "s")
                 : fmt::format("{} in {} message{}", seen_.matching, seen_.all, seen_.all == 1 ? "" : "s");
    }
    if (seen_.publishers == 0) {
      return "no publisher of the topic was found";
    }
    if (!is_of_type()) {
      return fmt::format("the topic has messages of type {}, and not {}", fmt::join(seen_.types, ", "),
                         expected_.watch->type());
    }
    return fmt::format("no message, but {} publisher{}", seen_.publishers, seen_.publishers == 1 ? "" : "s");
  }

  Failure with_messages(Failure failure) const {
    failure.evidence = seen_.last;
    failure.evidence_title = "last messages";
    return failure;
  }

  ExpectedMessages expected_;
  SeenMessages seen_;
};

}  // namespace

std::unique_ptr<Check> make_message_check(const Expectation& expectation) {
  return std::make_unique<MessageCheck>(expectation);
}

}  // namespace launch
