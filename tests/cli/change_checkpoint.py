"""change_checkpoint.py FILE NUMBER VALUE - sets a number of the state in a checkpoint, and the sum.

NUMBER is counted from 0, a negative one from the end of the state; with VALUE 'count' it prints how
many there are.  The format is in cli/run/checkpoint.c."""
import struct
import sys

HEADER, STATE = 12, 8  # words of the header; the one that counts the words of the state


def sum_of(data):
    """FNV-1a, 64 bits."""
    h = 0xcbf29ce484222325
    for byte in data:
        h = (h ^ byte) * 0x100000001b3 & (1 << 64) - 1
    return h


path, number, value = sys.argv[1], int(sys.argv[2]), sys.argv[3]
with open(path, 'rb') as file:
    data = bytearray(file.read())
assert struct.unpack_from('<Q', data, len(data) - 8)[0] == sum_of(data[:-8]), 'another format'
count = struct.unpack_from('<Q', data, 8 * STATE)[0]
if value == 'count':
    sys.exit(print(count))
struct.pack_into('<d', data, 8 * (HEADER + (number if number >= 0 else count + number)), float(value))
struct.pack_into('<Q', data, len(data) - 8, sum_of(data[:-8]))
with open(path, 'wb') as file:
    file.write(data)
