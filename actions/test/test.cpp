// SPDX-License-Identifier: Apache-2.0
// <test name="…">: what must happen when the launch file runs. Only `launch test` looks at it.
#include <algorithm>
#include <cctype>
#include <chrono>
#include <utility>

#include "actions/test/expectations.hpp"
#include "base/environment/test_run_variables.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

constexpr Duration kTimeout = std::chrono::seconds(60);

// While it lives, the scope has the variables of a run.
class RunEnvironment {
 public:
  explicit RunEnvironment(Scope& scope)
      : scope_(scope), before_(std::exchange(scope.environment, with_variables_of_a_test_run(scope.environment))) {}
  ~RunEnvironment() { scope_.environment = std::move(before_); }
  RunEnvironment(const RunEnvironment&) = delete;
  RunEnvironment& operator=(const RunEnvironment&) = delete;

 private:
  Scope& scope_;
  Environment before_;
};

const std::vector<Setting<TestRequest>>& test_rows() {
  static const std::vector<Setting<TestRequest>> rows = {
      {.attribute = {"name", AttributeType::kText, true, "", "name of the test", true},
       .place = place_of(&TestRequest::name)},
      time_row({"timeout", AttributeType::kFloat, false, "60", "seconds after which the test has failed", true},
               &TestRequest::timeout),
      time_row({"duration", AttributeType::kFloat, false, "none",
                "seconds that the system runs at least, even if everything has happened", true},
               &TestRequest::duration)};
  return rows;
}

class Test : public Action {
 public:
  explicit Test(const Fields& fields) : Action(fields.where(), fields.condition()), fields_(fields) {
    check_settings(test_rows(), fields);
    std::vector<Diagnostic> errors;
    for (const ExpectationType& type : expectation_types()) {
      for (const Fields* const item : fields.items(type.item.tag)) {
        try {
          items_.push_back({item->condition(), item->where(), type.make(*item)});
        } catch (const LaunchError& error) {
          errors.insert(errors.end(), error.diagnostics().begin(), error.diagnostics().end());
        }
      }
    }
    if (!errors.empty()) {
      std::sort(errors.begin(), errors.end(),
                [](const Diagnostic& a, const Diagnostic& b) { return a.where.begin < b.where.begin; });
      throw LaunchError(std::move(errors));
    }
    if (items_.empty()) {
      throw LaunchError("the test expects nothing", fields.where(),
                        "say what must happen: <output text=\"…\"/>, <exit process=\"…\"/>, …",
                        Finding::kMissingAttribute);
    }
    std::sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) { return a.where.begin < b.where.begin; });
  }

  Introspection introspect() const override { return {.children = &fields_.actions(), .children_may_not_run = true}; }

 protected:
  void execute(LaunchContext& context) const override {
    const TestVisits::Part part = context.tests().next();
    if (context.exploration().is_on()) {
      // Each test is a run of its own: its processes are not there together with those of the others.
      Requests others = std::exchange(context.requests(), Requests());
      const RunEnvironment variables(context.scope());
      context.tests().visit(context, fields_.actions());
      request(context.scope(), context);
      context.requests() = std::move(others);
    } else if (part != TestVisits::Part::kNothing) {
      TestRequest test = request(context.scope(), context);
      if (part == TestVisits::Part::kActionsToo) {
        test.faults = context.tests().visit(context, fields_.actions());
      }
      context.requests().tests.push_back(std::move(test));
    }
  }

 private:
  struct Item {
    Condition condition;
    SourceRange where;
    PerformExpectation perform;
  };

  TestRequest request(Scope& scope, LaunchContext& context) const {
    TestRequest test;
    test.timeout = kTimeout;
    perform_settings(test_rows(), fields_, scope, test);
    test.name_where = fields_.text("name").where();
    test.where = where();
    if (test.name.empty()) {
      throw LaunchError("the test has no name", test.name_where);
    }
    const auto is_control = [](unsigned char c) { return std::iscntrl(c) != 0; };
    if (std::any_of(test.name.begin(), test.name.end(), is_control)) {
      throw LaunchError("the name of the test has a line break or another control character", test.name_where,
                        "it stands on one line in reports");
    }
    test.has_actions = !fields_.actions().empty();
    for (const Item& item : items_) {
      if (item.condition.holds(scope)) {
        test.expectations.push_back(item.perform(context));
      }
    }
    if (test.expectations.empty()) {
      throw LaunchError("the test expects nothing: the conditions leave all its expectations out", where());
    }
    return test;
  }

  Fields fields_;
  std::vector<Item> items_;
};

}  // namespace

ActionType test_action() {
  std::vector<ItemSpec> items;
  for (const ExpectationType& type : expectation_types()) {
    items.push_back(type.item);
  }
  return {.tag = "test",
          .help =
              "What must happen when the launch file runs: `launch test` runs it and checks. The actions are visited "
              "for this test alone.",
          .attributes = declared_attributes(test_rows()),
          .items = std::move(items),
          .holds_actions = true,
          .may_hold_none = true,
          .extension = true,
          .make = [](const Fields& fields) { return std::make_shared<Test>(fields); }};
}

}  // namespace launch
