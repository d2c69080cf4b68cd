"""The mutants of contrib/checks/fuzz: damaged texts, checkpoints and data files, and the data files to damage."""
import re
import struct
import zlib

NUMBERS = ["0", "-1", "1e308", "-1e308", "1e-308", "nan", "inf", "1e9", "-0", "4294967296", "0.1.2", "1e", "1/0", "t"]
TEXTS = ["", ";", ",", "(", ")", "=", "#", "\\", "end", "subsection", "set", "include", "\x00", "\xff", "\r", "pi", "^",
         "if(x,1,2)", "x=1", "'", '"', "$(id)", "%s%n", "a" * 5000, "(" * 3000, "1+" * 3000 + "1", "1," * 3000]
HEADER = "<16sIIQ"  # of a checkpoint: mark, format, dimension, size of the contents


def change_word(text, pattern, choices, rng):
    places = list(re.finditer(pattern, text))
    if not places:
        return text
    place = rng.choice(places)
    return text[:place.start()] + rng.choice(choices) + text[place.end():]


def other_numbers(rng):
    """Numbers that may be right ones."""
    return [f"{rng.uniform(-2, 2):.3g}", f"{10 ** rng.uniform(-6, 6):.3g}", *map(str, range(1, 9))] * 3


def mutate_text(text, others, rng):
    """One to four changes of the text of an input; in half of the cases of its numbers only, which gets farther."""
    is_gentle = rng.random() < 0.5
    for _ in range(rng.randint(1, 2 if is_gentle else 4)):
        lines = text.split("\n")
        i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
        kind = 0 if is_gentle else rng.randrange(9)
        if kind == 0:
            text = change_word(text, r"(?<=[=,; \t])-?\d+(\.\d*)?(e-?\d+)?\b", NUMBERS + other_numbers(rng), rng)
        elif kind == 1:
            text = change_word(text, r"(?<== ).*", NUMBERS + TEXTS, rng)
        elif kind == 2:
            text = change_word(text, r"[A-Za-z]+", TEXTS + re.findall(r"[A-Za-z]+", rng.choice(others)), rng)
        elif kind == 3:
            del lines[i]
            text = "\n".join(lines)
        elif kind == 4:
            text = "\n".join(lines[:i] + [lines[j]] + lines[i:])
        elif kind == 5:
            foreign = rng.choice(others).split("\n")
            k = rng.randrange(len(foreign))
            text = "\n".join(lines[:i] + foreign[k:k + rng.randint(1, 12)] + lines[i:])
        elif kind == 6:
            text = text[:rng.randrange(len(text) + 1)]
        elif kind == 7:
            at = rng.randrange(len(text) + 1)
            text = text[:at] + rng.choice([chr(rng.randrange(256)), rng.choice(TEXTS)]) + text[at:]
        else:
            lines[i], lines[j] = lines[j], lines[i]
            text = "\n".join(lines)
        text = text or "\n"
    return text


def place_of_length(content, first, rng):
    """Where a small whole number stands, as lengths do; any place if none is met."""
    for _ in range(200):
        at = rng.randrange(first, max(first + 1, len(content) - 8))
        if 0 < int.from_bytes(content[at:at + 8], "little") < 100000:
            return at
    return at


