"""The words of a hierarchy, taken one after the other, each with its line."""

import math
import re
from typing import NamedTuple, NoReturn

from usdmotion_bvh.source import LARGEST_NUMBER, Source

_WORD = re.compile(r"[{}]|[^{}\s]+")


class Word(NamedTuple):
    """A brace, or letters between spaces."""

    text: str
    line: int

    @property
    def keyword(self) -> str:
        """The word in capitals: files do not agree on the case of keywords."""
        return self.text.upper()


class Words:
    """Hands out the words of a file up to the line that says MOTION, that line included."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._at = 0
        self._words: list[Word] = []
        for number, line in enumerate(source.lines, start=1):
            self._words += [Word(text, number) for text in _WORD.findall(line)]
            if line.strip().upper() == "MOTION":
                break

    def take(self) -> Word:
        """Take the next word."""
        if self._at == len(self._words):
            last = len(self._source.lines)
            raise self._source.refusal(last, "the file ends before its MOTION begins")
        self._at += 1
        return self._words[self._at - 1]

    def take_line(self, line: int) -> str:
        """Take what is left of a line before the next brace: names may have spaces."""
        texts = []
        while self._at < len(self._words):
            word = self._words[self._at]
            if word.line != line or word.text in "{}":
                break
            texts.append(self.take().text)
        return " ".join(texts)

    def expect(self, wanted: str, place: str) -> None:
        """Take the next word, which has to be a certain one."""
        word = self.take()
        if word.keyword != wanted:
            self.refuse(word, f"'{word.text}' stands where '{wanted}' of {place} should")

    def take_number(self, place: str) -> float:
        """Take the next word, which has to be a number of sensible size."""
        word = self.take()
        try:
            number = float(word.text)
        except ValueError:
            number = math.nan
        if not abs(number) < LARGEST_NUMBER:
            self.refuse(word, f"'{word.text}' stands where a number of {place} should")
        return number

    def refuse(self, word: Word, sentence: str) -> NoReturn:
        """Refuse the file because of a word."""
        raise self._source.refusal(word.line, sentence)
