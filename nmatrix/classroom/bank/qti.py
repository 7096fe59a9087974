"""A question bank as a QTI 2.1 package: an item for each question, and a test that draws from them.

An item counts the fields that are right, and collects a feedback identifier for each number that
a known mistake gives; nothing that a person is called stands in an identifier.
"""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree import ElementTree as ET

from nmatrix.classroom.bank.package import MANIFEST, leaf, written, zipped
from nmatrix.classroom.bank.question import Bank, BankQuestion, NumberField, Numbers, decimal
from nmatrix.classroom.bank.text import allowed, asked, feedback, place
from nmatrix.classroom.words import Words
from nmatrix.lessons.exercises.exercise import LETTERS, Choice
from nmatrix.output.mathml import prose

QTI = "http://www.imsglobal.org/xsd/imsqti_v2p1"
PACKAGE = "http://www.imsglobal.org/xsd/imscp_v1p1"
MATHML = "http://www.w3.org/1998/Math/MathML"
TEST = "test.xml"
FIELD_WIDE = "12"  # characters
SCORE, COUNT, FEEDBACK, RESPONSE = "SCORE", "COUNT", "FEEDBACK", "RESPONSE"


def qti(bank: Bank, words: Words) -> bytes:
    """Write a bank as one ZIP file."""
    files: dict[str, bytes] = {}
    for same in zip(*bank.sheets, strict=True):
        for i, one in enumerate(same):
            item = _item(_identifier(one, i), one, bank.points, words)
            files[_file(_identifier(one, i))] = written(item, indented=False)
    items = list(files)
    files[TEST] = written(_test(bank))
    return zipped({MANIFEST: written(_manifest(items)), **files})


def _identifier(one: BankQuestion, sheet: int) -> str:
    return f"exercise-{one.exercise.number}-{sheet + 1:04}"


def _file(identifier: str) -> str:
    return f"items/{identifier}.xml"


def _manifest(items: list[str]) -> ET.Element:
    root = ET.Element("manifest", {"xmlns": PACKAGE, "identifier": "nmatrix-bank"})
    metadata = ET.SubElement(root, "metadata")
    leaf(metadata, "schema", "QTIv2.1 Package")
    leaf(metadata, "schemaversion", "1.0.0")
    ET.SubElement(root, "organizations")
    resources = ET.SubElement(root, "resources")
    kinds = {TEST: "imsqti_test_xmlv2p1", **dict.fromkeys(items, "imsqti_item_xmlv2p1")}
    identifiers = {name: f"r{i}" for i, name in enumerate(kinds)}
    for name, kind in kinds.items():
        attributes = {"identifier": identifiers[name], "type": kind, "href": name}
        resource = ET.SubElement(resources, "resource", attributes)
        ET.SubElement(resource, "file", {"href": name})
        for item in items if name == TEST else ():
            ET.SubElement(resource, "dependency", {"identifierref": identifiers[item]})
    return root


def _test(bank: Bank) -> ET.Element:
    """Draw one question of each exercise."""
    attributes = {"xmlns": QTI, "identifier": "nmatrix-test", "title": allowed(bank.name)}
    root = ET.Element("assessmentTest", attributes)
    modes = {"navigationMode": "nonlinear", "submissionMode": "individual"}
    part = ET.SubElement(root, "testPart", {"identifier": "part", **modes})
    for same in zip(*bank.sheets, strict=True):
        exercise = same[0].exercise
        named = {"identifier": f"section-{exercise.number}", "title": exercise.title}
        section = ET.SubElement(part, "assessmentSection", {**named, "visible": "true"})
        ET.SubElement(section, "selection", {"select": "1"})
        for i, one in enumerate(same):
            identifier = _identifier(one, i)
            reference = {"identifier": identifier, "href": _file(identifier)}
            ET.SubElement(section, "assessmentItemRef", reference)
    return root


def _item(identifier: str, one: BankQuestion, points: int, words: Words) -> ET.Element:
    root = ET.Element(
        "assessmentItem",
        {
            "xmlns": QTI,
            "identifier": identifier,
            "title": allowed(one.title),
            "adaptive": "false",
            "timeDependent": "false",
        },
    )
    if isinstance(one.form, Numbers):
        _ask_for_numbers(root, one, one.form, points, words)
    else:
        _ask_for_choice(root, one, one.form, points, words)
    return root


def _ask_for_choice(
    root: ET.Element, one: BankQuestion, choice: Choice, points: int, words: Words
) -> None:
    _declare(root, RESPONSE, "identifier", choice.letter)
    _outcome(root, SCORE, "float", points)
    _outcome(root, FEEDBACK, "identifier")
    body = _body(root, one, words)
    attributes = {"responseIdentifier": RESPONSE, "shuffle": "false", "maxChoices": "1"}
    asked_for = ET.SubElement(body, "choiceInteraction", attributes)
    for letter, option in zip(LETTERS, choice.options, strict=False):
        simple = ET.SubElement(asked_for, "simpleChoice", {"identifier": letter})
        simple.append(_fragment(prose(option.text)))
    processing = ET.SubElement(root, "responseProcessing")
    if_right = _condition(processing)
    match = ET.SubElement(if_right, "match")
    ET.SubElement(match, "variable", {"identifier": RESPONSE})
    ET.SubElement(match, "correct", {"identifier": RESPONSE})
    leaf(_set(if_right, SCORE), "baseValue", str(points), baseType="float")
    ET.SubElement(_set(processing, FEEDBACK), "variable", {"identifier": RESPONSE})
    for letter, option in zip(LETTERS, choice.options, strict=False):
        _modal(root, letter, option.because)


