"""How a text file is encoded, told from its bytes: laboratories and agencies write UTF-8, UTF-16, Shift-JIS and cp1252.

The typographic minus (U+2212) of some programs becomes the hyphen that numbers are written with.
"""

import codecs
import re

#: Bytes that are enough to tell.
_LOOK_AT = 400
#: What may pad the end of a file beside its NUL bytes.
_PADDING = "\x00\r\n\t \x1a"
#: Real Japanese has wide characters side by side; a Western letter such as a-umlaut before an ASCII one makes a single.
_JAPANESE = re.compile("[\u3040-\u9fff]{2}")


def encoding_of(head: bytes) -> str:
    """Return Python's name of the encoding of a text.

    Args:
        head: its first bytes; the last character may be cut.
    """
    for mark, name in (
        (codecs.BOM_UTF8, "utf-8-sig"),
        (codecs.BOM_UTF16_LE, "utf-16"),
        (codecs.BOM_UTF16_BE, "utf-16"),
    ):
        if head.startswith(mark):
            return name
    start = head[:_LOOK_AT]
    for name, low, high in (("utf-16-le", start[::2], start[1::2]), ("utf-16-be", start[1::2], start[::2])):
        # Western text: nearly every other byte is zero, and none between.
        if len(high) > 1 and high.count(0) > 0.9 * len(high) and low.count(0) == 0:
            return name
    for cut in range(4):
        if _decodes(head[: len(head) - cut], "utf-8") is not None:
            return "utf-8"
    for cut in range(2):
        text = _decodes(head[: len(head) - cut], "cp932")
        if text is not None and _JAPANESE.search(text):
            return "cp932"
    return "cp1252" if _decodes(head, "cp1252") is not None else "latin-1"


def decoded(body: bytes) -> str:
    """Decode a whole text, without its byte-order mark and the NUL bytes that pad its end."""
    encoding = encoding_of(body)
    if encoding.startswith("utf-16"):
        body = body[: len(body) // 2 * 2]
    text = body.decode(encoding, "replace")
    if "\x00" in text and "\x00" not in text.rstrip(_PADDING):
        text = text.rstrip(_PADDING)
    return text.lstrip("\ufeff").replace("\u2212", "-")


def _decodes(data: bytes, encoding: str) -> str | None:
    try:
        return data.decode(encoding)
    except UnicodeDecodeError:
        return None
