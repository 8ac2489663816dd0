#!/usr/bin/env python3
"""Read each EDS and DCF file of the corpus without edskit and write down what is in it.

Two readers look at each file: `plain`, the small line reader below, written from the
lexical rules of CiA 306, and python-canopen. Their counts go into independent.tsv, which
the Rust tests compare with edskit's own reading. README.md explains the columns.

    python3 -m venv target/compare-venv
    target/compare-venv/bin/pip install -r tests/corpus/requirements.txt
    target/compare-venv/bin/python tests/corpus/independent_reading.py [--check] [FOLDER]
"""

import argparse
import difflib
import importlib.metadata
import logging
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

HERE = Path(__file__).resolve().parent
TABLE = HERE / "independent.tsv"
CORPUS = HERE.parents[2] / "shared" / "corpus" / "files"

# Both readers put this in the place of $NODEID.
NODE_ID = 10

# Where a section stands in the object dictionary: an index, and a sub-index or None.
Place: TypeAlias = tuple[int, int | None]
# A place and which of the four keys below, as an index into KEYS.
Entry: TypeAlias = tuple[int, int | None, int]

KEYS = (b"defaultvalue", b"parametervalue", b"lowlimit", b"highlimit")
ATTRIBUTES = ("default", "value", "min", "max")

LINE_END = re.compile(rb"\r\n|\r|\n")
SECTION = re.compile(rb"(?:0x)?0*([0-9a-f]{1,4})(?:sub(?:0x)?0*([0-9a-f]{1,2}))?", re.I)
USUAL_SECTION = re.compile(rb"[0-9a-f]{4}(sub(0|[1-9a-f][0-9a-f]?))?", re.I)
INTEGER = re.compile(rb"[+-]?(0x[0-9a-f]+|0[0-7]*|[1-9][0-9]{0,19})", re.I)
FORMULA = re.compile(rb"\$NODEID(?:\s*\+\s*(\w+))?", re.I)
REVERSED_FORMULA = re.compile(rb"(\w+)\s*\+\s*\$NODEID", re.I)


@dataclass
class Plain:
    """What the plain reader finds in one file."""

    places: set[Place] = field(default_factory=set)
    integers: dict[Entry, int] = field(default_factory=dict)
    counts: Counter[str] = field(default_factory=Counter)


def integer(text: bytes) -> int | None:
    """Give the value of a decimal, hexadecimal (0x) or octal (0) integer of up to 64 bits."""
    if not INTEGER.fullmatch(text):
        return None
    digits = text.lstrip(b"+-").lower()
    base = 16 if digits.startswith(b"0x") else 8 if digits.startswith(b"0") else 10
    value = int(digits, base) * (-1 if text.startswith(b"-") else 1)
    return value if -(2**63) <= value < 2**64 else None


def formula(text: bytes) -> int | None:
    """Give the value of `$NODEID` or `$NODEID+integer`."""
    match = FORMULA.fullmatch(text)
    if not match:
        return None
    offset = integer(match[1]) if match[1] else 0
    return None if offset is None else NODE_ID + offset


def place(section: bytes) -> Place | None:
    """Give the place of a section `hhhh` or `hhhhsubhh`, None for any other section."""
    match = SECTION.fullmatch(section)
    if not match:
        return None
    return int(match[1], 16), None if match[2] is None else int(match[2], 16)


def read_plain(data: bytes) -> Plain:
    """Read a file line by line; of sections and keys that come twice, the first counts."""
    plain = Plain()
    here: Place | None = None
    keys_here: set[bytes] = set()
    for line in LINE_END.split(data.removeprefix(b"\xef\xbb\xbf")):
        line = line.strip()
        if line.startswith((b";", b"#")):
            continue
        if line.startswith(b"["):
            section = line[1:].partition(b"]")[0].strip()
            here = place(section)
            keys_here = set()
            if here in plain.places:
                plain.counts["repeated_sections"] += 1
                here = None
            if here is not None:
                plain.places.add(here)
                plain.counts["unusual_names"] += not USUAL_SECTION.fullmatch(section)
            continue
        key, equals, value = line.partition(b"=")
        key = key.strip().lower()
        if here is None or not equals:
            continue
        if key in keys_here:
            plain.counts["repeated_keys"] += 1
            continue
        keys_here.add(key)
        if key in KEYS:
            add_value(plain, (*here, KEYS.index(key)), value.strip())
    return plain


def add_value(plain: Plain, entry: Entry, text: bytes) -> None:
    """Put one of the four values where it belongs; an empty one equals a missing one."""
    if not text:
        return
    value = integer(text)
    if value is None:
        value = formula(text)
        plain.counts["formulas"] += value is not None
    if value is not None:
        plain.integers[entry] = value
    elif (match := REVERSED_FORMULA.fullmatch(text)) and integer(match[1]) is not None:
        plain.counts["reversed"] += 1
    else:
        plain.counts["other_values"] += 1


PLAIN_COLUMNS = (
    "objects",
    "sub_objects",
    "unusual_names",
    "repeated_sections",
    "repeated_keys",
    "defaults",
    "values",
    "lows",
    "highs",
    "formulas",
    "reversed",
    "other_values",
    "sum",
)


def plain_row(plain: Plain) -> dict[str, int]:
    """Give the plain reader's columns."""
    subs = sum(sub is not None for _, sub in plain.places)
    per_key = Counter(key for _, _, key in plain.integers)
    row = {
        "objects": len(plain.places) - subs,
        "sub_objects": subs,
        "defaults": per_key[0],
        "values": per_key[1],
        "lows": per_key[2],
        "highs": per_key[3],
        "sum": sum(plain.integers.values()),
    }
    return {column: row.get(column, plain.counts[column]) for column in PLAIN_COLUMNS}


