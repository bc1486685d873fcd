// SPDX-License-Identifier: Apache-2.0
// Rows of settings: from one declaration come the attributes, the checks, the evaluation and the dry run.
#include "launcher/language/setting.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "launcher/frontend/frontend.hpp"
#include "launcher/language/action_parser.hpp"
#include "launcher/language/registry.hpp"
#include "launcher/substitution/scope.hpp"

namespace {

using namespace launch;
using testing::ElementsAre;

struct Door {
  bool open = false;
};

struct Oven {
  bool fan = false;
  std::optional<bool> light = {};
  std::int64_t offset = 0;
  std::uint32_t seconds = 60;
  double share = 0.5;
  std::chrono::nanoseconds pause = std::chrono::seconds(1);
  double heat = 1;
  Door door = {};
  std::string name = "oven";
  std::vector<std::string> dishes = {};
  std::size_t rack = 0;
};

const std::vector<Setting<Oven>>& settings() {
  using Type = AttributeType;
  static const std::vector<Setting<Oven>> rows = {
      {.attribute = {"fan", Type::kBoolean, false, "false", ""}, .place = place_of(&Oven::fan), .shown = "fan"},
      {.attribute = {"light", Type::kBoolean, false, "", ""}, .place = place_of(&Oven::light), .shown = "light"},
      {.attribute = {"offset", Type::kInteger, false, "0", ""}, .place = place_of(&Oven::offset), .shown = "offset"},
      {.attribute = {"seconds", Type::kInteger, false, "60", ""},
       .place = place_of(&Oven::seconds),
       .shown = "seconds"},
      {.attribute = {"share", Type::kFloat, false, "0.5", ""}, .place = place_of(&Oven::share), .shown = "share"},
      {.attribute = {"pause", Type::kFloat, false, "1", ""}, .place = place_of(&Oven::pause), .shown = "pause"},
      {.attribute = {"heat", Type::kFloat, false, "1", ""},
       .place = [](Oven& oven) -> SettingPlace { return NumberFromZero{&oven.heat}; }},
      {.attribute = {"open", Type::kBoolean, false, "false", ""}, .place = place_of(&Oven::door, &Door::open)},
      {.attribute = {"door-name", Type::kText, false, "", ""}},
      {.attribute = {"voltage", Type::kText, false, "", ""},
       .perform =
           [](const Fields& fields, Scope& scope, Oven&) {
             if (fields.text("voltage").perform(scope) != "230") {
               throw LaunchError("an oven needs 230 volt", fields.where("voltage"));
             }
           },
       .checks_literal = true},
      {.attribute = {"name", Type::kText, false, "oven", ""},
       .perform = [](const Fields& fields, Scope& scope,
                     Oven& oven) { oven.name = "the " + fields.text("name").perform(scope); },
       .shown = "called",
       .show = [](const Oven& oven) { return oven.name; }},
      {.attribute = {"dishes", Type::kWords, false, "", ""}, .place = place_of(&Oven::dishes), .shown = "dishes"},
      {.attribute = {"rack", Type::kText, false, "low", ""},
       .place = [](Oven& oven) -> SettingPlace {
         return SettingChoice{{"low", "high"}, oven.rack, [&oven](std::size_t word) { oven.rack = word; }};
       },
       .shown = "rack"},
      {.shown = "kind", .show = [](const Oven&) { return std::string("electric"); }},
  };
  return rows;
}

// Keeps the fields, as an action does, and shows what it has evaluated.
class Bake : public Action {
 public:
  explicit Bake(const Fields& fields) : Action(fields.where(), fields.condition()), fields_(fields) {
    check_settings(settings(), fields_);
  }
  Oven perform(Scope& scope) const {
    Oven oven;
    perform_settings(settings(), fields_, scope, oven);
    return oven;
  }

 protected:
  void execute(LaunchContext&) const override {}

