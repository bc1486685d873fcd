# SPDX-License-Identifier: Apache-2.0
"""The JSON of dry runs is what its schema says: of every example, and of all that the language has."""

import json
import os
import subprocess
import unittest
from pathlib import Path

import jsonschema

LAUNCH = os.environ['LAUNCH_PROGRAM']
SOURCE = Path(os.environ['SOURCE_DIRECTORY'])


def launch(*words):
    return subprocess.run([LAUNCH, *words], capture_output=True, text=True)


class DryRunSchema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads((SOURCE / 'docs/schema/dry_run.schema.json').read_text())

    def test_the_schema_is_one_and_the_launcher_prints_it(self):
        jsonschema.Draft202012Validator.check_schema(self.schema)
        self.assertEqual(json.loads(launch('schema', 'dry-run').stdout), self.schema)

    def test_dry_runs_are_what_the_schema_says(self):
        validator = jsonschema.Draft202012Validator(self.schema)
        files = [*(SOURCE / 'launch_examples').glob('*.launch.*'),
                 *(SOURCE / 'tests/golden/triplets').glob('*.launch.*'),
                 *(SOURCE / 'tests/conformance/python').glob('*.launch.py')]
        seen = set()
        valid = 0
        for path in sorted(files):
            result = launch('--dry-run=json', path)
            if result.returncode != 0:
                continue  # some need packages of ROS 2, or arguments
            with self.subTest(path.name):
                plan = json.loads(result.stdout)
                validator.validate(plan)
                seen.update(plan)
                valid += 1
        self.assertGreater(valid, 60)
        self.assertLessEqual({'handlers', 'traces', 'composable', 'transitions'}, seen)

    def test_another_key_is_not_valid(self):
        plan = json.loads(launch('--dry-run=json', SOURCE / 'launch_examples/01_ping_pong.launch.xml').stdout)
        plan['processes'][0]['argvs'] = []
        with self.assertRaises(jsonschema.ValidationError):
            jsonschema.Draft202012Validator(self.schema).validate(plan)


if __name__ == '__main__':
    unittest.main()
