// SPDX-License-Identifier: Apache-2.0
// The grammar of conditions, and their evaluation.
#include "base/conditions/field_condition.hpp"

#include <gtest/gtest.h>

#include <map>

#include "base/diagnostics/diagnostic.hpp"

namespace {

using launch::FieldCondition;
using launch::FieldContent;
using launch::FieldPath;

launch::LocatedText located(const std::string& text) {
  return launch::LocatedText(
      text, {std::make_shared<launch::SourceFile>("where", text), 0, static_cast<std::uint32_t>(text.size())});
}

// "pose.position[3]"
std::string to_text(const FieldPath& path) {
  std::string text;
  for (const FieldPath::Part& part : path.parts) {
    const auto* const name = std::get_if<std::string>(&part.step);
    text += name != nullptr ? (text.empty() ? "" : ".") + *name
                            : "[" + std::to_string(std::get<std::size_t>(part.step)) + "]";
  }
  return text;
}

const std::map<std::string, FieldContent> kFields{{"depth", {std::int64_t{10}}},
                                                  {"handle", {std::uint64_t{0xffffffff00000001}}},
                                                  {"temperature", {20.5}},
                                                  {"topic", {std::string_view("/chatter")}},
                                                  {"path", {std::string_view("a\\db")}},
                                                  {"empty", {std::string_view()}},
                                                  {"gid", {launch::FieldParts{16}}},
                                                  {"gid[3]", {std::int64_t{7}}},
                                                  {"pose.x", {1.5}},
                                                  {"len", {std::int64_t{4}}},
                                                  {"state", {std::int64_t{2}, "READY"}},
                                                  {"order", {std::int64_t{1}}}};

bool holds(const std::string& text, FieldCondition::Of of) {
  const FieldCondition condition(located(text), of);
  return condition.holds([&](std::size_t i) {
    const auto found = kFields.find(to_text(condition.fields()[i]));
    return found == kFields.end() ? std::nullopt : std::optional(found->second);
  });
}

// The same of both languages.
bool holds(const std::string& text) {
  const bool result = holds(text, FieldCondition::Of::kMessages);
  EXPECT_EQ(holds(text, FieldCondition::Of::kEvents), result) << text;
  return result;
}

std::string error_of(const std::string& text, FieldCondition::Of of = FieldCondition::Of::kMessages) {
  try {
    const FieldCondition condition(located(text), of);
  } catch (const launch::LaunchError& error) {
    const launch::Diagnostic& first = error.diagnostics().front();
    return std::to_string(first.where.begin) + ".." + std::to_string(first.where.end) + " " + first.message +
           (first.help.empty() ? "" : "; " + first.help);
  }
  return "none";
}

TEST(ConditionGrammar, HasTwoSpellings) {
  EXPECT_TRUE(holds("depth == 1 or depth == 10"));
  EXPECT_TRUE(holds("depth == 1 || depth == 10"));
  EXPECT_TRUE(holds("depth == 1 or depth > 9 && not topic == \"/chat\" and !(depth < 3)"));
  EXPECT_TRUE(holds("not(order==2)and!(order==3)or false"));
}

TEST(ConditionGrammar, BindsAndMoreThanOrAndNotMoreThanAnd) {
  EXPECT_TRUE(holds("true or false and false"));
  EXPECT_FALSE(holds("(true || false) && false"));
  EXPECT_FALSE(holds("not false and false"));
  EXPECT_TRUE(holds("not not true"));
  EXPECT_FALSE(holds("!depth == 10")) << "not binds less than a comparison";
}

TEST(ConditionGrammar, ComparesNumbers) {
  EXPECT_TRUE(holds("temperature == 20.5 and temperature < 2.06e1 and temperature > +20"));
  EXPECT_TRUE(holds("handle == 0xffffffff00000001 and handle == 18446744069414584321 and handle > -5"));
  EXPECT_FALSE(holds("handle == 0xffffffff00000002"));
  EXPECT_TRUE(holds("1 < depth <= 10 != 11"));
  EXPECT_FALSE(holds("1 < depth < 10"));
  EXPECT_TRUE(holds("order == true and order == True and order != false and .5 < pose.x"));
}

TEST(ConditionGrammar, ComparesTexts) {
  EXPECT_TRUE(holds("topic == '/chatter' and '/d' > topic"));
  EXPECT_TRUE(holds("topic =~ 'chat+er$'"));
  EXPECT_FALSE(holds("topic =~ '^chatter'"));
  EXPECT_TRUE(holds("state == 'READY' and state == 2 and state =~ 'AD'"));
  EXPECT_FALSE(holds("topic == 10 or topic != 10")) << "a text is no number";
  EXPECT_TRUE(holds("path =~ '\\\\\\\\d' and topic =~ '\\w'"));
  EXPECT_TRUE(holds("path == 'a\\db'", FieldCondition::Of::kEvents)) << "the backslash is a part of the text";
  EXPECT_FALSE(holds("path == 'a\\db'", FieldCondition::Of::kMessages)) << "the backslash makes the d plain";
  EXPECT_TRUE(holds("path == 'a\\\\db'"));
}

TEST(ConditionGrammar, NamesPartsAndLengths) {
  EXPECT_TRUE(holds("pose.x == 1.5 and pose . x == 1.5 and pose..x. == 1.5 and .pose.x == 1.5"));
  EXPECT_TRUE(holds("gid[3] == 7 and gid [3 ] == 7 and len(gid) == 16 and len( topic ) == 8"));
  EXPECT_TRUE(holds("len == 4")) << "a field of this name";
  EXPECT_TRUE(holds("depth == depth", FieldCondition::Of::kMessages));
}

TEST(ConditionGrammar, AnOperandAloneHoldsIfThereIsSomething) {
  EXPECT_TRUE(holds("depth and topic and gid and pose.x and 1 and 'a'"));
  EXPECT_FALSE(holds("empty"));
  EXPECT_FALSE(holds("missing"));
  EXPECT_FALSE(holds("missing == 1 or missing != 1 or len(missing) == 0 or gid == 16 or missing =~ ''"));
}

TEST(ConditionGrammar, KnowsItsFields) {
  const FieldCondition condition(located("a.b[1] == 1 and not len(c) > 2 or a < 3"), FieldCondition::Of::kEvents);
  ASSERT_EQ(condition.fields().size(), 3U);
  EXPECT_EQ(to_text(condition.fields()[0]), "a.b[1]");
  EXPECT_EQ(to_text(condition.fields()[1]), "c");
  EXPECT_EQ(to_text(condition.fields()[2]), "a");
}

TEST(ConditionGrammar, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(error_of(""), "0..0 expected the name of a field");
  EXPECT_EQ(error_of("a &&"), "4..4 expected the name of a field");
  EXPECT_EQ(error_of("@"), "0..1 expected the name of a field");
  EXPECT_EQ(error_of("[1] == 1"), "0..1 expected the name of a field");
  EXPECT_EQ(error_of("len() == 1"), "4..5 expected the name of a field");
  EXPECT_EQ(error_of("len(a"), "5..5 expected ')'");
  EXPECT_EQ(error_of("(a"), "2..2 expected ')'");
  EXPECT_EQ(error_of("a b"), "2..3 unexpected 'b'; conditions are joined by 'and' and 'or'");
  EXPECT_EQ(error_of("a == "), "5..5 expected a value");
  EXPECT_EQ(error_of("a == /b"), "5..6 expected a value");
  EXPECT_EQ(error_of("a == 'b"), "7..7 a text has no closing quote");
  EXPECT_EQ(error_of("a == 1.2.3"), "5..10 '1.2.3' is no number; texts stand in quotes");
  EXPECT_EQ(error_of("a == -"), "5..6 '-' is no number; texts stand in quotes");
  EXPECT_EQ(error_of("a =~ 3"), "5..6 '=~' needs a text in quotes");
  EXPECT_EQ(error_of("a =~ b"), "5..6 '=~' needs a text in quotes");
  EXPECT_EQ(error_of("a =~ '('"), "5..8 '(' is no regular expression");
  EXPECT_EQ(error_of("a[x]"), "2..3 expected the number of an element; write it as in [0]");
  EXPECT_EQ(error_of("a[1 == 1"), "4..5 expected ']'");
}

TEST(ConditionGrammar, TheTwoLanguagesSayTwoThingsInTheirOwnWay) {
  EXPECT_EQ(error_of("a = 1", FieldCondition::Of::kMessages), "2..3 '=' is no comparison; write '=='");
  EXPECT_EQ(error_of("a = 1", FieldCondition::Of::kEvents), "2..3 expected '==' to compare; write '=='");
  EXPECT_EQ(error_of("a == b", FieldCondition::Of::kMessages), "none");
  EXPECT_EQ(error_of("a == b", FieldCondition::Of::kEvents), "5..6 'b' is no number; texts stand in quotes");
}

TEST(FieldPath, ReadsAWholeText) {
  EXPECT_EQ(to_text(FieldPath::parse(located("pose.covariance[3]"))), "pose.covariance[3]");
  EXPECT_EQ(to_text(FieldPath::parse(located(""))), "");
  try {
    FieldPath::parse(located("frame-id"));
    FAIL() << "this is no path";
  } catch (const launch::LaunchError& error) {
    EXPECT_EQ(error.diagnostics().front().message, "unexpected '-id'");
  }
}

}  // namespace
