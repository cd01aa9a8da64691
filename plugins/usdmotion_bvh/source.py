"""A BVH file as lines of text, and how it is refused."""

from dataclasses import dataclass
from pathlib import Path

from usdmotion import FileError

LARGEST_NUMBER = 1e9
"""No captured number is larger; what is, was not meant as one."""
_BYTE_ORDER_MARKS = {b"\xef\xbb\xbf": "utf-8-sig", b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}


@dataclass(frozen=True)
class Source:
    """The text of one file."""

    path: Path
    """Where it was read from."""
    lines: tuple[str, ...]
    """Its lines without their ends; line 1 stands at index 0."""

    def refusal(self, line: int, sentence: str) -> FileError:
        """Return the error that refuses the file because of one line."""
        return FileError(f"{self.path}, line {line}: {sentence}")


def read_source(path: Path) -> Source:
    """Read the lines of a file, whatever ends them.

    Raises:
        FileError: The file cannot be read or is not text.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise FileError(f"{path} cannot be read: {error.strerror}") from error
    text = _decoded(content).replace("\r\n", "\n").replace("\r", "\n")
    source = Source(path, tuple(text.split("\n")))
    for number, line in enumerate(source.lines, start=1):
        if "\0" in line:
            raise source.refusal(number, "this is not text; a BVH file is")
    return source


def _decoded(content: bytes) -> str:
    for mark, encoding in _BYTE_ORDER_MARKS.items():
        if content.startswith(mark):
            return content.decode(encoding, errors="replace")
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError:
        # Old exporters write joint names in the code page of their machine: every byte is a letter.
        return content.decode("latin-1")
