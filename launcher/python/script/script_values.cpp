// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/script/script_values.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <variant>

namespace launch {

namespace {

using Json = nlohmann::json;

python::Part read_part(const Json& json, const MakeScriptObject& make_object) {
  python::Part part;
  if (json.is_string()) {
    part.text = json.get<std::string>();
    return part;
  }
  part.where = read_place(json.at("place"));
  if (const auto object = json.find("object"); object != json.end()) {
    part.kind = python::Part::Kind::kObject;
    part.object = make_object(object->get<std::int64_t>());
  } else if (const auto text = json.find("text"); text != json.end()) {
    part.text = text->get<std::string>();
  } else {
    part.kind = python::Part::Kind::kCall;
    part.text = json.at("call").get<std::string>();
    for (const Json& argument : json.at("arguments")) {
      part.arguments.push_back(read_text(argument, make_object));
    }
  }
  return part;
}

double special_number(const std::string& word) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return word == "inf" ? kInfinity : word == "-inf" ? -kInfinity : std::nan("");
}

python::Value read_value(const Json& json, const MakeScriptObject& make_object) {
  switch (json.type()) {
    case Json::value_t::boolean:
      return {json.get<bool>(), {}};
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
      return {json.get<std::int64_t>(), {}};
    case Json::value_t::number_float:
      return {json.get<double>(), {}};
    case Json::value_t::array: {
      std::vector<python::Value> items;
      for (const Json& item : json) {
        items.push_back(read_value(item, make_object));
      }
      return {std::move(items), {}};
    }
    default:
      break;
  }
  if (const auto number = json.find("float"); number != json.end()) {
    return {special_number(number->get<std::string>()), {}};
  }
  python::Text text = read_text(json.at("text"), make_object);
  python::Place where = text.where;
  return {std::move(text), std::move(where)};
}

python::Entity read_entity(const Json& json, const MakeScriptObject& make_object) {
  python::Entity entity;
  entity.tag = json.at(0).get<std::string>();
  entity.where = read_place(json.at(1));
  for (const Json& attribute : json.at(2)) {
    python::Value value = read_value(attribute.at(1), make_object);
    if (!attribute.at(2).is_null()) {
      value.where = read_place(attribute.at(2));
    }
    entity.attributes.emplace_back(attribute.at(0).get<std::string>(), std::move(value));
  }
  entity.children = read_entities(json.at(3), make_object);
  if (!json.at(4).is_null()) {
    entity.object = make_object(json.at(4).get<std::int64_t>());
  }
  entity.process_name = json.at(5).get<std::string>();
  return entity;
}

Json write_value(const python::Value& value) {
  if (const auto* const list = std::get_if<std::vector<python::Value>>(&value.data)) {
    Json items = Json::array();
    for (const python::Value& item : *list) {
      items.push_back(write_value(item));
    }
    return items;
  }
  if (const auto* const text = std::get_if<python::Text>(&value.data)) {
    return text->parts.empty() ? Json(nullptr) : Json(text->parts.front().text);
  }
  if (const auto* const boolean = std::get_if<bool>(&value.data)) {
    return *boolean;
  }
  if (const auto* const whole = std::get_if<std::int64_t>(&value.data)) {
    return *whole;
  }
  return std::get<double>(value.data);
}

}  // namespace

python::Place read_place(const Json& place) {
  if (place.is_null()) {
    return {};
  }
  return {place.at(0).get<std::string>(), place.at(1).get<std::uint32_t>(), place.at(2).get<std::uint32_t>(),
          place.at(3).get<std::uint32_t>()};
}

python::Text read_text(const Json& json, const MakeScriptObject& make_object) {
  python::Text text;
  for (const Json& part : json) {
    text.parts.push_back(read_part(part, make_object));
  }
  if (!text.parts.empty()) {
    text.where = text.parts.front().where;
  }
  return text;
}

std::vector<python::Entity> read_entities(const Json& json, const MakeScriptObject& make_object) {
  std::vector<python::Entity> entities;
  for (const Json& entity : json) {
    entities.push_back(read_entity(entity, make_object));
  }
  return entities;
}

Json write_place(const python::Place& place) {
  return Json::array({place.file, place.line, place.begin, place.end});
}

Json write_element(const python::Element& element) {
  Json attributes = Json::array();
  for (const python::Element::Attribute& attribute : element.attributes) {
    attributes.push_back(Json::array({attribute.name, write_value(attribute.value), write_place(attribute.value.where),
                                      write_place(attribute.name_where), attribute.untyped}));
  }
  Json children = Json::array();
  for (const python::Element& child : element.children) {
    children.push_back(write_element(child));
  }
  return Json::array({element.tag, write_place(element.where), std::move(attributes), std::move(children),
                      element.number, element.is_item});
}

Json write_arguments(const std::vector<python::Argument>& arguments) {
  Json written = Json::array();
  for (const python::Argument& argument : arguments) {
    Json pieces = Json::array();
    for (const auto& piece : argument) {
      pieces.push_back(std::visit([](const auto& content) { return Json(content); }, piece));
    }
    written.push_back(std::move(pieces));
  }
  return written;
}

}  // namespace launch
