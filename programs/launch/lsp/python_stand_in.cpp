// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/python_stand_in.hpp"

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "launcher/frontend/entity.hpp"
#include "launcher/language/action_parser.hpp"
#include "launcher/substitution/unrun_commands.hpp"
#include "programs/launch/lsp/python_values.hpp"

namespace launch::lsp {

namespace {

bool is_argument(std::string_view name) {
  return name == "DeclareLaunchArgument" || name == "DeclareBooleanLaunchArgument";
}

// Of these, the text does not tell what they set.
bool sets_anything(std::string_view name) {
  return name == "IncludeLaunchDescription" || name.starts_with("Opaque") || name.ends_with("EnvironmentVariable");
}

Attribute attribute(std::string name, std::string text, const SourceRange& where) {
  return {std::move(name),
          where,
          {Scalar{.type = Scalar::Type::kUntyped, .text = LocatedText(std::move(text), where)}, where}};
}

// <arg> or <let>
Entity setting(bool argument, std::string name, std::string value, const SourceRange& where) {
  Entity made;
  made.type_name = argument ? "arg" : "let";
  made.where = where;
  made.attributes.push_back(attribute("name", std::move(name), where));
  made.attributes.push_back(attribute(argument ? "default" : "value", std::move(value), where));
  return made;
}

}  // namespace

PythonStandIn python_stand_in(const std::shared_ptr<const SourceFile>& file, const Registry& registry,
                              const std::function<std::string(const std::string& package)>& share) {
  const PythonSource source = python_source_of(file->text());
  const PythonFileText text{share, file->path(), file->text(), source};
  auto description = std::make_shared<LaunchDescription>();
  description->file = file;
  PythonStandIn made{description};
  std::vector<Entity> settings;
  for (const PythonBrackets& call : source.brackets) {
    const std::string name = text.short_name(call);
    const bool argument = is_argument(name);
    if (!argument && name != "SetLaunchConfiguration") {
      made.may_set_more = made.may_set_more || sets_anything(name);
      continue;
    }
    const std::optional<Span> span = text.literal(call.find("name", 0));
    const std::optional<Span> value = text.literal(call.find(argument ? "default_value" : "value"));
    if (!span || file->text().find_first_of("\\$", span->begin) < span->end) {
      made.may_set_more = true;
      continue;
    }
    const auto written = [&](const Span& place) { return file->text().substr(place.begin, place.end - place.begin); };
    const bool is_plain = value && written(*value).find_first_of("\\$") == std::string::npos;
    settings.push_back(setting(argument, written(*span), is_plain ? written(*value) : std::string(kUnknownOutput),
                               {file, static_cast<std::uint32_t>(span->begin), static_cast<std::uint32_t>(span->end)}));
  }
  try {
    description->actions = ActionParser(registry).parse(std::move(settings));
  } catch (const LaunchError&) {
    made.may_set_more = true;
  }
  return made;
}

}  // namespace launch::lsp
