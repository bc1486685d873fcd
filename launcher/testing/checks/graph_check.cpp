// SPDX-License-Identifier: Apache-2.0
// <graph node="…"/>, <graph topic="…"/>, <graph service="…"/>
#include <fmt/format.h>

#include "launcher/testing/checks/check.hpp"

namespace launch {

namespace {

class GraphCheck final : public Check {
 public:
  explicit GraphCheck(const Expectation& expectation)
      : Check(expectation), expected_(std::get<ExpectedGraph>(expectation.what)) {}

  bool is_waited_for() const override { return !expected_.absent; }

 protected:
  void on_begin(EventLoop& loop) override {
    expected_.condition->watch(loop, [this](const std::optional<std::string>& failure) {
      if (failure) {
        fail({"the ROS graph can't be watched", expectation().where, text(), *failure});
      } else if (expected_.absent) {
        Failure found{fmt::format("{}", text()), expectation().where, fmt::format("never: {}", text()), "it happened"};
        tail().show(found);
        fail(std::move(found));
      } else {
        meet();
      }
    });
  }

  std::optional<Failure> verdict(const std::string& when) override {
    if (expected_.absent) {
      return std::nullopt;
    }
    Failure failure{fmt::format("it did not happen {}: {}", when, text()), expectation().where, text(),
                    expected_.condition->seen()};
    tail().show(failure);
    return failure;
  }

 private:
  std::string text() const { return expected_.condition->describe(); }

  ExpectedGraph expected_;
};

}  // namespace

std::unique_ptr<Check> make_graph_check(const Expectation& expectation) {
  return std::make_unique<GraphCheck>(expectation);
}

}  // namespace launch
