"""Stands between a client and a server on this machine, and passes on what they send later.

usage: late_relay.py PORT DELAY

Prints the port that it listens at; what comes there goes to PORT after DELAY seconds, and so does
what comes back. A line on its standard input changes that while it runs:

    DELAY         seconds each way, from now on
    DELAY LOSS    and this share of what is sent is lost on the way: as with TCP, it comes with all
                  that follows once it has been sent again, RETRANSMISSION later

Ends when either end is closed.
"""

import collections
import os
import random
import select
import socket
import sys
import time

LARGEST_READ = 1 << 20
RETRANSMISSION = 0.3  # [s]


class Way:
    """One direction: what is under way, in the order in which it was sent."""

    def __init__(self, end):
        self.end = end
        self.pieces = collections.deque()
        self.latest = 0.0

    def send(self, data, delay):
        self.latest = max(self.latest, time.monotonic() + delay)
        self.pieces.append((self.latest, data))

    def deliver(self):
        while self.pieces and self.pieces[0][0] <= time.monotonic():
            self.end.sendall(self.pieces.popleft()[1])


def relay(port, delay):
    listener = socket.socket()
    listener.bind(("127.0.0.1", 0))
    listener.listen(1)
    print(listener.getsockname()[1], flush=True)
    client, _ = listener.accept()
    server = socket.create_connection(("127.0.0.1", port))
    ways = {client: Way(server), server: Way(client)}
    for end in ways:
        end.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    commands, loss, chance = [sys.stdin], 0.0, random.Random(1)
    while True:
        due = [way.pieces[0][0] for way in ways.values() if way.pieces]
        wait = max(0.0, min(due) - time.monotonic()) if due else None
        for end in select.select([*ways, *commands], [], [], wait)[0]:
            if end is sys.stdin:
                lines = os.read(end.fileno(), 1000).decode().splitlines()
                if lines:
                    delay, loss = [*map(float, lines[-1].split()), 0.0][:2]
                else:
                    commands = []  # nobody is there any more
                continue
            try:
                data = end.recv(LARGEST_READ)
            except ConnectionError:  # an end that was killed
                return
            if not data:
                return
            ways[end].send(data, delay + (RETRANSMISSION if chance.random() < loss else 0.0))
        for way in ways.values():
            way.deliver()


if __name__ == "__main__":
    relay(int(sys.argv[1]), float(sys.argv[2]))
