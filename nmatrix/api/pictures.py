"""Pictures for Python callers: proofs, scene files and meshes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from nmatrix.api.report import Picture
from nmatrix.api.setup import Setup
from nmatrix.enums import Effort, NormalRule, Reflection, Shading, Space, chosen, space_named
