"""A question bank for Canvas: QTI 1.2, a quiz for each sheet, a question for each number.

Canvas has no question of several numbers with feedback of their own, and its importer gives every
number that is listed full marks. So only right numbers are listed, and what known mistakes there
are stands in the general feedback.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from xml.etree import ElementTree as ET

from nmatrix.classroom.bank.package import MANIFEST, leaf, written, zipped
from nmatrix.classroom.bank.question import Bank, BankQuestion, NumberField, Numbers, decimal
from nmatrix.classroom.bank.text import allowed, asked, explained, place
from nmatrix.classroom.words import Words
from nmatrix.lessons.exercises.exercise import Choice
from nmatrix.output.mathml import prose

QTI = "http://www.imsglobal.org/xsd/ims_qtiasiv1p2"
PACKAGE = "http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1"
RESPONSE, GENERAL = "response1", "general_fb"


def canvas(bank: Bank, words: Words) -> bytes:
    """Write a bank as one ZIP file."""
    files: dict[str, bytes] = {}
    for i, sheet in enumerate(bank.sheets):
        name = f"quiz{i + 1:04}"
        files[f"{name}/{name}.xml"] = written(_quiz(name, sheet, bank, words))
    return zipped({MANIFEST: written(_manifest(list(files))), **files})


def _manifest(quizzes: list[str]) -> ET.Element:
    root = ET.Element("manifest", {"xmlns": PACKAGE, "identifier": "nmatrix_bank"})
    metadata = ET.SubElement(root, "metadata")
    leaf(metadata, "schema", "IMS Content")
    leaf(metadata, "schemaversion", "1.1.3")
    ET.SubElement(root, "organizations")
    resources = ET.SubElement(root, "resources")
    for name in quizzes:
        attributes = {"identifier": name.partition("/")[0], "type": "imsqti_xmlv1p2"}
        resource = ET.SubElement(resources, "resource", attributes)
        ET.SubElement(resource, "file", {"href": name})
    return root


def _quiz(name: str, sheet: tuple[BankQuestion, ...], bank: Bank, words: Words) -> ET.Element:
    root = ET.Element("questestinterop", {"xmlns": QTI})
    whose = " · ".join(filter(None, (bank.name, sheet[0].student)))
    assessment = ET.SubElement(root, "assessment", {"ident": name, "title": allowed(whose)})
    section = ET.SubElement(assessment, "section", {"ident": "root_section"})
    quiz = _Section(section, bank.points, words)
    for one in sheet:
        quiz.ask(one, f"{name}_exercise{one.exercise.number}")
    return root


@dataclass(frozen=True)
class _Section:
    """The questions of a quiz, each worth its share of an exercise's points."""

    root: ET.Element
    points: int
    words: Words

    def ask(self, one: BankQuestion, ident: str) -> None:
        """Add the questions of one exercise."""
        if isinstance(one.form, Choice):
            self._ask_for_choice(one, one.form, ident)
            return
        for i, field in enumerate(one.form.fields):
            self._ask_for_number(one, one.form, field, f"{ident}_{i + 1}")

    def _ask_for_choice(self, one: BankQuestion, choice: Choice, ident: str) -> None:
        text = asked(one, self.words)
        item = self._item(ident, one.title, "multiple_choice_question", Fraction(self.points), text)
        attributes = {"ident": RESPONSE, "rcardinality": "Single"}
        response = ET.SubElement(item[-1], "response_lid", attributes)
        render = ET.SubElement(response, "render_choice")
        for i, option in enumerate(choice.options):
            label = ET.SubElement(render, "response_label", {"ident": str(i + 1)})
            _material(label, prose(option.text))
        processing = _processing(item)
        for i in range(len(choice.options)):
            condition = ET.SubElement(processing, "respcondition", {"continue": "Yes"})
            _is(condition, str(i + 1))
            _show(condition, f"{i + 1}_fb")
        condition = ET.SubElement(processing, "respcondition", {"continue": "No"})
        _is(condition, str(choice.right + 1))
        leaf(condition, "setvar", "100", action="Set", varname="SCORE")
        for i, option in enumerate(choice.options):
            _feedback(item, f"{i + 1}_fb", f"<p>{prose(option.because)}</p>")

    def _ask_for_number(
        self, one: BankQuestion, numbers: Numbers, field: NumberField, ident: str
    ) -> None:
        where = place(field, numbers, self.words)
        which = f"<p><strong>{prose(self.words.which.format(place=where))}</strong></p>"
        text = asked(one, self.words) + which
        share = Fraction(self.points, len(numbers.fields))
        item = self._item(ident, f"{one.title} · {where}", "numerical_question", share, text)
        attributes = {"ident": RESPONSE, "rcardinality": "Single"}
        response = ET.SubElement(item[-1], "response_str", attributes)
        render = ET.SubElement(response, "render_fib", {"fibtype": "Decimal"})
        ET.SubElement(render, "response_label", {"ident": "answer1"})
        processing = _processing(item)
        if field.wrong:
            condition = ET.SubElement(processing, "respcondition", {"continue": "Yes"})
            ET.SubElement(ET.SubElement(condition, "conditionvar"), "other")
            _show(condition, GENERAL)
        condition = ET.SubElement(processing, "respcondition", {"continue": "No"})
        _is_near(condition, field)
        leaf(condition, "setvar", "100", action="Set", varname="SCORE")
        if field.wrong:
            _feedback(item, GENERAL, _known_mistakes(field, self.words))

    def _item(self, ident: str, title: str, kind: str, points: Fraction, text: str) -> ET.Element:
        """Begin a question, which ends in its presentation so far."""
        item = ET.SubElement(self.root, "item", {"ident": ident, "title": allowed(title)})
        metadata = ET.SubElement(ET.SubElement(item, "itemmetadata"), "qtimetadata")
        for label, entry in (("question_type", kind), ("points_possible", decimal(points))):
            pair = ET.SubElement(metadata, "qtimetadatafield")
            leaf(pair, "fieldlabel", label)
            leaf(pair, "fieldentry", entry)
        _material(ET.SubElement(item, "presentation"), f"<div>{text}</div>")
        return item


