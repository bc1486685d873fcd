// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/frontend/entity_test_support.hpp"

namespace launch {
namespace {

TEST(XmlFrontend, GivesElementsAttributesAndTheirPlaces) {
  const Entity root = xml("<?xml version=\"1.0\"?>\n<launch>\n  <node pkg='demo' exec=\"talker\"/>\n</launch>\n");
  EXPECT_EQ(root.type_name, "launch");
  ASSERT_EQ(root.children.size(), 1U);
  const Entity& node = root.children[0];
  EXPECT_EQ(node.type_name, "node");
  EXPECT_EQ(to_string(node.where), "t.launch.xml:3:4");
  EXPECT_EQ(raw(node.where), "node");
  ASSERT_EQ(node.attributes.size(), 2U);
  EXPECT_EQ(raw(node.attributes[1].name_where), "exec");
  EXPECT_EQ(raw(node.attributes[1].value.where), "talker");
  EXPECT_EQ(node.attributes[1].value.scalar()->type, Scalar::Type::kUntyped);
  EXPECT_TRUE(node.has_children_list);
}

TEST(XmlFrontend, DecodesEntitiesAndKeepsTheirPlaces) {
  const Entity root = xml("<launch><log message=\"a&quot;&lt;&#65;&#x20AC;&amp;b\"/></launch>");
  const Attribute& message = root.children[0].attributes[0];
  const LocatedText& text = message.value.scalar()->text;
  EXPECT_EQ(text.text(), "a\"<A\xE2\x82\xAC&b");
  EXPECT_EQ(raw(text.range(1, 1)), "&quot;");
  EXPECT_EQ(raw(text.range(3, 1)), "&#65;");
  EXPECT_EQ(raw(text.range(text.text().size() - 1, 1)), "b");
}

TEST(XmlFrontend, NormalisesWhiteSpaceInAttributes) {
  const Entity root = xml("<launch><log message=\"a\tb\r\nc\nd&#10;&#9;e\"/></launch>");
  EXPECT_EQ(text_of(root.children[0], "message"), "a b c d\n\te");
}

TEST(XmlFrontend, ReadsAttributesOverSeveralLines) {
  const Entity root = xml("<launch>\n<log\n  message = \"a\n$(var x)\"\n/></launch>");
  const LocatedText& text = root.children[0].attributes[0].value.scalar()->text;
  EXPECT_EQ(text.text(), "a $(var x)");
  EXPECT_EQ(to_string(text.range(2, 8)), "t.launch.xml:4:1");
}

TEST(XmlFrontend, IgnoresTextCommentsCdataAndProcessingInstructions) {
  const Entity root =
      xml("\xEF\xBB\xBF<?xml version='1.0' encoding='utf-8' standalone='yes'?>\n"
          "<!DOCTYPE launch [ <!ELEMENT launch (x > y)> <!-- ] --> ]>\n"
          "<?xml-model href='x'?>\n"
          "<!-- <node/> -->\n"
          "<launch> text &amp; <![CDATA[ <node> & ]]> <?tool <x> ?> <!-- - - --> <log message='m'/> </launch>\n"
          "<!-- after --> <?tool?>\n");
  ASSERT_EQ(root.children.size(), 1U);
  EXPECT_EQ(raw(root.children[0].where), "log");
}

TEST(XmlFrontend, ReadsNamespacesAsExpatDoes) {
  const Entity root =
      xml("<launch xmlns='urn:a' xmlns:x='urn:x' x:y='1'><group xmlns:z='urn:z'><log z:a='1' xml:lang='en'/></group>"
          "</launch>");
  EXPECT_EQ(root.attributes.size(), 1U) << "declarations are no attributes";
  EXPECT_EQ(text_of(root.children[0].children[0], "z:a"), "1");
}

TEST(XmlFrontend, ReadsLatin1WhenTheDeclarationSaysSo) {
  const Entity root = xml("<?xml version='1.0' encoding='ISO-8859-1'?><launch><log message='gr\xFCn'/></launch>");
  EXPECT_EQ(text_of(root.children[0], "message"), "gr\xC3\xBCn");
}

TEST(XmlFrontend, ChecksNestingDepthBeforeTheParserDoes) {
  const auto nested = [](int depth) {
    std::string text = "<launch>";
    for (int i = 1; i < depth; ++i) {
      text += "<group>";
    }
    for (int i = 1; i < depth; ++i) {
      text += "</group>";
    }
    return text + "</launch>";
  };
  EXPECT_NO_THROW(xml(nested(90)));
  EXPECT_THROW(
      {
        try {
          xml(nested(91));
        } catch (const LaunchError& error) {
          EXPECT_EQ(error.diagnostics().front().message, "elements are nested more than 90 levels deep");
          throw;
        }
      },
      LaunchError);
}

TEST(XmlFrontend, CountsEachLineEndInAValue) {
  const Entity root = xml("<launch><log message='a\n\rb\r\nc\n\r\nd\re' name='$(x)'/></launch>");
  EXPECT_EQ(text_of(root.children[0], "message"), "a  b c  d e");
  const LocatedText& text = root.children[0].find("message")->value.scalar()->text;
  EXPECT_EQ(raw(text.range(text.text().find('d'), 1)), "d");
  EXPECT_EQ(raw(root.children[0].find("name")->value.where), "$(x)");
}

TEST(XmlFrontend, KeepsPlacesBehindWhatTheParserDoesNotSee) {
  const Entity root =
      xml("<?xml version='1.0' encoding='latin1'?><!DOCTYPE a [<!ENTITY b 'c>'>]><launch><?p <x a='>'?>"
          "<!-- <log a='\xE4'/> --><log message='\xE4&#10;&lt;&#xE4;$(x)'/></launch>");
  const LocatedText& text = root.children.at(0).find("message")->value.scalar()->text;
  EXPECT_EQ(text.text(), "\xC3\xA4\n<\xC3\xA4$(x)");
  EXPECT_EQ(raw(text.range(2, 1)), "&#10;");
  EXPECT_EQ(raw(text.range(text.text().find('$'), 4)), "$(x)");
}

TEST(XmlFrontend, KnowsTheEntitiesOfTheDoctype) {
  const Entity root =
      xml("<!DOCTYPE launch [ <!-- <!ENTITY a 'no'> --> <!ENTITY a \"x\ny &lt; &#x41;\"> <!ENTITY a 'second'>\n"
          "<!ENTITY b '&a;&a;'> <!ENTITY % c 'no'> <!ENTITY self '&self;'> <!ENTITY node '<node/>'> ]>\n"
          "<launch><log message='1&a;2 &b; $(x)'/></launch>");
  const LocatedText& text = root.children.at(0).find("message")->value.scalar()->text;
  EXPECT_EQ(text.text(), "1x y < A2 x y < Ax y < A $(x)");
  EXPECT_EQ(raw(text.range(1, 1)), "&a;");
  EXPECT_EQ(raw(text.range(text.text().find('$'), 4)), "$(x)");
  for (const char* const name : {"c", "self", "node", "other"}) {
    EXPECT_THROW(
        xml(fmt::format("<!DOCTYPE launch [<!ENTITY self '&self;'><!ENTITY node '<node/>'><!ENTITY other SYSTEM 'f'>"
                        "<!ENTITY % c 'x'>]><launch><log message='&{};'/></launch>",
                        name)),
        LaunchError)
        << name;
  }
}

// Ten names that each stand for ten of another one.
TEST(XmlFrontend, EntitiesOfEntitiesAreNoWayToFillTheMemory) {
  std::string doctype = "<!DOCTYPE launch [<!ENTITY e0 'aaaaaaaaaa'>";
  for (int i = 1; i < 10; ++i) {
    doctype += fmt::format("<!ENTITY e{} '", i);
    for (int k = 0; k < 10; ++k) {
      doctype += fmt::format("&e{};", i - 1);
    }
    doctype += "'>";
  }
  EXPECT_THROW(xml(doctype + "]><launch><log message='&e9;'/></launch>"), LaunchError);
}

TEST(XmlFrontend, RefusesWhatExpatRefuses) {
  for (const char* text : {
           "<launch/><launch/>",
           "<launch/>text",
           "text<launch/>",
           "<launch><log message='a<b'/></launch>",
           "<launch><log message='a' message='b'/></launch>",
           "<launch><log message='&undefined;'/></launch>",
           "<launch><log message='a & b'/></launch>",
           "<launch><log message='&#0;'/></launch>",
           "<launch><log message='&#xD800;'/></launch>",
           "<launch><log message=a/></launch>",
           "<launch><log message/></launch>",
           "<launch><log a='1'b='2'/></launch>",
           "<launch><log></launch></log>",
           "<launch></launch",
           "<launch",
           "<launch><!-- a -- b --></launch>",
           "<launch><!-- a --->\n</launch>",
           "<launch><!-- a </launch>",
           "<launch>a ]]> b</launch>",
           "<launch><![CDATA[ a </launch>",
           "<launch>&nbsp;</launch>",
           "<launch><?xml version='1.0'?></launch>",
           " <?xml version='1.0'?><launch/>",
           "<?xml?><launch/>",
           "<?xml encoding='utf-8'?><launch/>",
           "<?xml version='1.0' standalone='no' encoding='utf-8'?><launch/>",
           "<launch/><!DOCTYPE launch>",
           "<!DOCTYPE launch <launch/>",
           "<launch>< log/></launch>",
           "<launch><1/></launch>",
           "<launch><a:b/></launch>",
           "<launch></ launch>",
           "<launch/></launch>",
           "<launch></launch></launch><log></log>",
           "<launch/></launch><log>",
           "<!-- nothing -->",
           "<?xml version='1.0' encoding='latin1'?><launch>\x01</launch>",
           "<launch></launch x='1'>",
           "<![CDATA[ ]]><launch/>",
           "<launch><? pi ?></launch>",
           "<launch><!ELEMENT></launch>",
       }) {
    EXPECT_NE(load_error(file_of("t.launch.xml", text)), "") << text;
  }
}

TEST(XmlFrontend, ReadsManyActionsInLinearTime) {
  // A quadratic step would need minutes for these 2 MB.
  std::string text = "<launch>\n";
  for (int i = 0; i < 20'000; ++i) {
    text += "  <let name=\"a\" value=\"&quot;$(var x)&quot;\"/>\n  <executable cmd=\"sleep 1\" output=\"screen\"/>\n";
  }
  EXPECT_EQ(xml(text + "</launch>").children.size(), 40'000U);
}

}  // namespace
}  // namespace launch
