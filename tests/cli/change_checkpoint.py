"""change_checkpoint.py FILE NUMBER VALUE - sets a number of the state in a checkpoint, and the sum.
change_checkpoint.py FILE all DIRECTORY VALUE... - writes DIRECTORY/NUMBER_VALUE for every number and value.

NUMBER is counted from 0, a negative one from the end of the state.  The format is in cli/run/checkpoint.c."""
import struct
import sys

HEADER, STATE = 12, 8  # words of the header; the one that counts the words of the state


def sum_of(data):
    """FNV-1a, 64 bits."""
    h = 0xcbf29ce484222325
    for byte in data:
        h = (h ^ byte) * 0x100000001b3 & (1 << 64) - 1
    return h


def write(path, number, value):
    changed = bytearray(data)
    struct.pack_into('<d', changed, 8 * (HEADER + number % count), float(value))
    struct.pack_into('<Q', changed, len(changed) - 8, sum_of(changed[:-8]))
    with open(path, 'wb') as file:
        file.write(changed)


path, number = sys.argv[1:3]
with open(path, 'rb') as file:
    data = file.read()
assert struct.unpack_from('<Q', data, len(data) - 8)[0] == sum_of(data[:-8]), 'another format'
count = struct.unpack_from('<Q', data, 8 * STATE)[0]
if number == 'all':
    for value in sys.argv[4:]:
        for k in range(count):
            write(f'{sys.argv[3]}/{k}_{value}', k, value)
else:
    write(path, int(number), sys.argv[3])