def _ask_for_numbers(
    root: ET.Element, one: BankQuestion, numbers: Numbers, points: int, words: Words
) -> None:
    for field in numbers.fields:
        _declare(root, _response(field), "float", decimal(field.right))
    _outcome(root, COUNT, "integer")
    _outcome(root, SCORE, "float", points)
    _outcome(root, FEEDBACK, "identifier", cardinality="multiple")
    _table(_body(root, one, words), numbers, words)
    processing = ET.SubElement(root, "responseProcessing")
    for field in numbers.fields:
        _grade(processing, field)
    share = ET.SubElement(_set(processing, SCORE), "divide")
    times = ET.SubElement(share, "product")
    ET.SubElement(times, "variable", {"identifier": COUNT})
    leaf(times, "baseValue", str(points), baseType="float")
    leaf(share, "baseValue", str(len(numbers.fields)), baseType="float")
    for field, identifier, sentence in _feedbacks(numbers, words):
        _modal(root, identifier, f"{place(field, numbers, words)}: {sentence}")


def _grade(processing: ET.Element, field: NumberField) -> None:
    """Count a field that is right, else name the feedback of the known wrong number."""
    if_right = _condition(processing)
    _equal(if_right, field, decimal(field.right))
    total = ET.SubElement(_set(if_right, COUNT), "sum")
    ET.SubElement(total, "variable", {"identifier": COUNT})
    leaf(total, "baseValue", "1", baseType="integer")
    condition = processing[-1]
    for i, wrong in enumerate(field.wrong):
        otherwise = ET.SubElement(condition, "responseElseIf")
        _equal(otherwise, field, decimal(wrong.value))
        several = ET.SubElement(_set(otherwise, FEEDBACK), "multiple")
        ET.SubElement(several, "variable", {"identifier": FEEDBACK})
        leaf(several, "baseValue", _wrong(field, i), baseType="identifier")


def _feedbacks(numbers: Numbers, words: Words) -> Iterator[tuple[NumberField, str, str]]:
    for field in numbers.fields:
        for i, wrong in enumerate(field.wrong):
            yield field, _wrong(field, i), feedback(wrong, words)


def _response(field: NumberField) -> str:
    return f"{RESPONSE}_{field.row + 1}_{field.column + 1}"


def _wrong(field: NumberField, i: int) -> str:
    return f"WRONG_{field.row + 1}_{field.column + 1}_{i + 1}"


def _declare(root: ET.Element, identifier: str, kind: str, right: str) -> None:
    attributes = {"identifier": identifier, "cardinality": "single", "baseType": kind}
    declared = ET.SubElement(root, "responseDeclaration", attributes)
    leaf(ET.SubElement(declared, "correctResponse"), "value", right)


def _outcome(
    root: ET.Element,
    identifier: str,
    kind: str,
    most: int | None = None,
    *,
    cardinality: str = "single",
) -> None:
    """Declare an outcome; a number begins at 0."""
    attributes = {"identifier": identifier, "cardinality": cardinality, "baseType": kind}
    if most is not None:
        attributes["normalMaximum"] = str(most)
    declared = ET.SubElement(root, "outcomeDeclaration", attributes)
    if kind != "identifier":
        leaf(ET.SubElement(declared, "defaultValue"), "value", "0")


def _body(root: ET.Element, one: BankQuestion, words: Words) -> ET.Element:
    body = ET.SubElement(root, "itemBody")
    body.append(_fragment(asked(one, words)))
    return body


def _table(body: ET.Element, numbers: Numbers, words: Words) -> None:
    """Lay the fields out as the matrix stands, or a vector with its letters before it."""
    rows = ET.SubElement(ET.SubElement(body, "table"), "tbody")
    for row in numbers.rows:
        line = ET.SubElement(rows, "tr")
        if numbers.coordinates:
            leaf(line, "td", f"{place(row[0], numbers, words)} =")
        for field in row:
            attributes = {"responseIdentifier": _response(field), "expectedLength": FIELD_WIDE}
            ET.SubElement(ET.SubElement(line, "td"), "textEntryInteraction", attributes)


def _condition(processing: ET.Element) -> ET.Element:
    return ET.SubElement(ET.SubElement(processing, "responseCondition"), "responseIf")


def _equal(condition: ET.Element, field: NumberField, number: str) -> None:
    off = decimal(field.tolerance)
    attributes = {"toleranceMode": "absolute", "tolerance": f"{off} {off}"}
    equal = ET.SubElement(condition, "equal", attributes)
    ET.SubElement(equal, "variable", {"identifier": _response(field)})
    leaf(equal, "baseValue", number, baseType="float")


def _set(parent: ET.Element, outcome: str) -> ET.Element:
    return ET.SubElement(parent, "setOutcomeValue", {"identifier": outcome})


def _modal(root: ET.Element, identifier: str, sentence: str) -> None:
    shown = {"outcomeIdentifier": FEEDBACK, "identifier": identifier, "showHide": "show"}
    feedback_of = ET.SubElement(root, "modalFeedback", shown)
    feedback_of.append(_fragment(f"<p>{prose(sentence)}</p>"))


def _fragment(html: str) -> ET.Element:
    """Read HTML as elements of an item; formulas keep the namespace of MathML."""
    bare = html.replace(f' xmlns="{MATHML}"', "")
    found = ET.fromstring(f"<div>{bare}</div>")
    for formula in found.iter("math"):
        formula.set("xmlns", MATHML)
    return found
