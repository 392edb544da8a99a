"""XML files within the archives of Simulink and Excel, up to a size."""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from xml.etree import ElementTree

from hydrodae.errors import CaseError

#: Most bytes of XML of an archive; models of WEC-Sim have 1 MB. Elements take 30 times this.
LARGEST = 20_000_000


class XmlArchive:
    """Files of an archive, each of which is read once: what refers to itself never ends."""

    def __init__(self, path: Path, archive: zipfile.ZipFile) -> None:
        self.path, self.archive = path, archive
        self.left, self.read = LARGEST, set[str]()

    def names(self) -> list[str]:
        """Names of all files."""
        return self.archive.namelist()

    def xml(self, name: str) -> ElementTree.Element:
        """Root element of a file.

        Raises
        ------
        CaseError
            It is read already, too large, missing, or damaged.
        """
        if name in self.read:
            raise CaseError(f"{self.path}: {name} is referred to twice")
        self.read.add(name)
        with _told(self.path), self.archive.open(name) as file:
            text = file.read(self.left + 1)
            self.left -= len(text)
            if self.left < 0:
                raise CaseError(f"{self.path}: more than {LARGEST} bytes of XML, up to {name}")
            if b"<!DOCTYPE" in text or b"<!ENTITY" in text:
                raise CaseError(f"{self.path}: {name} declares entities, which no model does")
            return ElementTree.fromstring(text)


@contextmanager
def opened(path: Path, what: str) -> Iterator[XmlArchive]:
    """Open an archive.

    Raises
    ------
    CaseError
        There is no such file, or it is no archive; `what` is the kind of file that is expected.
    """
    try:
        archive = zipfile.ZipFile(path)
    except FileNotFoundError:
        raise CaseError(f"{path}: there is no such file") from None
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError) as error:
        raise CaseError(f"{path}: no {what} ({error})") from None
    with archive:
        yield XmlArchive(path, archive)


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Damage of an archive as one error."""
    try:
        yield
    except CaseError:
        raise
    except KeyError as error:
        raise CaseError(f"{path}: {error.args[0]}") from None
    except (zipfile.BadZipFile, zlib.error, OSError, EOFError, RuntimeError, ValueError) as error:
        raise CaseError(f"{path}: a file in it cannot be unpacked ({error})") from None
    except ElementTree.ParseError as error:
        raise CaseError(f"{path}: its XML is damaged ({error})") from None