PC_COLUMNS = (
    "pc_dummies",
    "pc_objects",
    "pc_objects_lost",
    "pc_subs",
    "pc_subs_added",
    "pc_subs_lost",
    "pc_defaults",
    "pc_values",
    "pc_mins",
    "pc_maxs",
    "pc_same",
    "pc_differs",
    "pc_typed",
    "pc_missing",
    "pc_extra",
)


def pc_variables(dictionary: Any) -> Iterator[tuple[Place, Any]]:
    """Give each variable of python-canopen's object dictionary with its place."""
    for index, entry in dictionary.indices.items():
        if hasattr(entry, "subindices"):
            for sub, variable in entry.subindices.items():
                yield (index, sub), variable
        else:
            yield (index, None), entry


def is_dummy(index: int, entry: Any) -> bool:
    """Tell whether python-canopen made this object from [DummyUsage]."""
    return 1 <= index <= 7 and entry.name == f"Dummy{index:04d}"


def compare(plain_value: int, pc_value: Any) -> str:
    """Say how python-canopen's value for an entry stands to the plain reader's integer."""
    if pc_value is None:
        return "missing"
    if not isinstance(pc_value, int):
        return "typed"
    return "same" if pc_value == plain_value else "differs"


def pc_row(dictionary: Any, plain: Plain) -> dict[str, int]:
    """Give python-canopen's columns, compared with the plain reading."""
    dummies = {i for i, entry in dictionary.indices.items() if is_dummy(i, entry)}
    variables = {at: v for at, v in pc_variables(dictionary) if at[0] not in dummies}
    objects: set[Place] = {(i, None) for i in dictionary.indices if i not in dummies}
    subs = {at for at in variables if at[1] is not None}
    found = {
        (*at, key): value
        for at, variable in variables.items()
        for key, attribute in enumerate(ATTRIBUTES)
        if (value := getattr(variable, attribute)) is not None
    }
    per_key = Counter(key for _, _, key in found)
    compared = Counter(compare(value, found.get(entry)) for entry, value in plain.integers.items())
    extra = sum(
        isinstance(value, int) and entry not in plain.integers for entry, value in found.items()
    )
    plain_subs = {at for at in plain.places if at[1] is not None}
    return {
        "pc_dummies": len(dummies),
        "pc_objects": len(objects),
        "pc_objects_lost": len(plain.places - plain_subs - objects),
        "pc_subs": len(subs),
        "pc_subs_added": len(subs - plain_subs),
        "pc_subs_lost": len(plain_subs - subs),
        "pc_defaults": per_key[0],
        "pc_values": per_key[1],
        "pc_mins": per_key[2],
        "pc_maxs": per_key[3],
        "pc_same": compared["same"],
        "pc_differs": compared["differs"],
        "pc_typed": compared["typed"],
        "pc_missing": compared["missing"],
        "pc_extra": extra,
    }


def read_file(path: Path) -> list[str]:
    """Give the cells of a file's row."""
    import canopen

    plain = read_plain(path.read_bytes())
    cells = [path.name, *map(str, plain_row(plain).values())]
    try:
        with path.open(encoding="utf-8") as source:
            dictionary = canopen.import_od(source, NODE_ID)
    except Exception as error:  # whatever it raises is the result
        return [*cells, type(error).__name__, *("-" for _ in PC_COLUMNS)]
    return [*cells, "ok", *map(str, pc_row(dictionary, plain).values())]


def make_table(files: list[Path]) -> str:
    """Give the text of independent.tsv."""
    version = importlib.metadata.version("canopen")
    lines = [
        "# Made by tests/corpus/independent_reading.py with python-canopen "
        f"{version}, $NODEID = {NODE_ID}; do not edit.",
        "# README.md in this folder says what the columns mean.",
        "\t".join(["file", *PLAIN_COLUMNS, "pc_status", *PC_COLUMNS]),
    ]
    lines += ["\t".join(read_file(path)) for path in files]
    return "\n".join(lines) + "\n"


def check_version() -> str | None:
    """Say what is wrong with the installed python-canopen, if anything is."""
    wanted = re.search(r"^canopen==(.+)$", (HERE / "requirements.txt").read_text(), re.M)
    try:
        installed = importlib.metadata.version("canopen")
    except importlib.metadata.PackageNotFoundError:
        installed = "none"
    if wanted and installed == wanted[1]:
        return None
    return f"canopen: {installed} installed; install tests/corpus/requirements.txt"


def main() -> int:
    """Write the table, or with --check compare it with the committed one."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("folder", nargs="?", type=Path, default=CORPUS, help="the files")
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    arguments = parser.parse_args()

    files = sorted(p for p in arguments.folder.glob("*") if p.suffix in (".eds", ".dcf"))
    problem = check_version() if files else f"no EDS or DCF file in {arguments.folder}"
    if problem:
        print(problem, file=sys.stderr)
        return 2
    logging.disable()
    table = make_table(files)
    if not arguments.check:
        TABLE.write_text(table)
        return 0
    committed = TABLE.read_text() if TABLE.exists() else ""
    sys.stdout.writelines(
        difflib.unified_diff(
            committed.splitlines(True), table.splitlines(True), "committed", "made now", n=0
        )
    )
    return int(committed != table)


if __name__ == "__main__":
    sys.exit(main())
