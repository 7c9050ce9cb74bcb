"""change_checkpoint.py FILE NUMBER VALUE - sets a number of the state in a checkpoint, and the sum.
change_checkpoint.py FILE all DIRECTORY VALUE... - writes DIRECTORY/NUMBER_VALUE for every number and value.

change_checkpoint.py FILE PART WORD VALUE - sets a word of its header, statistics or record, a double if VALUE has a point.

NUMBER is counted from 0, a negative one from the end of the state.  The format is in cli/run/checkpoint.c."""
import struct
import sys

# Words of the header; those that count the words of the state, the statistics and their words.
HEADER, STATE, STATISTICS, WORDS = 12, 8, 9, 10


def sum_of(data):
    """FNV-1a, 64 bits."""
    h = 0xcbf29ce484222325
    for byte in data:
        h = (h ^ byte) * 0x100000001b3 & (1 << 64) - 1
    return h


def header(word):
    return struct.unpack_from('<Q', data, 8 * word)[0]


def write(path, word, value):
    changed = bytearray(data)
    struct.pack_into('<d' if type(value) is float else '<q', changed, 8 * word, value)
    struct.pack_into('<Q', changed, len(changed) - 8, sum_of(changed[:-8]))
    with open(path, 'wb') as file:
        file.write(changed)


path, number = sys.argv[1:3]
with open(path, 'rb') as file:
    data = file.read()
assert struct.unpack_from('<Q', data, len(data) - 8)[0] == sum_of(data[:-8]), 'another format'
count = header(STATE)
if number == 'all':
    for value in sys.argv[4:]:
        for k in range(count):
            write(f'{sys.argv[3]}/{k}_{value}', HEADER + k, float(value))
elif len(sys.argv) == 5:
    text = sys.argv[4]
    before = {'header': 0, 'statistics': HEADER + count, 'record': HEADER + count + header(STATISTICS) * header(WORDS)}
    write(path, before[number] + int(sys.argv[3]), float(text) if '.' in text else int(text))
else:
    write(path, HEADER + int(number) % count, float(sys.argv[3]))
