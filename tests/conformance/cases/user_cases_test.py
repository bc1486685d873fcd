# SPDX-License-Identifier: Apache-2.0
"""
All cases that users of ROS 2 have reported hold. Their folder is not part of the repository: USER_CASES names it, or it is
shared/cases beside the checkout.
"""

import os
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])
CASES = Path(os.environ.get('USER_CASES', SOURCE.parent / 'shared/cases'))


class UserCases(unittest.TestCase):

    def test_all_of_them_are_right(self):
        if not (CASES / 'INDEX.tsv').exists():
            self.skipTest('skipped, because the cases are not beside the checkout; USER_CASES can name their folder')
        done = subprocess.run([sys.executable, '-B', str(Path(__file__).with_name('check_cases.py')), '--cases', str(CASES),
                               '--build', os.environ['BUILD_DIRECTORY']], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, check=False)
        print(done.stdout)
        self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == '__main__':
    unittest.main()
