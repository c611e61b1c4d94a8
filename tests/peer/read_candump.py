"""What python-can reads from a candump log.

  read_candump.py time FILE   frames and seconds: "500000 4.2"
  read_candump.py list FILE   a line per frame: microseconds, identifier, flags, length, data, channel
"""
import sys
import time

from can.io import CanutilsLogReader


def flags(m):
    marks = ((m.is_extended_id, "x"), (m.is_remote_frame, "r"), (m.is_fd, "f"),
             (m.bitrate_switch, "b"), (m.error_state_indicator, "e"))
    return "".join(mark for is_set, mark in marks if is_set) or "-"


def line_of(m):
    data = m.data.hex() if m.data else "-"
    return f"{round(m.timestamp * 1e6)} {m.arbitration_id:x} {flags(m)} {m.dlc} {data} {m.channel}"


what, path = sys.argv[1:]
if what == "time":
    start = time.perf_counter()
    frames = sum(1 for _ in CanutilsLogReader(path))
    print(frames, time.perf_counter() - start, end="")
else:
    for message in CanutilsLogReader(path):
        print(line_of(message))
