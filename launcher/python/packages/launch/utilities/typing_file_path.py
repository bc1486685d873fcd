# SPDX-License-Identifier: Apache-2.0
"""A type hint: what names a file."""

import os

FilePath = str | bytes | os.PathLike
