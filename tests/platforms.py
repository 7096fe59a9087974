"""What learning platforms make of a question bank: each reads a file and grades typed numbers.

Each is written from the documentation of its format and knows nothing of the writers.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from html import unescape
from io import BytesIO
from xml.etree import ElementTree as ET
from zipfile import ZipFile

Typed = Mapping[int, float]  # the number in each field, counted from 0 row by row


@dataclass
class Graded:
    """What a platform says of one question: its points from 0 to 1, field by field, and words."""

    score: float
    right: dict[int, bool] = field(default_factory=dict)
    feedback: dict[int, str] = field(default_factory=dict)


# --- Moodle ---------------------------------------------------------------------------------------

NUMBER = r"-?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:[eE][-+]?[0-9]+)?"
ALTERNATIVE = (
    r"(?:=|%-?[0-9]+(?:[.,][0-9]*)?%)?.+?(?<!\\|&)(?<!&amp;)(?=[~#}]|$)"
    r"(?:#.*?(?<!\\)(?=[~}]|$))?"
)
CLOZE = re.compile(rf"\{{([0-9]*):(?:NUMERICAL|NM):({ALTERNATIVE}(?:~{ALTERNATIVE})*)\}}", re.S)
ANSWER = re.compile(
    r"~?(=|%(-?[0-9]+(?:[.,][0-9]*)?)%)?(.+?)(?<!\\|&)(?<!&amp;)(?=[~#}]|$)"
    r"(?:#(.*?)(?<!\\)(?=[~}]|$))?",
    re.S,
)
NUMERICAL = re.compile(rf"^({NUMBER})(?::({NUMBER}))?$")


def moodle_questions(content: bytes) -> list[ET.Element]:
    return [one for one in ET.fromstring(content) if one.get("type") != "category"]


def moodle_grades(question: ET.Element, typed: Typed) -> Graded:
    """Grade a cloze question: of each field the first answer within its tolerance counts."""
    text = question.findtext("questiontext/text") or ""
    found = Graded(0.0)
    fields = list(CLOZE.finditer(text))
    total = 0.0
    for i, one in enumerate(fields):
        weight = float(one[1] or 1)
        total += weight
        credit, said = 0.0, ""
        for answer in ANSWER.finditer(one[2]):
            number = NUMERICAL.match(answer[3])
            assert number is not None, answer[3]
            fraction = 1.0 if answer[1] == "=" else float(answer[2] or 0) / 100
            if abs(typed[i] - float(number[1])) <= float(number[2] or 0) + 1e-12:
                credit, said = fraction, unescape(unescape(answer[4] or ""))
                break
        found.right[i], found.feedback[i] = credit == 1.0, said
        found.score += weight * credit
    found.score /= total
    return found


def moodle_choice(question: ET.Element, chosen: int) -> Graded:
    answer = question.findall("answer")[chosen]
    said = answer.findtext("feedback/text") or ""
    return Graded(float(answer.get("fraction", "0")) / 100, feedback={0: said})


# --- QTI 2.1 --------------------------------------------------------------------------------------

Q = "{http://www.imsglobal.org/xsd/imsqti_v2p1}"


def unpacked(content: bytes) -> dict[str, bytes]:
    with ZipFile(BytesIO(content)) as archive:
        assert archive.testzip() is None
        return {name: archive.read(name) for name in archive.namelist()}


@dataclass
class QtiItem:
    """One item: its variables, and the rules that are run over them."""

    root: ET.Element

    @property
    def responses(self) -> list[str]:
        return [one.get("identifier", "") for one in self.root.iter(f"{Q}responseDeclaration")]

    def grades(self, given: Mapping[str, object]) -> tuple[float, set[str], dict[str, object]]:
        """Run the response processing; the score, the feedback shown, and all outcomes."""
        self.values: dict[str, object] = dict(given)
        self.corrects = {
            one.get("identifier", ""): one.findtext(f"{Q}correctResponse/{Q}value")
            for one in self.root.iter(f"{Q}responseDeclaration")
        }
        for one in self.root.iter(f"{Q}outcomeDeclaration"):
            value = one.findtext(f"{Q}defaultValue/{Q}value")
            self.values[one.get("identifier", "")] = None if value is None else float(value)
        processing = self.root.find(f"{Q}responseProcessing")
        assert processing is not None
        self._run(processing)
        score = self.values["SCORE"]
        assert isinstance(score, float)
        return score, {said for _, said in self._shown()}, self.values

    def _shown(self) -> Iterator[tuple[str, str]]:
        for modal in self.root.iter(f"{Q}modalFeedback"):
            outcome = self.values[modal.get("outcomeIdentifier", "")]
            held = outcome if isinstance(outcome, tuple) else (outcome,)
            if modal.get("identifier") in held:
                yield modal.get("identifier", ""), " ".join("".join(modal.itertext()).split())

    def _run(self, rules: ET.Element) -> None:
        for rule in rules:
            if rule.tag == f"{Q}setOutcomeValue":
                self.values[rule.get("identifier", "")] = self._value(rule[0])
            elif rule.tag == f"{Q}responseCondition":
                for branch in rule:
                    if branch.tag == f"{Q}responseElse" or self._value(branch[0]) is True:
                        self._run(branch)
                        break

    def _value(self, e: ET.Element) -> object:  # noqa: PLR0911  # one for each kind of expression
        tag = e.tag.removeprefix(Q)
        if tag == "baseValue":
            return float(e.text or "") if e.get("baseType") in ("float", "integer") else e.text
        if tag == "variable":
            return self.values.get(e.get("identifier", ""))
        if tag == "correct":
            return self.corrects[e.get("identifier", "")]
        parts = [self._value(one) for one in e]
        if tag == "multiple":
            held = [one if isinstance(one, tuple) else (one,) for one in parts if one is not None]
            return tuple(x for one in held for x in one)
        if any(one is None for one in parts):
            return None
        if tag == "match":
            return parts[0] == parts[1]
        numbers = [float(one) for one in parts]  # type: ignore[arg-type]
        if tag == "equal":
            below, above = map(float, e.get("tolerance", "").split())
            first, second = numbers
            return first - below - 1e-12 <= second <= first + above + 1e-12
        if tag == "sum":
            return sum(numbers)
        if tag == "product":
            return numbers[0] * numbers[1]
        assert tag == "divide"
        return numbers[0] / numbers[1]


# --- Canvas, QTI 1.2 ------------------------------------------------------------------------------

C = "{http://www.imsglobal.org/xsd/ims_qtiasiv1p2}"


def canvas_items(content: bytes) -> list[list[ET.Element]]:
    """The items of each quiz that the manifest names."""
    files = unpacked(content)
    manifest = ET.fromstring(files["imsmanifest.xml"])
    names = [one.get("href", "") for one in manifest.iter() if one.tag.endswith("}file")]
    return [list(ET.fromstring(files[name]).iter(f"{C}item")) for name in names]


def canvas_kind(item: ET.Element) -> str:
    return _metadata(item)["question_type"]


def canvas_points(item: ET.Element) -> float:
    return float(_metadata(item)["points_possible"])


def _metadata(item: ET.Element) -> dict[str, str]:
    return {
        one.findtext(f"{C}fieldlabel") or "": one.findtext(f"{C}fieldentry") or ""
        for one in item.iter(f"{C}qtimetadatafield")
    }


def canvas_is_right(item: ET.Element, typed: str) -> bool:
    """Grade as the importer reads it: every listed answer, whatever its score, counts in full."""
    for condition in item.iter(f"{C}respcondition"):
        if condition.find(f"{C}setvar") is None:
            continue
        if canvas_kind(item) == "multiple_choice_question":
            return condition.findtext(f"{C}conditionvar/{C}varequal") == typed
        low = float(next(condition.iter(f"{C}vargte")).text or "")
        high = float(next(condition.iter(f"{C}varlte")).text or "")
        return low - 1e-12 <= float(typed) <= high + 1e-12
    raise AssertionError("no right answer is listed")
