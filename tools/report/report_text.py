"""Text of unknown origin made safe to show, with the rules of meshprep/base/text.h."""
import unicodedata

kBidi = {0x61c, 0x200b, 0x200e, 0x200f, 0xfeff, *range(0x2028, 0x202f), *range(0x2060, 0x2070), *range(0xfff9, 0xfffc),
         *range(0xfdd0, 0xfdf0), *range(0xe0000, 0xe0080)}


def printable(text: str) -> str:
    """Replaces control characters, surrogates, bidirectional controls and invisible characters by escapes."""
    def shown(character: str) -> str:
        code = ord(character)
        if unicodedata.category(character) == "Cc":
            return f"\\x{code:02x}"
        if code in kBidi or 0xd800 <= code <= 0xdfff or code & 0xfffe == 0xfffe:
            return f"\\u{{{code:x}}}"
        return character
    return "".join(map(shown, text))


def printable_json(value):
    """Returns a document with every text and key made printable. Names of files must not need it."""
    if isinstance(value, str):
        return printable(value)
    if isinstance(value, list):
        return [printable_json(v) for v in value]
    if isinstance(value, dict):
        return {printable(k): printable_json(v) for k, v in value.items()}
    return value
