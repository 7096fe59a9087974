"""One file for a whole class: a question bank for a learning platform, or all sheets to print."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from nmatrix.cli.shared_options import whole_number
from nmatrix.cli.show import progress
from nmatrix.errors import IllegalValueError, counted
from nmatrix.output.files import kind_of, refuse_existing, write_file
from nmatrix.output.pages.document import PageFormat
from nmatrix.reading.records import records
from nmatrix.report import Report, Text, Verdict
from nmatrix.samples import file_or_sample

if TYPE_CHECKING:
    from nmatrix.classroom.bank.write import BankFormat
    from nmatrix.classroom.handout import HandoutPlan
    from nmatrix.classroom.roster import Student
    from nmatrix.cli.handout import HandoutOptions
    from nmatrix.cli.scene_options import OptionGroups
    from nmatrix.cli.sheet_options import SheetOptions
    from nmatrix.lessons.exercises.scheme import Sheet

MOST_VARIANTS = 1000


def class_list(roster: str) -> tuple[tuple[Student, ...], tuple[str, ...]]:
    """Read the students of a class, with what is to be said of how they were read."""
    from nmatrix.classroom.roster import COLUMN, students

    found = records(str(file_or_sample(roster)), (COLUMN,))
    return students(found.rows, roster), found.remarks


def write_bank(
    platform: BankFormat, options: HandoutOptions, groups: OptionGroups, sheet: SheetOptions
) -> Report:
    """Write the exercises of a class, or of some variants, as one file for a learning platform."""
    from nmatrix.classroom.bank.question import Bank, questions
    from nmatrix.classroom.bank.write import write
    from nmatrix.classroom.words import WORDS

    for given, is_given, why in (
        ("--topics", options.topics not in (None, "exercises"), "a bank holds exercises"),
        ("--key", options.key, "a platform grades by itself"),
        ("a scene", groups.is_given, "exercises have numbers of their own"),
    ):
        if is_given:
            raise IllegalValueError(f"{given} with --to {platform}", why, "leave it out")
    path = Path(options.output or f"{options.usual_name}{platform.ending}")
    kind_of(path, {platform.ending: platform})
    refuse_existing([path], force=options.force)
    count, points = options.count(), options.points_of_each() or 1
    sheets, remarks = sheets_of(options, sheet)
    asked = tuple(
        questions(one, count) for one in progress(sheets, len(sheets), "writing questions")
    )
    name = " ".join((options.title or "").split()) or f"nmatrix, seed {sheets[0].seed}"
    bank = write(Bank(name, asked, points), platform, WORDS[options.language])
    write_file(path, bank, force=options.force)
    what = f"{counted(count, 'exercise')} each for {counted(len(sheets), 'sheet')}."
    blocks = (Verdict(f"Written: {path}"), Text(what), Text(platform.how_to_import))
    return Report("handout", {"files": [str(path)]}, blocks, (*remarks, *platform.limits))


def sheets_of(options: HandoutOptions, sheet: SheetOptions) -> tuple[list[Sheet], tuple[str, ...]]:
    """List whose exercises stand in a bank: a class, some variants, or one student."""
    from nmatrix.lessons.exercises.scheme import Sheet

    if options.roster is not None and options.variants is not None:
        raise IllegalValueError(
            "--variants with --roster", "each student has a variant", "leave one of them out"
        )
    if options.roster is not None:
        seed, salt = sheet.of_a_class("--roster")
        everyone, remarks = class_list(options.roster)
        return [Sheet(seed, one.name, salt) for one in everyone], remarks
    if options.variants is None:
        return [sheet.identity], ()
    seed, salt = sheet.of_a_class("--variants")
    why = f"a bank has 1 to {MOST_VARIANTS}"
    count = whole_number(options.variants, "--variants", range(1, MOST_VARIANTS + 1), 20, why)
    return [Sheet(seed, f"variant {i + 1}", salt) for i in range(count)], ()


def write_merged(
    plan: HandoutPlan, everyone: Sequence[Student], options: HandoutOptions, sheet: SheetOptions
) -> list[Path]:
    """Write the sheets of a class as one PDF, and their keys as another."""
    from nmatrix.classroom.handout import handout as sheet_of
    from nmatrix.classroom.handout import key_of
    from nmatrix.lessons.exercises.scheme import Sheet
    from nmatrix.output.pages.page_pdf import check_names, pdf_of

    seed, salt = sheet.of_a_class("--roster")
    check_names([one.name for one in everyone])
    path = Path(str(options.merged))
    kind_of(path, {".pdf": PageFormat.PDF}, "merged")
    made = {path: sheet_of}
    if plan.with_key:
        made[path.with_name(f"{path.stem}-key{path.suffix}")] = key_of
    refuse_existing(list(made), force=options.force)
    plan = replace(plan, kind=PageFormat.PDF)
    sheets = [Sheet(seed, one.name, salt) for one in everyone]
    for target, compose in made.items():
        composing = progress(sheets, len(sheets), "writing sheets")
        documents = [compose(plan, one) for one in composing]
        title = plan.title or documents[0].title
        write_file(target, pdf_of(documents, title), force=options.force)
    return list(made)
