// SPDX-License-Identifier: Apache-2.0
// The visit alone, with actions that note their execution: conditions, scopes, and what is explored on the side.
#include "launcher/visit/launch_context.hpp"

#include <gmock/gmock.h>

#include "launcher/visit/joined_description.hpp"

namespace launch {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

using Journal = std::vector<std::string>;

Condition condition(const std::string& text) {
  return {Template({std::make_shared<Text>(text, SourceRange())}, SourceRange()), false};
}

// Notes its name and sets a launch configuration to it.
class Note : public Action {
 public:
  Note(std::string name, Condition when, Journal& journal)
      : Action({}, std::move(when)), name_(std::move(name)), journal_(journal) {}

  void execute(LaunchContext& context) const override {
    journal_.push_back(name_);
    context.scope().configurations.insert_or_assign("last", name_);
    context.requests().logs.push_back(name_);
    if (name_ == "broken") {
      throw LaunchError("it is broken", {});
    }
  }

 private:
  std::string name_;
  Journal& journal_;
};

class LaunchContextTest : public testing::Test {
 protected:
  ActionPtr note(const std::string& name, Condition when = {}) {
    return std::make_shared<Note>(name, std::move(when), journal_);
  }
  std::string last() { return context_.scope().configurations.at("last"); }

  Journal journal_;
  Registry registry_;
  LaunchContext context_{registry_, {}, "", [](LogLevel, std::string_view, std::string_view) {}};
};

TEST_F(LaunchContextTest, AnActionIsExecutedWhenItsConditionHolds) {
  context_.visit({note("a", condition("true")), note("b", condition("false")), note("c")});
  EXPECT_THAT(journal_, ElementsAre("a", "c"));
  EXPECT_THAT(context_.take_requests().logs, ElementsAre("a", "c"));
  EXPECT_THAT(context_.take_requests().logs, IsEmpty());
}

TEST_F(LaunchContextTest, AConditionThatIsNoneIsAnError) {
  EXPECT_THROW(context_.visit({note("a", condition("maybe"))}), LaunchError);
  EXPECT_THAT(journal_, IsEmpty());
}

TEST_F(LaunchContextTest, AScopeOfItsOwnEndsWithItsActionsAlsoAfterAnError) {
  context_.visit({note("outer")});
  context_.visit_in(Scope(), {note("inner")});
  EXPECT_EQ(last(), "outer");
  EXPECT_THROW(context_.visit_in(Scope(), {note("broken")}), LaunchError);
  EXPECT_EQ(last(), "outer");
}

TEST_F(LaunchContextTest, ExploringGoesOnAfterErrorsAndLooksIntoWhatIsLeftOut) {
  std::vector<std::pair<std::string, bool>> errors;
  std::vector<std::string> left_out;
  context_.exploration().begin(
      {.report = [&](const LaunchError& error,
                     bool is_left_out) { errors.emplace_back(error.diagnostics().front().message, is_left_out); },
       .left_out = [&](Requests requests) { left_out = std::move(requests.logs); }});
  context_.visit({note("broken"), note("left out", condition("false")), note("broken", condition("false")), note("z")});
  EXPECT_THAT(journal_, ElementsAre("broken", "left out", "broken", "z"));
  EXPECT_THAT(errors, ElementsAre(Pair("it is broken", false), Pair("it is broken", true)));
  EXPECT_THAT(context_.take_requests().logs, ElementsAre("broken", "z")) << "what is left out asks for nothing";
  EXPECT_THAT(left_out, ElementsAre("broken"));
}

TEST_F(LaunchContextTest, AFileIsTheCurrentOneWhileItIsVisited) {
  LaunchDescription description;
  description.file = std::make_shared<SourceFile>("/test/a.launch.xml", "");
  description.environment_changes = {{"SET", "1"}};
  std::string current;
  context_.visit(description, [&] { current = context_.scope().current_file->path(); });
  EXPECT_EQ(current, "/test/a.launch.xml");
  EXPECT_EQ(context_.scope().current_file, nullptr);
  EXPECT_EQ(context_.scope().environment.at("SET"), "1");
}

TEST_F(LaunchContextTest, SeveralFilesAreVisitedOneAfterAnother) {
  std::vector<std::shared_ptr<const LaunchDescription>> files;
  for (const char* const name : {"a", "b"}) {
    auto file = std::make_shared<LaunchDescription>();
    file->file = std::make_shared<SourceFile>(name, "");
    file->actions = {note(name)};
    files.push_back(std::move(file));
  }
  context_.visit(*join_launch_descriptions(std::move(files)));
  EXPECT_THAT(journal_, ElementsAre("a", "b"));
}

}  // namespace
}  // namespace launch
