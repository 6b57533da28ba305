# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the version from CMakeLists.txt, which pyproject.toml cannot do, or from PKG-INFO in an archive made by pip's tools."""
import pathlib
import re

import setuptools

home = pathlib.Path(__file__).resolve().parent
text = next(file.read_text() for file in (home / "PKG-INFO", home / "../../CMakeLists.txt") if file.exists())
version = re.search(r"^(?:Version: |project\(grseg VERSION )(\S+)", text, re.MULTILINE)[1]
setuptools.setup(version=version, license="GPL-3.0-or-later")
