// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/outline/outline.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace launch::lsp {
namespace {

// "group(ns=a)[node(pkg=b)]"
std::string shown(std::string_view text, const Outline& outline, int parent) {
  std::string all;
  for (std::size_t i = 0; i < outline.elements.size(); ++i) {
    const OutlineElement& element = outline.elements[i];
    if (element.parent != parent) {
      continue;
    }
    std::string attributes;
    for (const OutlineAttribute& one : element.attributes) {
      attributes += fmt::format("{}{}{}{}", attributes.empty() ? "" : " ", one.name, one.value ? "=" : "",
                                value_of(element, one.name, text));
    }
    const std::string inside = shown(text, outline, static_cast<int>(i));
    all += fmt::format("{}{}({}){}", all.empty() ? "" : " ", element.tag, attributes,
                       inside.empty() ? "" : "[" + inside + "]");
  }
  return all;
}

std::string shown(std::string_view text) {
  return shown(text, outline_of(text), -1);
}

TEST(LspOutline, ReadsXml) {
  EXPECT_EQ(
      shown(
          R"(<?xml version="1.0"?><launch><!-- <no/> --><group ns='a'><node pkg="b" exec = "c > d"/></group><x/></launch>)"),
      "launch()[group(ns=a)[node(pkg=b exec=c > d)] x()]");
}

TEST(LspOutline, TakesWhatIsMissingInXml) {
  EXPECT_EQ(shown("<launch>\n<node pkg=\"a\n<node exec=\"b\"/>\n<"), "launch()[node(pkg=a)[node(exec=b) ()]]");
  EXPECT_EQ(shown("<launch><a x y= z=\"1\"><b></a></launch>"), "launch()[a(x y z=1)[b()]]");
  EXPECT_EQ(shown("<launch></group></launch>"), "launch()");
  EXPECT_EQ(shown("<launch><node pkg"), "launch()[node(pkg)]");
}

TEST(LspOutline, ReadsYaml) {
  EXPECT_EQ(shown("launch:\n- arg: {name: a, default: '1, 2'}\n- group:\n    ns: b\n    children:\n    - node:\n       "
                  " pkg: \"c\"\n"
                  "        param:\n        - name: p\n          value: 1\n        - from: q\n        exec: d\n- let:\n "
                  "   name: e\n"),
            "launch()[arg(name=a default=1, 2) group(ns=b)[node(pkg=c exec=d)[param(name=p value=1) param(from=q)]] "
            "let(name=e)]");
}

TEST(LspOutline, TakesWhatIsMissingInYaml) {
  EXPECT_EQ(shown("launch:\n- node:\n    pkg: a\n    ex\n- gr\n"), "launch()[node(pkg=a ex) gr()]");
  EXPECT_EQ(shown("launch:\n  - node:\n      name: \"$(var x\n"), "launch()[node(name=$(var x)]");
  EXPECT_EQ(shown("x\n"), "x()");
  EXPECT_EQ(shown(""), "");
}

TEST(LspOutline, FindsTheInnermostElement) {
  const std::string text = "<launch><group><node/> </group></launch>";
  const Outline outline = outline_of(text);
  EXPECT_EQ(outline.element_at(text.find(" </group>")), 2);
  EXPECT_EQ(outline.element_at(text.find("</group>")), 1);
  EXPECT_EQ(outline.element_at(0), -1);
}

}  // namespace
}  // namespace launch::lsp
