#!/usr/bin/env python3
"""Writes the bad .mat files of this folder, byte by byte (MATLAB level 5). Run it in the folder.

The files are kept in the repository: the tests don't run this program.
"""
import math
import struct

DOUBLE, INT8, UINT8, INT32, UINT32, UTF8 = 9, 1, 2, 5, 6, 16
MATRIX = 14
CELL_CLASS, STRUCT_CLASS, CHAR_CLASS, DOUBLE_CLASS = 1, 2, 4, 6
ROWS = 20


def element(kind, data):
    return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


def head(name, klass, dims, flags=0):
    return (element(UINT32, struct.pack("<II", klass | flags << 8, 0))
            + element(INT32, struct.pack("<%di" % len(dims), *dims))
            + element(INT8, name.encode()))


def numbers(values):
    return element(DOUBLE, struct.pack("<%dd" % len(values), *values))


def vector(name, values, dims=None):
    return element(MATRIX, head(name, DOUBLE_CLASS, dims or (len(values), 1)) + numbers(values))


def file_header(version=0x0100, text=b"MATLAB 5.0 MAT-file, made for a test"):
    return text.ljust(116) + bytes(8) + struct.pack("<H", version) + b"IM"


def write(name, *variables, header=None):
    with open(name, "wb") as out:
        out.write((header or file_header()) + b"".join(variables))


time = [0.001 * i for i in range(ROWS)]
force = [math.cos(0.2 * i) for i in range(ROWS)]
position = [math.sin(0.2 * i) for i in range(ROWS)]
t, vir, qm = vector("t", time), vector("vir", force), vector("qm", position)

write("mat_without_map.mat", t, vir, qm)
open("mat_empty.mat", "wb").close()
write("mat_truncated_header.mat", header=file_header()[:60])
write("mat_not.mat", header=b"time_s,torque_Nm,position_rad\n" * 10)
write("mat_version_7_3.mat", header=b"MATLAB 7.3 MAT-file".ljust(116) + bytes(8) + b"\0\2IM" + b"\x89HDF")
write("mat_wrong_version.mat", t, vir, qm, header=file_header(0x0300))
write("mat_truncated.mat", t, vir, qm[:100])
write("mat_no_variables.mat")
cell = head("vir", CELL_CLASS, (1, 1)) + element(MATRIX, head("", DOUBLE_CLASS, (1, 1)) + numbers([1.0]))
write("mat_cell.mat", t, element(MATRIX, cell), qm)
fields = struct.pack("<HHI", INT32, 4, 32) + element(INT8, b"a".ljust(32, b"\0"))
struct_ = head("vir", STRUCT_CLASS, (1, 1)) + fields
struct_ += element(MATRIX, head("", DOUBLE_CLASS, (1, 1)) + numbers([1.0]))
write("mat_struct.mat", t, element(MATRIX, struct_), qm)
letters = head("vir", CHAR_CLASS, (1, 5)) + element(UTF8, b"hello")
write("mat_text.mat", t, element(MATRIX, letters), qm)
both = head("vir", DOUBLE_CLASS, (ROWS, 1), flags=8) + numbers(force) + numbers(position)
write("mat_complex.mat", t, element(MATRIX, both), qm)
write("mat_matrix.mat", t, vir, vector("qm", position, (10, 2)))
write("mat_lengths.mat", t, vir, vector("qm", position[:-1]))
write("mat_nan.mat", t, vir, vector("qm", position[:5] + [math.nan] + position[6:]))
write("mat_time_back.mat", vector("t", time[:10] + [x - 0.007 for x in time[10:]]), vir, qm)
write("mat_few_rows.mat", vector("t", time[:8]), vector("vir", force[:8]), vector("qm", position[:8]))
write("mat_missing_variable.mat", t, vir)
write("mat_fewer_numbers.mat", t, vir, vector("qm", position[:-1], (ROWS, 1)))
