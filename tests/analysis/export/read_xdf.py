"""Reads a file of the Extensible Data Format by its specification and prints what is in it as
JSON: for each stream its header, samples with their times, clock offsets and footer. It knows
nothing of jnd, and needs nothing but Python."""
import json
import struct
import sys
import xml.etree.ElementTree as ElementTree

FORMATS = {"float32": "f", "double64": "d", "int32": "i", "int16": "h", "int8": "b", "int64": "q"}
BOUNDARY = bytes.fromhex("43A546DCCBF5410FB30ED5467383CBE4")


class Reader:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, size):
        if self.at + size > len(self.data):
            raise ValueError("the file ends too early")
        self.at += size
        return self.data[self.at - size : self.at]

    def number(self, form):
        return struct.unpack("<" + form, self.take(struct.calcsize("<" + form)))[0]

    def length(self):
        width = self.number("B")
        return self.number({1: "B", 4: "I", 8: "Q"}[width])

    def is_over(self):
        return self.at == len(self.data)


def tree(element):
    return {child.tag: tree(child) if len(child) else (child.text or "") for child in element}


def read_samples(chunk, stream):
    info = stream["info"]
    for _ in range(chunk.length()):
        has_time = chunk.number("B")
        if has_time not in (0, 8):
            raise ValueError("a time of %d bytes" % has_time)
        time_s = chunk.number("d") if has_time else None
        if info["channel_format"] == "string":
            values = [chunk.take(chunk.length()).decode() for _ in range(int(info["channel_count"]))]
        else:
            form = FORMATS[info["channel_format"]]
            values = [chunk.number(form) for _ in range(int(info["channel_count"]))]
        stream["times"].append(time_s)
        stream["values"].append(values)


def read(path):
    with open(path, "rb") as file:
        whole = Reader(file.read())
    if whole.take(4) != b"XDF:":
        raise ValueError("no XDF")
    streams, result = {}, {"streams": [], "num_boundaries": 0}
    while not whole.is_over():
        size = whole.length()
        tag = whole.number("H")
        chunk = Reader(whole.take(size - 2))
        if tag == 1:
            result["version"] = ElementTree.fromstring(chunk.data).find("version").text
        elif tag == 2:
            number = chunk.number("I")
            root = ElementTree.fromstring(chunk.data[4:])
            labels = [label.text for label in root.findall("./desc/channels/channel/label")]
            streams[number] = {"info": tree(root), "labels": labels, "times": [], "values": [],
                               "offsets": [], "footer": None}
            result["streams"].append(streams[number])
        elif tag == 3:
            read_samples(chunk, streams[chunk.number("I")])
            if not chunk.is_over():
                raise ValueError("more in a chunk than its samples")
        elif tag == 4:
            streams[chunk.number("I")]["offsets"].append([chunk.number("d"), chunk.number("d")])
        elif tag == 5:
            if chunk.data != BOUNDARY:
                raise ValueError("another boundary")
            result["num_boundaries"] += 1
        elif tag == 6:
            stream = streams[chunk.number("I")]
            root = ElementTree.fromstring(chunk.data[4:])
            stream["footer"] = tree(root)
            stream["footer"]["num_offsets"] = len(root.findall("./clock_offsets/offset"))
        else:
            raise ValueError("a chunk of kind %d" % tag)
    return result


if __name__ == "__main__":
    json.dump(read(sys.argv[1]), sys.stdout)
