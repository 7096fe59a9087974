"""The fixed words of sheets and question banks, in each language that they are spoken in."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Language(StrEnum):
    """The languages of fixed words; tasks themselves are English."""

    ENGLISH = "en"
    ITALIAN = "it"
    GERMAN = "de"


@dataclass(frozen=True)
class Words:
    """The fixed words of one language; words in braces are filled in."""

    language: Language = Language.ENGLISH
    course: str = "Course"
    sheet: str = "Sheet"
    date: str = "Date"
    name: str = "Name"
    theory: str = "Normals, spaces and lights"
    exercises: str = "Exercises"
    key: str = "The key to the exercises"
    are_they_right: str = "Are your answers right?"
    is_graded: str = "This sheet is part of a graded test: your teacher has what checks it."
    command_says: str = "This command says so, and names the mistake if there is one:"
    your_answer: str = "YOUR ANSWER"
    your_name: str = "YOUR NAME, AS IT STANDS ABOVE"
    right: str = "Right."
    known: str = "A known mistake gives this number:"
    otherwise: str = "Or, with the same number:"
    matrix_itself: str = "Write A⁻ᵀ itself, not a multiple of it."
    unit_vector: str = "Write the unit vector: its length is 1."
    one_of_two: str = (
        "Two unit vectors are right: write the one whose first number other than 0 is positive."
    )
    decimals: str = (
        "One decimal number in each field; where it does not end sooner, four places behind the "
        "point."
    )
    place: str = "row {row}, column {column}"
    which: str = "Which number is it: {place}?"
    if_wrong: str = "If it is wrong: these are the known mistakes here."


WORDS: dict[Language, Words] = {
    Language.ENGLISH: Words(),
    Language.ITALIAN: Words(
        language=Language.ITALIAN,
        course="Corso",
        sheet="Foglio",
        date="Data",
        name="Nome",
        theory="Normali, spazi e luci",
        exercises="Esercizi",
        key="Le soluzioni degli esercizi",
        are_they_right="Le tue risposte sono giuste?",
        is_graded="Questo foglio fa parte di un esame: il docente ha ciò che serve a controllarlo.",
        command_says="Lo dice questo comando, che nomina anche l’errore, se c’è:",
        your_answer="LA TUA RISPOSTA",
        your_name="IL TUO NOME, COME STA SOPRA",
        right="Giusto.",
        known="Un errore noto dà questo numero:",
        otherwise="Oppure, con lo stesso numero:",
        matrix_itself="Scrivi proprio A⁻ᵀ, non un suo multiplo.",
        unit_vector="Scrivi il versore: la sua lunghezza è 1.",
        one_of_two=(
            "Due versori sono giusti: scrivi quello il cui primo numero diverso da 0 è positivo."
        ),
        decimals=(
            "Un numero decimale in ogni campo; se non finisce prima, quattro cifre dopo la virgola."
        ),
        place="riga {row}, colonna {column}",
        which="Qual è questo numero: {place}?",
        if_wrong="Se è sbagliato: questi sono gli errori noti qui.",
    ),
    Language.GERMAN: Words(
        language=Language.GERMAN,
        course="Kurs",
        sheet="Blatt",
        date="Datum",
        name="Name",
        theory="Normalen, Räume und Lichter",
        exercises="Aufgaben",
        key="Die Lösungen der Aufgaben",
        are_they_right="Sind deine Antworten richtig?",
        is_graded="Dieses Blatt gehört zu einer Prüfung: deine Lehrkraft hat, was es prüft.",
        command_says="Das sagt dieser Befehl; er nennt auch den Fehler, wenn es einer ist:",
        your_answer="DEINE ANTWORT",
        your_name="DEIN NAME, WIE ER OBEN STEHT",
        right="Richtig.",
        known="Ein bekannter Fehler ergibt diese Zahl:",
        otherwise="Oder, mit derselben Zahl:",
        matrix_itself="Schreibe A⁻ᵀ selbst, kein Vielfaches davon.",
        unit_vector="Schreibe den Einheitsvektor: seine Länge ist 1.",
        one_of_two=(
            "Zwei Einheitsvektoren sind richtig: schreibe den, dessen erste Zahl außer 0 positiv "
            "ist."
        ),
        decimals=(
            "Eine Dezimalzahl in jedes Feld; wenn sie nicht früher endet, vier Stellen nach dem "
            "Komma."
        ),
        place="Zeile {row}, Spalte {column}",
        which="Welche Zahl ist es: {place}?",
        if_wrong="Wenn sie falsch ist: das sind die bekannten Fehler hier.",
    ),
}
