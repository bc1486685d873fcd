// SPDX-License-Identifier: Apache-2.0
// `launch schema`: what the schemas accept.
#include <gmock/gmock.h>

#include "tests/e2e/language/without_running.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

TEST_F(WithoutRunning, SchemasAcceptTheExamplesAndRefuseErrors) {
  const std::string xsd = file("launch.xsd", launch({"schema", "xsd"}).out);
  const std::string wrong = file("wrong.launch.xml", "<launch><node pkg=\"p\" exce=\"e\"/></launch>\n");
  const CommandResult refused = run_command(Command{{"xmllint", "--noout", "--schema", xsd, wrong}});
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_THAT(refused.err, HasSubstr("The attribute 'exce' is not allowed"));

  // One process for all files: to load the schema takes most of the time.
  const std::string json = file("launch.json", launch({"schema", "json"}).out);
  const std::string validate = file("validate.py",
                                    "import json, sys, yaml, jsonschema\n"
                                    "schema = json.load(open(sys.argv[1]))\n"
                                    "jsonschema.Draft7Validator.check_schema(schema)\n"
                                    "validator = jsonschema.Draft7Validator(schema)\n"
                                    "refused = [f'{path}: {error}' for path in sys.argv[2:]\n"
                                    "           for error in validator.iter_errors(yaml.safe_load(open(path)))]\n"
                                    "sys.exit('\\n'.join(refused) or 0)\n");
  const std::string wrong_yaml = file("wrong.launch.yaml", "launch:\n  - node: {pkg: p, exce: e}\n");
  const CommandResult refused_yaml = run_command(Command{{"/usr/bin/python3", validate, json, wrong_yaml}});
  EXPECT_EQ(refused_yaml.exit_code, 1);
  EXPECT_THAT(refused_yaml.err, HasSubstr("'exce' was unexpected"));

  Command xml{{"xmllint", "--noout", "--schema", xsd}};
  Command yaml{{"/usr/bin/python3", validate, json}};
  for (const auto& entry : std::filesystem::directory_iterator(EXAMPLES_DIRECTORY)) {
    const std::string path = entry.path().string();
    if (path.ends_with(".launch.xml")) {
      xml.argv.push_back(path);
    }
    if (path.ends_with(".launch.yaml")) {
      yaml.argv.push_back(path);
    }
  }
  for (const Command& all : {xml, yaml}) {
    EXPECT_GT(all.argv.size(), 20u);
    const CommandResult result = run_command(all);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
}

TEST_F(WithoutRunning, SchemasOfTheDocumentationAreUpToDate) {
  EXPECT_EQ(launch({"schema", "xsd"}).out, read_file(DOCS_DIRECTORY "/schema/launch.xsd"))
      << "./dev launch schema xsd > docs/schema/launch.xsd";
  EXPECT_EQ(launch({"schema", "json"}).out, read_file(DOCS_DIRECTORY "/schema/launch.schema.json"))
      << "./dev launch schema json > docs/schema/launch.schema.json";
}

}  // namespace