def _known_mistakes(field: NumberField, words: Words) -> str:
    """List each wrong number with the mistakes that give it."""
    lines = "".join(
        f"<li>{decimal(wrong.value)}: {prose(told)}</li>"
        for wrong in field.wrong
        for told in (" ".join(explained(one, words) for one in wrong.mistakes),)
    )
    return f"<p>{prose(words.if_wrong)}</p><ul>{lines}</ul>"


def _processing(item: ET.Element) -> ET.Element:
    processing = ET.SubElement(item, "resprocessing")
    score = {"maxvalue": "100", "minvalue": "0", "varname": "SCORE", "vartype": "Decimal"}
    ET.SubElement(ET.SubElement(processing, "outcomes"), "decvar", score)
    return processing


def _is(condition: ET.Element, answer: str) -> None:
    leaf(ET.SubElement(condition, "conditionvar"), "varequal", answer, respident=RESPONSE)


def _is_near(condition: ET.Element, field: NumberField) -> None:
    either = ET.SubElement(ET.SubElement(condition, "conditionvar"), "or")
    leaf(either, "varequal", decimal(field.right), respident=RESPONSE)
    within = ET.SubElement(either, "and")
    leaf(within, "vargte", decimal(field.right - field.tolerance), respident=RESPONSE)
    leaf(within, "varlte", decimal(field.right + field.tolerance), respident=RESPONSE)


def _show(condition: ET.Element, ident: str) -> None:
    attributes = {"feedbacktype": "Response", "linkrefid": ident}
    ET.SubElement(condition, "displayfeedback", attributes)


def _feedback(item: ET.Element, ident: str, html: str) -> None:
    feedback = ET.SubElement(item, "itemfeedback", {"ident": ident})
    _material(ET.SubElement(feedback, "flow_mat"), html)


def _material(parent: ET.Element, html: str) -> None:
    leaf(ET.SubElement(parent, "material"), "mattext", html, texttype="text/html")
