// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "base/diagnostics/read_source_file.hpp"
#include "tests/unit/frontend/entity_equivalence.hpp"
#include "tests/unit/frontend/entity_test_support.hpp"

namespace launch {
namespace {

// The same launch file in both formats: GOLDEN_FILES/twins/NAME.launch.{xml,yaml}.
class Twins : public testing::TestWithParam<const char*> {
 protected:
  static Entity load(const std::string& suffix) {
    return load_entity_tree(read_source_file(GOLDEN_FILES "/twins/" + std::string(GetParam()) + suffix));
  }
};

TEST_P(Twins, GiveEquivalentTrees) {
  EXPECT_TRUE(equivalent(load(".launch.xml"), load(".launch.yaml")));
  EXPECT_TRUE(equivalent(load(".launch.yaml"), load(".launch.xml")));
}

INSTANTIATE_TEST_SUITE_P(Files, Twins, testing::Values("system", "short"));

bool same(const std::string& xml_action, const std::string& yaml_action) {
  return equivalent(xml("<launch>" + xml_action + "</launch>"), yaml("launch:\n- " + yaml_action + "\n"));
}

TEST(Equivalent, ComparesXmlTextWithTypedValues) {
  EXPECT_TRUE(same("<x a='10'/>", "x: {a: 10}"));
  EXPECT_TRUE(same("<x a='10'/>", "x: {a: '10'}"));
  EXPECT_TRUE(same("<x a='yes'/>", "x: {a: true}"));
  EXPECT_TRUE(same("<x a='1'/>", "x: {a: 1.0}"));
  EXPECT_TRUE(same("<x a='[1, b]'/>", "x: {a: [1, b]}"));
  EXPECT_TRUE(same("<x a='1;b' a-sep=';'/>", "x: {a: [1, b]}"));
  EXPECT_FALSE(same("<x a='10'/>", "x: {a: 11}"));
  EXPECT_FALSE(same("<x a='0x10'/>", "x: {a: '16'}")) << "a quoted value is text";
  EXPECT_FALSE(same("<x a='no'/>", "x: {a: true}"));
  EXPECT_FALSE(same("<x a='[1, b'/>", "x: {a: [1, b]}"));
}

TEST(Equivalent, ComparesNamesAndAttributesInAnyOrder) {
  EXPECT_TRUE(same("<x a='b' c='d'/>", "x: {c: d, a: b}"));
  EXPECT_FALSE(same("<x a='b'/>", "y: {a: b}"));
  EXPECT_FALSE(same("<x a='b'/>", "x: {a: b, c: d}"));
  EXPECT_FALSE(same("<x a='b' c='d'/>", "x: {a: b}"));
}

TEST(Equivalent, KeepsTheOrderOfSubActionsAndOfItemsOfOneName) {
  EXPECT_TRUE(same("<g><a/><b/></g>", "g: [{a: {}}, {b: {}}]"));
  EXPECT_FALSE(same("<g><b/><a/></g>", "g: [{a: {}}, {b: {}}]"));
  EXPECT_TRUE(same("<n><p i='1'/><r/><p i='2'/></n>", "n: {r: [{}], p: [{i: 1}, {i: 2}]}"));
  EXPECT_FALSE(same("<n><p i='2'/><p i='1'/></n>", "n: {p: [{i: 1}, {i: 2}]}"));
  EXPECT_FALSE(same("<n><p i='1'/></n>", "n: {p: [{i: 1}, {i: 2}]}"));
}

TEST(Entity, FindsAttributesByName) {
  const Entity root = xml("<launch><x a='1' b='2'/></launch>");
  EXPECT_EQ(root.children[0].find("b")->value.scalar()->text.text(), "2");
  EXPECT_EQ(root.children[0].find("c"), nullptr);
}

}  // namespace
}  // namespace launch
