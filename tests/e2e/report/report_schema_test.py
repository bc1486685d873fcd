# SPDX-License-Identifier: Apache-2.0
"""
The JSON of `launch report` is what its schemas say, and docs/report_format.md names every key of a report. The trace is
the example system of tests/support/trace_writer/example_system.hpp.
"""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import jsonschema

DOCS = Path(os.environ['SOURCE_DIRECTORY']) / 'docs'


def keys_of(value):
    """All keys of objects within a value of JSON."""
    if isinstance(value, dict):
        return set(value).union(*map(keys_of, value.values()))
    return set().union(*map(keys_of, value)) if isinstance(value, list) else set()


class ReportSchemaTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads((DOCS / 'schema' / 'report.schema.json').read_text())
        with tempfile.TemporaryDirectory() as folder:
            trace = Path(folder) / 'example'
            subprocess.run([os.environ['WRITE_EXAMPLE_TRACE'], trace, '100'], check=True)
            report = subprocess.run([os.environ['LAUNCH_REPORT'], trace, '--json'], check=True, stdout=subprocess.PIPE)
            base = Path(folder) / 'base.json'
            subprocess.run([os.environ['LAUNCH_REPORT'], trace, '--save-baseline', base], check=True, stdout=subprocess.DEVNULL)
            cls.baseline = json.loads(base.read_text())
            # Callbacks took longer then.
            for one in cls.baseline['runs'][0]['measurements']:
                if one['kind'] in ('callback', 'chain'):
                    one['samples_ns'] = [sample + 20_000_000 for sample in one['samples_ns']]
            base.write_text(json.dumps(cls.baseline))
            comparison = subprocess.run([os.environ['LAUNCH_REPORT'], trace, '--baseline', base, '--json'],
                                        check=True, stdout=subprocess.PIPE)
            cls.comparison = json.loads(comparison.stdout)
        cls.report = json.loads(report.stdout)

    def test_the_schema_is_one(self):
        jsonschema.Draft202012Validator.check_schema(self.schema)

    def test_a_report_is_what_the_schema_says(self):
        jsonschema.Draft202012Validator(self.schema).validate(self.report)
        for key in ('callbacks', 'topics', 'subscriptions', 'executors', 'chains', 'lifecycle', 'findings', 'unmatched'):
            self.assertTrue(self.report[key], key)

    def test_a_baseline_and_a_comparison_are_what_their_schemas_say(self):
        for name, value in (('baseline', self.baseline), ('comparison', self.comparison)):
            with self.subTest(name):
                schema = json.loads((DOCS / 'schema' / f'{name}.schema.json').read_text())
                jsonschema.Draft202012Validator.check_schema(schema)
                jsonschema.Draft202012Validator(schema).validate(value)
        self.assertEqual({change['kind'] for change in self.comparison['changes']}, {'callback', 'chain'})

    def test_the_schema_has_every_key(self):
        def check(value, schema, place):
            schema = self.schema['$defs']['durations'] if '$ref' in schema else schema
            if isinstance(value, dict) and schema.get('type') == 'object':
                self.assertEqual(set(value) - set(schema['properties']), set(), place)
                for key, entry in value.items():
                    check(entry, schema['properties'][key], f'{place}/{key}')
            elif isinstance(value, list) and 'items' in schema:
                for entry in value:
                    check(entry, schema['items'], place)
        check(self.report, self.schema, '')

    def test_the_page_names_every_key(self):
        named = set(re.findall(r'`([a-z0-9_]+)`', (DOCS / 'report_format.md').read_text()))
        self.assertEqual(keys_of(self.report) - named, set())


if __name__ == '__main__':
    unittest.main()
