# SPDX-License-Identifier: Apache-2.0
"""A type hint: what names a file."""

import os
from typing import Union

FilePath = Union[str, bytes, os.PathLike]
