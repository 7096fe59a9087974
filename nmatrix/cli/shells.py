"""What a shell must be told once, so that TAB asks nmatrix: a script for each, and its place."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from nmatrix.errors import IllegalValueError, printable

BASH = r"""_nmatrix_completion() {
    local IFS=$'\n'
    COMPREPLY=( $( env COMP_LINE="$COMP_LINE" COMP_POINT="$COMP_POINT" \
        _NMATRIX_COMPLETE=complete_bash "$1" 2>/dev/null ) )
    if [[ ${#COMPREPLY[@]} == 1 && ${COMPREPLY[0]} == */ ]]; then compopt -o nospace; fi
}
complete -o default -F _nmatrix_completion nmatrix
"""
# An autoloaded file is run at the first TAB: it must answer that one too.
ZSH = r"""#compdef nmatrix
_nmatrix_completion() {
    eval "$(env _TYPER_COMPLETE_ARGS="${words[1,$CURRENT]}" \
        _NMATRIX_COMPLETE=complete_zsh nmatrix 2>/dev/null)"
}
if [[ $zsh_eval_context[-1] == loadautofunc ]]; then
    _nmatrix_completion "$@"
else
    compdef _nmatrix_completion nmatrix
fi
"""
FISH = r"""function __nmatrix_completion
    env _NMATRIX_COMPLETE=complete_fish _TYPER_COMPLETE_FISH_ACTION=$argv[1] \
        _TYPER_COMPLETE_ARGS=(commandline -cp) nmatrix 2>/dev/null
end
complete --command nmatrix --no-files --arguments "(__nmatrix_completion get-args)" \
    --condition "__nmatrix_completion is-args"
"""
POWERSHELL = r"""Register-ArgumentCompleter -Native -CommandName nmatrix -ScriptBlock {
    param($word, $command, $cursor)
    $Env:_NMATRIX_COMPLETE = "complete_powershell"
    $Env:_TYPER_COMPLETE_ARGS = $command.ToString()
    $Env:_TYPER_COMPLETE_WORD_TO_COMPLETE = $word
    nmatrix | ForEach-Object {
        $offered, $about = $_ -Split ":::"
        [System.Management.Automation.CompletionResult]::new(
            $offered, $offered, 'ParameterValue', $about)
    }
    Remove-Item Env:_NMATRIX_COMPLETE
    Remove-Item Env:_TYPER_COMPLETE_ARGS
    Remove-Item Env:_TYPER_COMPLETE_WORD_TO_COMPLETE
}
"""


@dataclass(frozen=True)
class Shell:
    """A shell: its script, where that is kept, and a line of its start file that reads it."""

    script: str
    place: str | None  # below the home folder; None where only its user knows
    start_file: str = ""
    start_line: str = ""


BASH_FILE = ".bash_completions/nmatrix.sh"
ZSH_START = "fpath+=~/.zfunc; autoload -Uz compinit; compinit"
SHELLS = {
    "bash": Shell(BASH, BASH_FILE, ".bashrc", f"source ~/{BASH_FILE}"),
    "zsh": Shell(ZSH, ".zfunc/_nmatrix", ".zshrc", ZSH_START),
    "fish": Shell(FISH, ".config/fish/completions/nmatrix.fish"),
    "powershell": Shell(POWERSHELL, None),
}


def shell_named(name: str | None) -> str:
    """Choose a shell by its name, or the one that the user logs in to.

    Raises
    ------
    IllegalValueError
        For a shell whose script is not known.
    """
    wanted = name or Path(os.environ.get("SHELL", "")).name
    if wanted not in SHELLS:
        raise IllegalValueError(
            f"shell ({printable(wanted)})",
            f"there is completion for {', '.join(SHELLS)}",
            "name one of them behind the option",
        )
    return wanted


def install(name: str) -> str:
    """Write the script of a shell where it looks, once, and return what to do next.

    Raises
    ------
    IllegalValueError
        If it cannot be written there.
    """
    shell = SHELLS[name]
    if shell.place is None:
        raise IllegalValueError(
            f"shell ({name})",
            "only its user knows its profile",
            f"run: nmatrix --show-completion {name} >> $PROFILE",
        )
    path = Path.home() / shell.place
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(shell.script, encoding="utf-8")
        if shell.start_file:
            _add_line(Path.home() / shell.start_file, shell.start_line)
    except OSError as error:
        raise IllegalValueError(
            f"file ({printable(str(error.filename or path))})",
            f"it cannot be written ({error.strerror})",
            f"put the output of nmatrix --show-completion {name} where {name} reads it",
        ) from None
    return f"Completion for {name} is in {path}; it works in the next {name} that you open."


def _add_line(path: Path, line: str) -> None:
    kept = path.read_text(encoding="utf-8", errors="surrogateescape") if path.exists() else ""
    if line not in kept.splitlines():
        with path.open("a", encoding="utf-8") as file:
            file.write(("" if not kept or kept.endswith("\n") else "\n") + line + "\n")
