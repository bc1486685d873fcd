// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text/quoted_text.hpp"
#include "programs/launch/describe/descriptions.hpp"

namespace launch {

namespace {

using Json = nlohmann::ordered_json;

std::string documented(const std::string& help, bool extension, const std::string& indent) {
  return fmt::format("{0}<xs:annotation><xs:documentation>{1}{2}</xs:documentation></xs:annotation>\n", indent,
                     as_xml_text(help), extension ? " (Not known to ros2 launch.)" : "");
}

// Of a value with a substitution, nothing is known. A number is told by its first character, which refuses no number.
constexpr const char* kXmlValueTypes =
    "  <xs:simpleType name=\"boolean.value\">\n    <xs:restriction base=\"xs:string\">\n"
    "      <xs:pattern value=\"[\\s\\S]*[$]\\([\\s\\S]*"
    "|\\s*([Tt]rue|TRUE|[Ff]alse|FALSE|[Yy]es|YES|[Nn]o|NO|[Oo]n|ON|[Oo]ff|OFF|1|0)\\s*\"/>\n"
    "    </xs:restriction>\n  </xs:simpleType>\n"
    "  <xs:simpleType name=\"number.value\">\n    <xs:restriction base=\"xs:string\">\n"
    "      <xs:pattern value=\"[\\s\\S]*[$]\\([\\s\\S]*|\\s*[\\-+.0-9]\\S*\\s*\"/>\n"
    "    </xs:restriction>\n  </xs:simpleType>\n";

const char* xml_type(AttributeType type) {
  switch (type) {
    case AttributeType::kBoolean:
      return "boolean.value";
    case AttributeType::kFloat:
    case AttributeType::kInteger:
      return "number.value";
    default:
      return "xs:string";
  }
}

// The type of one element: its attributes, and in any order and number the elements that it holds.
class XmlSchema {
 public:
  explicit XmlSchema(const Registry& registry) : registry_(registry) {}

  std::string text() {
    std::string body =
        "  <xs:element name=\"launch\">\n    <xs:complexType>\n"
        "      <xs:group ref=\"actions\" minOccurs=\"0\" maxOccurs=\"unbounded\"/>\n"
        "      <xs:attribute name=\"version\" type=\"xs:string\"/>\n"
        "      <xs:attribute name=\"deprecated\" type=\"xs:string\"/>\n"
        "    </xs:complexType>\n  </xs:element>\n"
        "  <xs:group name=\"actions\">\n    <xs:choice>\n";
    for (const auto& [tag, type] : registry_.types()) {
      body += fmt::format("      <xs:element name=\"{0}\" type=\"{0}\">\n{1}      </xs:element>\n", tag,
                          documented(type.help, type.extension, "        "));
    }
    body += "    </xs:choice>\n  </xs:group>\n";
    for (const auto& [tag, type] : registry_.types()) {
      body += complex_type(tag, type.attributes, type.items, type.holds_actions, true, nullptr);
    }
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<!-- Made by `launch schema xsd`. -->\n"
           "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">\n" +
           body + item_types_ + kXmlValueTypes + "</xs:schema>\n";
  }

 private:
  std::string complex_type(const std::string& name, const std::vector<AttributeSpec>& attributes,
                           const std::vector<ItemSpec>& items, bool holds_actions, bool has_condition,
                           const ItemSpec* own) {
    std::string text = fmt::format("  <xs:complexType name=\"{}\">\n", name);
    text += "    <xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">\n";
    for (const ItemSpec& item : items) {
      if (holds_actions && registry_.find(item.tag) != nullptr) {
        continue;  // one name can have only one type in one place; the type of the action is the wider one
      }
      const std::string type = name + "." + item.tag;
      text += fmt::format("      <xs:element name=\"{}\" type=\"{}\">\n{}      </xs:element>\n", item.tag, type,
                          documented(item.help, item.extension, "        "));
      item_types_ += complex_type(type, item.attributes, item.items, false, item.has_condition, &item);
    }
    if (own != nullptr && own->recursive) {
      text += fmt::format("      <xs:element name=\"{}\" type=\"{}\"/>\n", own->tag, name);
    }
    if (holds_actions) {
      text += "      <xs:group ref=\"actions\"/>\n";
    }
    text += "    </xs:choice>\n";
    for (const AttributeSpec& attribute : attributes) {
      text += fmt::format("    <xs:attribute name=\"{}\" type=\"{}\"{}>\n{}    </xs:attribute>\n", attribute.name,
                          xml_type(attribute.type), attribute.required ? " use=\"required\"" : "",
                          documented(attribute.help, attribute.extension, "      "));
    }
    for (const char* const condition : {"if", "unless"}) {
      const bool declared = std::any_of(attributes.begin(), attributes.end(),
                                        [&](const AttributeSpec& attribute) { return attribute.name == condition; });
      if (has_condition && !declared) {
        text += fmt::format("    <xs:attribute name=\"{}\" type=\"xs:string\"/>\n", condition);
      }
    }
    return text + "  </xs:complexType>\n";
  }

