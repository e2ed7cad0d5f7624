"""Talks to the UART example on a board with the generated host files; needs pyserial. Neither was tried on a board.

    PYTHONPATH=rtl/host python3 examples/board.py pair /dev/ttyUSB0
    PYTHONPATH=engine/host python3 examples/board.py query /dev/ttyUSB0 answer.json

`pair` should print verdict 1, intersect, with tag 7; `query` the pairs that `efsat tree answer` has written to answer.json.
"""

import json
import sys

import serial


def pair(line):
    from efsat import ANSWER_WORD_BITS, answers, answers_to, number, pairs_packet, pose_packet

    def ask(packet, count):
        line.write(packet)
        return line.read(count * ANSWER_WORD_BITS // 8)

    print(answers(ask(pose_packet([0] * 12, bypass=True), 1)))  # the second triangle stays as it is
    a = [0, 0, 0, 1, 0, 0, 0, 1, 0]  # coordinates are within 1; others are refused
    b = [0.25, 0.25, -0.25, 0.375, 0.3125, 0.25, 0.5, 0.375, 0.3125]
    pairs = [([number(x) for x in a + b], 7)]
    print(answers_to(pairs, ask(pairs_packet(pairs), 1)))


def query(line, file):
    from efsat_engine import answer

    def ask(words, is_query=False):
        packet = b"".join(int(word, 16).to_bytes(8, "little") for word in words)
        line.write(packet)
        received = b""
        while True:
            received += line.read(8)
            try:
                return answer(received, packet if is_query else None)
            except ValueError:  # it is not all there yet
                pass

    with open(file) as text:
        packets = json.load(text)
    for load in packets["loads"]:
        print(ask(load))  # no pairs, and a report with reason 0
    pairs, report = ask(packets["query"], is_query=True)
    print(len(pairs), report)


def main(what, port, *files):
    {"pair": pair, "query": query}[what](serial.Serial(port, 1_000_000, timeout=1), *files)


if __name__ == "__main__":
    main(*sys.argv[1:])