 private:
  Fields fields_;
};

// The declarations outlive the fields.
const Registry& registry() {
  static const Registry declarations = [] {
    Registry made;
    made.add({.tag = "bake",
              .help = "",
              .attributes = declared_attributes(settings()),
              .items = {},
              .make = [](const Fields& fields) { return std::make_shared<Bake>(fields); }});
    return made;
  }();
  return declarations;
}

std::vector<ActionPtr> load(const std::string& attributes) {
  Entity root = parse_xml(std::make_shared<SourceFile>("file.xml", "<launch><bake " + attributes + "/></launch>"));
  return ActionParser(registry()).parse(std::move(root.children));
}

// The oven of an XML element, with `dish` as a launch configuration.
Oven bake(const std::string& attributes) {
  const std::vector<ActionPtr> actions = load(attributes);
  Scope scope;
  scope.configurations["dish"] = "pie  tart";
  return dynamic_cast<const Bake&>(*actions.at(0)).perform(scope);
}

template <typename Step>
std::string error_at(Step step, const std::string& attributes) {
  try {
    step(attributes);
  } catch (const LaunchError& error) {
    return error.what();
  }
  return "none";
}

std::string loading_error(const std::string& attributes) {
  return error_at(load, attributes);
}

std::string error_of(const std::string& attributes) {
  return error_at(bake, attributes);
}

TEST(Setting, WhatIsNotGivenStaysAsItIs) {
  const Oven oven = bake("");
  EXPECT_FALSE(oven.fan);
  EXPECT_FALSE(oven.light.has_value());
  EXPECT_EQ(oven.seconds, 60U);
  EXPECT_EQ(oven.name, "oven");
}

TEST(Setting, EachTypeOfPlaceIsRead) {
  const Oven oven = bake(
      "fan='true' light='false' offset='-3' seconds='7' share='.25' pause='0.5' heat='2.5' open='true' name='A' "
      "dishes='$(var "
      "dish) cake' "
      "rack='high'");
  EXPECT_TRUE(oven.fan);
  EXPECT_EQ(oven.light, false);
  EXPECT_EQ(oven.offset, -3);
  EXPECT_EQ(oven.seconds, 7U);
  EXPECT_EQ(oven.share, 0.25);
  EXPECT_EQ(oven.pause, std::chrono::milliseconds(500));
  EXPECT_EQ(oven.heat, 2.5);
  EXPECT_TRUE(oven.door.open);
  EXPECT_EQ(oven.name, "the A");
  EXPECT_THAT(oven.dishes, ElementsAre("pie", "tart", "cake"));
  EXPECT_EQ(oven.rack, 1U);
}

TEST(Setting, ANumberOf32BitsIsTheLargestOneAtMost) {
  EXPECT_EQ(bake("seconds='99999999999'").seconds, 4'294'967'295U);
}

TEST(Setting, ANumberFromZeroIsNotNegative) {
  EXPECT_EQ(loading_error("heat='-1'"),
            "file.xml:1:21: error: expected a number that is not negative, got '-1'\n"
            "    1 | <launch><bake heat='-1'/></launch>\n"
            "      |                     ^~\n"
            "      = help: write 0 or more");
}

TEST(Setting, ATimeIsNotNegative) {
  EXPECT_EQ(error_of("pause='-0.5'"),
            "file.xml:1:22: error: expected a number that is not negative, got '-0.5'\n"
            "    1 | <launch><bake pause='-0.5'/></launch>\n"
            "      |                      ^~~~\n"
            "      = help: write 0 or more");
}

TEST(Setting, ARowMayCheckALiteralWhenTheFileIsLoaded) {
  EXPECT_EQ(loading_error("voltage='12'"),
            "file.xml:1:24: error: an oven needs 230 volt\n"
            "    1 | <launch><bake voltage='12'/></launch>\n"
            "      |                        ^~");
  EXPECT_EQ(loading_error("voltage='$(var dish)'"), "none");
}

TEST(Setting, ARowWithoutAPlaceIsOnlyDeclared) {
  EXPECT_EQ(error_of("door-name='left'"), "none");
}

TEST(Setting, ErrorsSayWhatIsExpected) {
  EXPECT_EQ(error_of("seconds='-1'"),
            "file.xml:1:24: error: expected a number that is not negative, got '-1'\n"
            "    1 | <launch><bake seconds='-1'/></launch>\n"
            "      |                        ^~\n"
            "      = help: write 0 or more");
  EXPECT_EQ(error_of("rack='middle'"),
            "file.xml:1:21: error: rack is expected to be low or high, got 'middle'\n"
            "    1 | <launch><bake rack='middle'/></launch>\n"
            "      |                     ^~~~~~");
  EXPECT_EQ(error_of("light='dim'"),
            "file.xml:1:22: error: expected a boolean, got 'dim'\n"
            "    1 | <launch><bake light='dim'/></launch>\n"
            "      |                      ^~~\n"
            "      = help: write true or false");
}

TEST(Setting, IsShownUnderItsNameInTheOrderOfTheRows) {
  Oven oven;
  oven.offset = -3;
  oven.light = true;
  oven.dishes = {"pie"};
  std::vector<std::string> names;
  for (const ShownSetting& shown : shown_settings(settings(), oven)) {
    names.push_back(shown.name);
  }
  EXPECT_THAT(names,
              ElementsAre("fan", "light", "offset", "seconds", "share", "pause", "called", "dishes", "rack", "kind"));
  const std::vector<ShownSetting> shown = shown_settings(settings(), oven);
  EXPECT_EQ(shown[1].value, SettingValue(true));
  EXPECT_EQ(shown[2].value, SettingValue(std::int64_t{-3}));
  EXPECT_EQ(shown[4].value, SettingValue(std::string("0.5")));
  EXPECT_EQ(shown[5].value, SettingValue(std::string("1")));
  EXPECT_EQ(shown[7].value, SettingValue(std::vector<std::string>{"pie"}));
  EXPECT_EQ(shown[8].value, SettingValue(std::string("low")));
}

}  // namespace