  const Registry& registry_;
  std::string item_types_;
};

std::string description_of(const std::string& help, bool extension) {
  return help + (extension ? " (Not known to ros2 launch.)" : "");
}

void add_attributes(Json& schema, const std::vector<AttributeSpec>& attributes) {
  Json required = Json::array();
  for (const AttributeSpec& attribute : attributes) {
    Json property;
    property["description"] = description_of(attribute.help, attribute.extension);
    if (attribute.type == AttributeType::kBoolean) {
      property["type"] = {"boolean", "string"};
    } else if (attribute.type == AttributeType::kFloat) {
      property["type"] = {"number", "string"};
    } else if (attribute.type == AttributeType::kInteger) {
      property["type"] = {"integer", "string"};
    } else if (attribute.type == AttributeType::kWords) {
      property["type"] = {"string", "array"};
    } else if (attribute.type == AttributeType::kText && attribute.extension) {
      property["type"] = {"string", "number"};
    } else if (attribute.type != AttributeType::kParameter) {
      property["type"] = "string";
    }
    schema["properties"][attribute.name] = std::move(property);
    if (attribute.required) {
      required.push_back(attribute.name);
    }
  }
  if (!required.empty()) {
    schema["required"] = std::move(required);
  }
}

void add_conditions(Json& schema) {
  for (const char* const condition : {"if", "unless"}) {
    if (!schema["properties"].contains(condition)) {
      schema["properties"][condition] = {{"type", "string"}};
    }
  }
}

Json item_schema(const ItemSpec& item, const std::string& path, Json& definitions) {
  Json schema = {{"type", "object"},
                 {"description", description_of(item.help, item.extension)},
                 {"properties", Json::object()},
                 {"additionalProperties", false}};
  add_attributes(schema, item.attributes);
  if (item.has_condition) {
    add_conditions(schema);
  }
  for (const ItemSpec& nested : item.items) {
    const std::string name = path + "." + nested.tag;
    definitions[name] = item_schema(nested, name, definitions);
    schema["properties"][nested.tag] = {{"type", "array"}, {"items", {{"$ref", "#/definitions/" + name}}}};
  }
  if (item.recursive) {
    schema["properties"][item.tag] = {{"type", "array"}, {"items", {{"$ref", "#/definitions/" + path}}}};
  }
  return schema;
}

// What stands in a list of children: an action, or an item of the tag.
Json child_schema(const std::string& tag, const std::vector<ItemSpec>& items) {
  const Json action = {{"$ref", "#/definitions/action"}};
  if (items.empty()) {
    return action;
  }
  Json item = {{"type", "object"}, {"minProperties", 1}, {"maxProperties", 1}, {"additionalProperties", false}};
  for (const ItemSpec& spec : items) {
    item["properties"][spec.tag] = {{"$ref", "#/definitions/" + tag + "." + spec.tag}};
  }
  return {{"anyOf", Json::array({action, item})}};
}

}  // namespace

std::string xml_schema(const Registry& registry) {
  return XmlSchema(registry).text();
}

std::string json_schema(const Registry& registry) {
  Json definitions = Json::object();
  Json action = {{"type", "object"},
                 {"minProperties", 1},
                 {"maxProperties", 1},
                 {"additionalProperties", false},
                 {"properties", Json::object()}};
  for (const auto& [tag, type] : registry.types()) {
    Json schema = {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
    add_attributes(schema, type.attributes);
    add_conditions(schema);
    for (const ItemSpec& item : type.items) {
      const std::string name = tag + "." + item.tag;
      definitions[name] = item_schema(item, name, definitions);
      schema["properties"][item.tag] = {{"type", "array"}, {"items", {{"$ref", "#/definitions/" + name}}}};
    }
    Json either = schema;
    if (type.holds_actions) {
      const Json actions = {{"type", "array"}, {"items", child_schema(tag, type.items)}};
      schema["properties"]["children"] = actions;
      if (!type.may_hold_none) {
        schema["required"].push_back("children");
      }
      either = {{"anyOf", Json::array({schema, actions})}};
    }
    either["description"] = description_of(type.help, type.extension);
    definitions[tag] = std::move(either);
    action["properties"][tag] = {{"$ref", "#/definitions/" + tag}};
  }
  definitions["action"] = std::move(action);
  Json root;
  root["$schema"] = "http://json-schema.org/draft-07/schema#";
  root["title"] = "YAML launch file";
  root["$comment"] = "Made by `launch schema json`.";
  root["type"] = "object";
  root["required"] = {"launch"};
  root["additionalProperties"] = false;
  // The root may be a mapping, too, with its attributes and `children`.
  root["properties"]["launch"] = {{"if", {{"type", "array"}}},
                                  {"then", {{"items", {{"$ref", "#/definitions/action"}}}}},
                                  {"else", {{"type", "object"}}}};
  root["definitions"] = std::move(definitions);
  return root.dump(2) + "\n";
}

}  // namespace launch
