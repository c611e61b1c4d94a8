"""A program in a pseudo-terminal, and what a person in front of it would see."""
import fcntl
import os
import pty
import re
import struct
import termios
import unicodedata

ESCAPE = re.compile(r"\x1b\[[0-9;]*[A-Za-z]")


def run(command, columns, environment, folder):
    """What the program wrote, both streams as one, and its exit code."""
    kept = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "LC_ALL", "LC_CTYPE", "COLUMNS")}
    pid, terminal = pty.fork()
    if pid == 0:
        os.chdir(folder)
        fcntl.ioctl(1, termios.TIOCSWINSZ, struct.pack("HHHH", 50, columns, 0, 0))
        os.execve(command[0], command, {**kept, **environment})
    written = b""
    while True:
        try:
            part = os.read(terminal, 65536)
        except OSError:  # the other end is gone
            break
        if not part:
            break
        written += part
    os.close(terminal)
    return written.decode("utf-8"), os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])


def width(text):
    """Columns of text without escapes."""
    return sum(
        0 if unicodedata.combining(c) else 2 if unicodedata.east_asian_width(c) in "WF" else 1
        for c in text
    )


def plain(text):
    return ESCAPE.sub("", text)


def written_lines(text):
    """Every stretch between two line ends or returns: what stood on the screen at some time."""
    return re.split(r"[\r\n]", plain(text))


def screen(text):
    """What stands there in the end: a return goes on over the same line."""
    lines = []
    for line in plain(text).replace("\r\n", "\n").split("\n"):
        shown = ""
        for part in line.split("\r"):
            shown = part + shown[len(part):]
        lines.append(shown.rstrip())
    return lines
