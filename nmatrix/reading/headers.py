"""Names that people give to the columns of class lists and answers, in several languages."""

from __future__ import annotations

import re
from collections.abc import Sequence

# What each column is called elsewhere, in small letters without signs; the surest first.
SYNONYMS: dict[str, tuple[str, ...]] = {
    "student": (
        "student", "students", "name", "fullname", "studentname", "displayname", "nameofstudent",
        "studente", "studentessa", "cognomeenome", "nomeecognome", "nomecompleto", "nominativo",
        "studierende", "studierender", "studentin", "teilnehmer", "vollständigername",
        "étudiant", "nomcomplet", "estudiante", "alumno", "nombrecompleto", "nombre", "nome", "nom",
        "email", "emailaddress", "mail", "indirizzoemail", "emailadresse", "correo",
        "id", "studentid", "sid", "idnumber", "username", "matricola", "matrikelnummer", "matrikel",
    ),
    "exercise": (
        "exercise", "question", "task", "problem", "number", "no", "nr", "n",
        "esercizio", "domanda", "numero", "aufgabe", "übung", "frage", "nummer",
        "exercice", "ejercicio",
    ),
    "answer": (
        "answer", "answers", "response", "solution", "risposta", "soluzione", "antwort", "lösung",
        "réponse", "respuesta",
    ),
}  # fmt: skip
FIRST = ("firstname", "givenname", "nome", "vorname", "prénom", "nombre")
LAST = (
    "lastname",
    "surname",
    "familyname",
    "cognome",
    "nachname",
    "familienname",
    "nom",
    "apellidos",
)
_SIGNS = re.compile(r"[\W_]+")


def plain(name: str) -> str:
    """Bring the name of a column into small letters without signs.

    Examples
    --------
    >>> plain("E-mail address")
    'emailaddress'
    """
    return _SIGNS.sub("", name.casefold())


def places_of(column: str, header: Sequence[str]) -> tuple[int, ...]:
    """Find where a column stands under any of its names: one place, or a first and a last name.

    None where no name, or the same name twice, stands there.

    Examples
    --------
    >>> places_of("student", ["ID", "Full name"]), places_of("student", ["Cognome", "Nome"])
    ((1,), (1, 0))
    >>> places_of("answer", ["student"])
    ()
    """
    names = [plain(one) for one in header]
    if column == "student" and "student" not in names:
        first, last = (_first_of(known, names) for known in (FIRST, LAST))
        whole = [one for one in SYNONYMS[column][:6] if one in names]
        if not whole and len(first) == len(last) == 1 and first != last:
            return (*first, *last)
    return _first_of((plain(column), *SYNONYMS.get(column, ())), names)


def _first_of(known: Sequence[str], names: Sequence[str]) -> tuple[int, ...]:
    """Find the first of some names that stands in a header, if it stands there once."""
    found = next((one for one in known if one in names), None)
    if found is None or names.count(found) > 1:
        return ()
    return (names.index(found),)
