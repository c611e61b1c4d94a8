"""Compares our decoding of random frames of a random DBC file with another program's.

    compare_dbc.py DECODER canmatrix|cantools SEED FOLDER

The raw numbers must be the same bits, the values the same to 1e-12, and putting the raw numbers into
an empty frame must give the other program's encoding. FOLDER keeps the file of a run that failed.
"""
import logging
import math
import os
import random
import struct
import subprocess
import sys

MESSAGES = 150
FRAMES_PER_MESSAGE = 15
SIZES = [1, 2, 3, 4, 5, 6, 7, 8, 8, 8, 8, 12, 16, 20, 24, 32, 48, 64, 64, 64]
SCALES = [1, 1, 1, 0.01, 0.125, -0.5, 0.0001, 3, 2.5e-07, 1000.0]
OFFSETS = [0, 0, 0, -40, 250.5, 1000000.0, -0.001]
UNITS = ["", "rad", "Nm", "%", "°C", "m/s", "1/min"]


class Signal:
    def __init__(self, draw, name, size):
        self.name = name
        self.kind = draw.choice("++--fd")
        self.length = {"f": 32, "d": 64}.get(self.kind) or draw.randint(1, min(64, 8 * size))
        self.start = draw.randrange(8 * size)
        self.little = draw.random() < 0.5
        self.scale, self.offset = draw.choice(SCALES), draw.choice(OFFSETS)
        self.unit = draw.choice(UNITS)

    def bits(self):
        """As a DBC counts them: big endian ones go down in a byte, then up in the next."""
        bits, bit = [], self.start
        for _ in range(self.length):
            bits.append(bit)
            bit += 1 if self.little else (15 if bit % 8 == 0 else -1)
        return set(bits)

    def line(self):
        sign = "+" if self.kind == "+" else "-"
        return (f" SG_ {self.name} : {self.start}|{self.length}@{int(self.little)}{sign} "
                f"({self.scale},{self.offset}) [0|0] \"{self.unit}\" Master,Other\n")


class Message:
    def __init__(self, draw, number):
        self.name, self.size = f"Message{number}", draw.choice(SIZES)
        self.extended = draw.random() < 0.4
        self.id = number * 4321 if self.extended else number * 13
        self.signals, taken = [], set()
        for attempt in range(60):
            signal = Signal(draw, f"S{attempt}", self.size)
            bits = signal.bits()
            if max(bits) >= 8 * self.size or bits & taken:
                continue
            taken |= bits
            self.signals.append(signal)
            if len(self.signals) == 12:
                break

    def number(self):
        return self.id | (0x80000000 if self.extended else 0)

    def head(self):
        return f"BO_ {self.number()} {self.name}: {self.size} Drive\n"

    def frame(self, data):
        return f"{self.id:0{8 if self.extended else 3}X}#{data.hex()}\n"


def dbc_text(draw, messages):
    text = 'VERSION "1"\n\nNS_ :\n\tCM_\n\tBA_\n\tSIG_VALTYPE_\n\nBS_:\n\nBU_: Drive Master Other\n\n'
    for message in messages:
        text += message.head() + "".join(s.line() for s in message.signals) + "\n"
    text += ("BO_ 2047 Muxed: 8 Drive\n SG_ Selector M : 0|8@1+ (1,0) [0|0] \"\" Master\n"
             " SG_ First m0 : 8|8@1+ (1,0) [0|0] \"\" Master\n"
             " SG_ Second m1 : 8|16@1- (1,0) [0|0] \"\" Master\n\n")
    for message in messages:
        for signal in draw.sample(message.signals, min(1, len(message.signals))):
            number = message.number()
            text += (f'CM_ SG_ {number} {signal.name} "two lines, \\"quoted\\":\n'
                     f'SG_ {signal.name} : 1|1@1+ in °C";\n'
                     f'VAL_ {number} {signal.name} 1 "On" 0 "BO_ 3 Off: 8 X" ;\n')
    for message in messages:
        for signal in message.signals:
            if signal.kind in "fd":
                kind = "fd".index(signal.kind) + 1
                text += f"SIG_VALTYPE_ {message.number()} {signal.name} : {kind};\n"
    return text


