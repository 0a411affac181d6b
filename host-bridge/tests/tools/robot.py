"""A host of the command set made of python-can and cantools alone: robot.py PORT DBC VOCABULARY [KEY].

Opens a LAWICEL adapter at PORT, greets the robot, tells it of an empty table, has it move up once, and
decodes every frame, and every long message after putting it together, with the DBC file. VOCABULARY is
the fingerprint of the robot's. With KEY, in hexadecimal digits, every message is sealed with Python's own
HMAC, and every one that comes must be.
"""

import hashlib
import hmac
import secrets
import sys
import time

import can
import cantools


def crc(data, width, polynomial, initial, final):
    top, mask, value = 1 << (width - 1), (1 << width) - 1, initial
    for byte in data:
        value ^= byte << (width - 8)
        for _ in range(8):
            value = ((value << 1) ^ polynomial if value & top else value << 1) & mask
    return value ^ final


def crc8(data):
    return crc(data, 8, 0x1D, 0xFF, 0xFF)


def crc16(data):
    return crc(data, 16, 0x1021, 0xFFFF, 0)


SEALED = 0x8000
TAG = 4
TO_ROBOT, FROM_ROBOT = 3, 4


class Host:
    def __init__(self, port, database, key):
        self.bus = can.Bus(interface="slcan", channel=port, bitrate=1_000_000, sleep_after_open=0.1)
        self.database = database
        self.heard = []
        self.frames = 0
        self.long = b""
        self.wanted = 0
        self.key = key
        self.nonces = None
        self.said = 0
        self.newest = -1

    def tag(self, way, counter, identifier, data):
        robot, host = self.nonces
        parts = [bytes([way]), robot.to_bytes(8, "little"), host.to_bytes(8, "little")]
        parts += [counter.to_bytes(8, "little"), identifier.to_bytes(2, "little"), data]
        return hmac.new(self.key, b"".join(parts), hashlib.sha256).digest()[:TAG]

    def carry(self, identifier, data):
        """A long message, in frames of HostLong; sealed once the robot's challenge is there."""
        if self.nonces:
            counter, self.said = self.said, self.said + 1
            data += (counter & 0xFFFF).to_bytes(2, "little") + self.tag(TO_ROBOT, counter, identifier, data)
            identifier |= SEALED
        carried = identifier.to_bytes(2, "little") + data
        carried += crc16(carried).to_bytes(2, "little")
        identifier = self.database.get_message_by_name("HostLong").frame_id
        self.send(identifier, (0x1000 | len(carried)).to_bytes(2, "big") + carried[:6])
        for number, at in enumerate(range(6, len(carried), 7), start=1):
            data = bytes([0x20 | number & 0xF]) + carried[at : at + 7]
            self.send(identifier, data.ljust(8, b"\0"))

    def opened(self, identifier, data):
        """What is under the seal."""
        data, counter, tag = data[: -TAG - 2], int.from_bytes(data[-TAG - 2 : -TAG], "little"), data[-TAG:]
        assert counter > self.newest, (counter, self.newest)
        self.newest = counter
        assert tag == self.tag(FROM_ROBOT, counter, identifier, data), identifier
        return data

    def prove(self):
        nonce = secrets.randbits(64)
        [challenge] = [values for name, values in self.heard if name == "Challenge"]
        self.nonces = (challenge["Nonce"], nonce)
        self.say("Prove", {"Nonce": nonce})

    def send(self, identifier, data):
        self.bus.send(can.Message(arbitration_id=identifier, data=data, is_extended_id=False))

    def beat(self, number):
        message = self.database.get_message_by_name("HostBeat")
        data = bytearray(message.encode({"IdRun": 77, "IdNumber": number, "Check": 0}))
        if self.nonces:
            return self.carry(message.frame_id, bytes(data[:7]))
        data[7] = crc8(message.frame_id.to_bytes(2, "little") + data[:7])
        self.send(message.frame_id, data)

    def say(self, name, values):
        message = self.database.get_message_by_name(name)
        every = {signal.name: 0 for signal in message.signals} | values
        self.carry(message.frame_id, message.encode(every))

    def hear(self, seconds):
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            frame = self.bus.recv(timeout=0.02)
            if frame is not None:
                self.take(frame)

    def take(self, frame):
        self.frames += 1
        message = self.database.get_message_by_frame_id(frame.arbitration_id)
        values = message.decode(frame.data)
        if message.name != "RobotLong":
            check = crc8(frame.arbitration_id.to_bytes(2, "little") + frame.data[:7])
            assert values["Check"] == check, frame
            assert not self.key, f"{message.name} in clear"
            self.heard.append((message.name, values))
        elif values["Kind"] == "First":
            self.wanted = values["LengthHigh"] << 8 | values["LengthLow"]
            self.long = bytes(frame.data[2:])
        else:
            self.long += bytes(frame.data[1:])
            if len(self.long) >= self.wanted:
                self.whole(self.long[: self.wanted])

    def whole(self, carried):
        assert crc16(carried[:-2]) == int.from_bytes(carried[-2:], "little"), carried
        identifier, data = int.from_bytes(carried[:2], "little"), carried[2:-2]
        if identifier & SEALED:
            identifier &= ~SEALED
            data = self.opened(identifier, data)
        message = self.database.get_message_by_frame_id(identifier)
        assert carried[1] & 0x80 or not self.key or message.name == "Challenge", message.name
        # A message of at most seven bytes has a check in the DBC file, which a seal stands for.
        data = data.ljust(message.length, b"\0")
        self.heard.append((message.name, message.decode(data)))

    def names(self):
        return [name for name, _ in self.heard]


def main():
    port, dbc, vocabulary, *key = sys.argv[1:]
    key = bytes.fromhex(key[0]) if key else None
    host = Host(port, cantools.database.load_file(dbc), key)
    host.beat(0)
    host.hear(0.2)
    if key:
        host.prove()
        host.beat(0)
        host.hear(0.2)
    assert "Welcome" in host.names(), host.names()
    host.say("Scene", {"Version": 5, "Vocabulary": int(vocabulary), "Things": 0})
    command = {"IdRun": 77, "IdNumber": 1, "Scene": 5, "Motion": "MoveUp", "Direction": "None"}
    command |= {"ObjectName": 255, "StorageName": 255, "Distance": 500, "Angle": 65535}
    host.say("Execute", command)
    for _ in range(100):
        host.beat(1)
        host.hear(0.1)
        if "Done" in host.names():
            break
    names = host.names()
    for name in ["Accepted", "Step", "RobotBeat", "Joints123", "Joints456", "Joint7Gripper", "Done"]:
        assert name in names, (name, host.heard)
    accepted = next(values for name, values in host.heard if name == "Accepted")
    assert (accepted["IdRun"], accepted["IdNumber"]) == (77, 1), accepted
    # The same name again is not done again.
    host.heard.clear()
    host.say("Execute", command)
    host.hear(0.3)
    assert "Step" not in host.names(), host.names()
    host.bus.shutdown()
    sealed = f", {host.newest + 1} messages under a seal" if key else ""
    print(f"python-can and cantools: {host.frames} frames decoded{sealed}")


main()