def mutate_bytes(content, first, rng):
    """One to eight changes of the bytes from `first` on."""
    content = bytearray(content)
    for _ in range(rng.randint(1, 8)):
        at = rng.randrange(first, max(first + 1, len(content) - 4))
        kind = rng.randrange(6)
        if kind == 0 and at < len(content):
            content[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            content[at:at + 1] = bytes([rng.randrange(256)])
        elif kind == 2:
            content[at:at + 8] = struct.pack("<q", rng.choice([0, -1, 1, 2**31, 2**62, rng.getrandbits(62)]))
        elif kind == 3:
            content[at:at + 8] = struct.pack("<d", rng.choice([float("nan"), 1e308, -1.0, float("inf"), 1e-308]))
        elif kind == 4:
            at = place_of_length(content, first, rng)
            content[at:at + 4] = struct.pack("<I", rng.choice([0, 1, 2, 3, 7, 100, 10**6, 2**31, 2**32 - 1]))
        elif rng.random() < 0.3:
            del content[at:at + rng.choice([1, 8, 1000, len(content)])]
    return bytes(content)


def mutate_checkpoint(content, rng):
    """With a right checksum in three quarters of the cases: what reads the contents sees them."""
    if rng.random() < 0.25:
        return mutate_bytes(content, 0, rng)
    mark, number, dimension, _ = struct.unpack_from(HEADER, content)
    first = struct.calcsize(HEADER)
    body = mutate_bytes(content[first:-4], 0, rng)
    content = struct.pack(HEADER, mark, number, dimension, len(body)) + body
    return content + struct.pack("<I", zlib.crc32(content))


def with_right_checksums(png):
    """A PNG image of which the checksums of the chunks are right again."""
    result, at = png[:8], 8
    while at + 12 <= len(png):
        size = struct.unpack_from(">I", png, at)[0]
        chunk = png[at + 4:at + 8 + size]
        result += png[at:at + 4] + chunk + struct.pack(">I", zlib.crc32(chunk))
        at += 12 + size
    return result


def mutate_data(content, others, rng):
    """As a text, where it is one, or as bytes, early ones for the most part: there the headers are."""
    is_text = all(byte < 127 for byte in content)
    if is_text and rng.random() < 0.8:
        return mutate_text(content.decode("latin-1"), others, rng).encode("latin-1")
    early = content[:rng.choice([60, 300, len(content)])]
    changed = mutate_bytes(early, 0, rng) + content[len(early):]
    return with_right_checksums(changed) if content[:4] == b"\x89PNG" and rng.random() < 0.7 else changed


def as_tiff(labels, order):
    """An image of 8 bits without compression."""
    height, width = len(labels), len(labels[0])
    entries = [(256, 3, width), (257, 3, height), (258, 3, 8), (259, 3, 1), (262, 3, 1), (273, 4, 8), (277, 3, 1),
               (278, 3, height), (279, 4, width * height)]
    pixels = bytes(value for row in labels for value in row)
    pixels += bytes(len(pixels) % 2)
    result = (b"II" if order == "<" else b"MM") + struct.pack(order + "HI", 42, 8 + len(pixels)) + pixels
    result += struct.pack(order + "H", len(entries))
    for tag, kind, value in entries:
        field = struct.pack(order + "I", value) if kind == 4 else struct.pack(order + "HH", value, 0)
        result += struct.pack(order + "HHI", tag, kind, 1) + field
    return result + struct.pack(order + "I", 0)


def data_files(root):
    """(input, name of the file in it, name of the one in its place, contents), a format each."""
    def shipped(name):
        return (root / "prm" / name).read_bytes()
    wide, high = 40, 30
    labels = [[1 if (x - 12)**2 + (y - 15)**2 < 90 else 2 if (x - 28)**2 + (y - 15)**2 < 40 else 0 for x in range(wide)]
              for y in range(high)]
    pixels = bytes(value for row in labels for value in row)
    plain = " ".join(map(str, pixels)).encode()
    cube = bytes(1 if all(2 <= i < 10 for i in (x, y, z)) else 0 for z in range(12) for y in range(12) for x in range(12))
    corners = [(100, 0, 0), (-100, 0, 0), (0, 100, 0), (0, -100, 0), (0, 0, 100), (0, 0, -100)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    solid = "solid o\n" + "".join(
        "facet normal 0 0 0\nouter loop\n" + "".join("vertex %d %d %d\n" % corners[i] for i in face) + "endloop\nendfacet\n"
        for face in faces) + "endsolid o\n"
    ply = ("ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 8\nproperty list uchar int vertex_indices\nend_header\n"
           + "".join("%d %d %d\n" % corner for corner in corners) + "".join("3 %d %d %d\n" % face for face in faces))
    binary_ply = (ply[:ply.index("end_header")].replace("ascii", "binary_little_endian") + "end_header\n").encode()
    binary_ply += b"".join(struct.pack("<3f", *corner) for corner in corners)
    binary_ply += b"".join(struct.pack("<B3i", 3, *face) for face in faces)
    obj = "".join("v %d %d %d\n" % corner for corner in corners) + "".join("f %d %d %d\n" % tuple(i + 1 for i in face)
                                                                        for face in faces)
    nrrd = b"NRRD0004\ntype: uchar\ndimension: 3\nsizes: 12 12 12\nspacings: 20 20 20\nencoding: raw\n\n" + cube
    meta = (b"ObjectType = Image\nNDims = 3\nDimSize = 12 12 12\nElementSpacing = 20 20 20\nElementType = MET_UCHAR\n"
            b"ElementDataFile = LOCAL\n" + cube)
    return [("grains/stone", "stone.csv", "data.csv", shipped("grains/stone.csv")),
            ("grains/fifteen", "fifteen.csv", "data.csv", shipped("grains/fifteen.csv")),
            ("grains/pebbles", "pebbles.csv", "data.csv", shipped("grains/pebbles.csv")),
            ("imprint/imprint", "stroke.csv", "data.csv", shipped("imprint/stroke.csv")),
            ("grains/stones", "stones.png", "data.png", shipped("grains/stones.png")),
            ("grains/stones", "stones.png", "data.pgm", b"P5\n# labels\n%d %d\n255\n" % (wide, high) + pixels),
            ("grains/stones", "stones.png", "data.pgm", b"P2\n%d %d\n255\n" % (wide, high) + plain),
            ("grains/stones", "stones.png", "data.tif", as_tiff(labels, "<")),
            ("grains/stones", "stones.png", "data.tif", as_tiff(labels, ">")),
            ("grains/volume", "volume.nrrd", "data.nrrd", shipped("grains/volume.nrrd")),
            ("grains/volume", "volume.nrrd", "data.nrrd", nrrd),
            ("grains/volume", "volume.nrrd", "data.mha", meta),
            ("grains/grain", "grain.stl", "data.stl", shipped("grains/grain.stl")),
            ("grains/grain", "grain.stl", "data.stl", solid.encode()),
            ("grains/grain", "grain.stl", "data.ply", ply.encode()),
            ("grains/grain", "grain.stl", "data.ply", binary_ply),
            ("grains/grain", "grain.stl", "data.obj", obj.encode())]