class Canmatrix:
    def __init__(self, path):
        logging.disable(logging.WARNING)
        import canmatrix.formats
        self.messages = {m.name: m for m in canmatrix.formats.loadp_flat(path).frames}

    def decode(self, name, data):
        decoded = self.messages[name].decode(data)
        return {s: (d.raw_value, float(d.phys_value)) for s, d in decoded.items()}

    def encode(self, name, raw):
        return bytes(self.messages[name].encode(raw))


class Cantools:
    def __init__(self, path):
        import cantools
        database = cantools.database.load_file(path, encoding="cp1252", strict=True)
        self.messages = {m.name: m for m in database.messages}

    def decode(self, name, data):
        message = self.messages[name]
        raw = message.decode(data, decode_choices=False, scaling=False)
        values = message.decode(data, decode_choices=False)
        return {s: (raw[s], values[s]) for s in raw}

    def encode(self, name, raw):
        return self.messages[name].encode(raw, scaling=False, strict=False)


def pattern(signal, raw):
    """The bits of a raw number as an integer without sign."""
    if signal.kind in "fd":
        size = signal.length // 8
        return int.from_bytes(struct.pack(">" + signal.kind, raw), "big") & (1 << 8 * size) - 1
    return raw & (1 << signal.length) - 1


def same_value(signal, raw, value, theirs):
    if math.isnan(theirs) or math.isinf(theirs):
        return value == theirs or (math.isnan(value) and math.isnan(theirs))
    largest = max(abs(raw * signal.scale), abs(signal.offset))
    return abs(value - theirs) <= 1e-12 * largest


def ours(decoder, path, lines):
    """Of each frame its signals' (raw, value), and its encoding under `=`."""
    run = subprocess.run([decoder, path], input="".join(lines), text=True, capture_output=True)
    if run.returncode:
        sys.exit(f"{decoder}: {run.stderr}")
    frames = [{} for _ in lines]
    for line in run.stdout.splitlines():
        number, name, *rest = line.split()
        frames[int(number) - 1][name] = (
            bytes.fromhex(rest[0]) if name == "=" else (int(rest[0]), float(rest[1])))
    return frames


def check(message, peer, data, mine):
    """The number of signals compared; exits at the first that differs."""
    theirs = peer.decode(message.name, data)
    where = f"{message.name} {data.hex()}"
    if set(theirs) != {s.name for s in message.signals} or set(mine) != set(theirs) | {"="}:
        sys.exit(f"{where}: signals {sorted(mine)}, peer {sorted(theirs)}")
    any_nan = False
    for signal in message.signals:
        raw, value = theirs[signal.name]
        my_raw, my_value = mine[signal.name]
        any_nan |= math.isnan(raw)
        # what a NaN's bits are after a passage through python is its own affair
        same_bits = math.isnan(raw) or my_raw & (1 << signal.length) - 1 == pattern(signal, raw)
        same_sign = signal.kind in "fd" or my_raw == raw
        if not (same_bits and same_sign and same_value(signal, raw, my_value, value)):
            sys.exit(f"{where}: {signal.line()} {my_raw} {my_value!r}, peer {raw} {value!r}")
    if not any_nan:
        encoded = peer.encode(message.name, {name: raw for name, (raw, _) in theirs.items()})
        if encoded != mine["="]:
            sys.exit(f"{where}: put {mine['='].hex()}, peer {encoded.hex()}")
    return len(message.signals)


def main(decoder, peer_name, seed, folder):
    draw = random.Random(int(seed))
    messages = [Message(draw, number + 1) for number in range(MESSAGES)]
    path = os.path.join(folder, f"random{seed}.dbc")
    with open(path, "w", encoding="cp1252", newline="") as file:
        file.write(dbc_text(draw, messages))
    peer = {"canmatrix": Canmatrix, "cantools": Cantools}[peer_name](path)
    frames = [(message, draw.randbytes(message.size))
              for message in messages if message.signals for _ in range(FRAMES_PER_MESSAGE)]
    decoded = ours(decoder, path, [message.frame(data) for message, data in frames])
    signals = sum(check(message, peer, data, mine)
                  for (message, data), mine in zip(frames, decoded))
    if signals < len(frames):
        sys.exit(f"only {signals} signals in {len(frames)} frames")
    print(f"figure: {signals} signals in {len(frames)} frames agree with {peer_name} (seed {seed})")


main(*sys.argv[1:])
