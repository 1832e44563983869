"""Copies a GLB without its punctual lights, which assimp 5.2 cannot export: without_lights.py FROM.glb TO.glb"""
import json
import struct
import sys

HEADER, CHUNK = 12, 8


def main():
    data = open(sys.argv[1], "rb").read()
    size = struct.unpack_from("<I", data, HEADER)[0]
    document = json.loads(data[HEADER + CHUNK:HEADER + CHUNK + size])
    for part in (document, *document["nodes"]):
        part.get("extensions", {}).pop("KHR_lights_punctual", None)
        if part.get("extensions") == {}:
            del part["extensions"]
    text = json.dumps(document).encode("utf-8")
    text += b" " * (-len(text) % 4)
    rest = data[HEADER + CHUNK + size:]
    with open(sys.argv[2], "wb") as out:
        out.write(struct.pack("<4sII", b"glTF", 2, HEADER + CHUNK + len(text) + len(rest)))
        out.write(struct.pack("<II", len(text), 0x4E4F534A) + text + rest)


main()
