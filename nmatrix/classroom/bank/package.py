"""A package of XML files with a manifest, as learning platforms import them: one ZIP file."""

from __future__ import annotations

from collections.abc import Mapping
from io import BytesIO
from xml.etree import ElementTree as ET
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

EPOCH = (1980, 1, 1, 0, 0, 0)  # the oldest day that a ZIP file knows: the same bytes every time
MANIFEST = "imsmanifest.xml"


def written(root: ET.Element, *, indented: bool = True) -> bytes:
    """Write a tree as a file in UTF-8; text among elements is not to be indented."""
    if indented:
        ET.indent(root, " ")
    text: bytes = ET.tostring(root, encoding="UTF-8", xml_declaration=True)
    return text + b"\n"


def zipped(files: Mapping[str, bytes]) -> bytes:
    """Pack files by their names, the same bytes for the same files.

    Examples
    --------
    >>> zipped({"a.xml": b"<a/>"}) == zipped({"a.xml": b"<a/>"})
    True
    """
    packed = BytesIO()
    with ZipFile(packed, "w") as archive:
        for name, content in files.items():
            info = ZipInfo(name, EPOCH)
            info.compress_type = ZIP_DEFLATED
            info.external_attr = 0o644 << 16
            archive.writestr(info, content)
    return packed.getvalue()


def leaf(parent: ET.Element, tag: str, text: str, **attributes: str) -> ET.Element:
    """Add an element that holds a text alone."""
    found = ET.SubElement(parent, tag, attributes)
    found.text = text
    return found
