# SPDX-License-Identifier: Apache-2.0
"""
The door of a machine for tests, as sshd is that of a real one: what runs behind it belongs to that machine, and is no child of the
process that has asked for it.

`machine_door.py serve SOCKET`: runs commands for whoever connects, each in a session of its own; the connection is the
command's input and output. Also ends the zombies there, so it can be the first process of a machine.
`machine_door.py enter SOCKET COMMAND …`: runs a command there, and ends with its exit code. When this process dies, the command's
input ends, and nobody reads its output any more.
"""

import json
import os
import signal
import socket
import struct
import sys
import threading


def serve(path):
    """Prints `ready` when it listens."""
    wake, waker = socket.socketpair()
    waker.setblocking(False)
    signal.set_wakeup_fd(waker.fileno(), warn_on_full_buffer=False)
    signal.signal(signal.SIGCHLD, lambda *_: None)
    door = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    door.bind(path)
    door.listen(64)
    print('ready', flush=True)
    threading.Thread(target=accept, args=(door,), daemon=True).start()
    wait_for_ends(wake)


running = {}  # the descriptors that get the exit codes, by process
lock = threading.Lock()


def accept(door):
    while True:
        connection, _ = door.accept()
        size, descriptors, _, _ = socket.recv_fds(connection, 4, 2)
        words = json.loads(read_exactly(connection, struct.unpack('=I', size)[0]))
        errors, code = descriptors
        with lock:  # until the process is known, nobody looks whether it has ended
            try:
                here = connection.fileno()
                pid = os.posix_spawnp(words[0], words, os.environ, setsid=True,
                                      file_actions=[(os.POSIX_SPAWN_DUP2, here, 0), (os.POSIX_SPAWN_DUP2, here, 1), (os.POSIX_SPAWN_DUP2, errors, 2)])
                running[pid] = code
            except OSError as error:
                os.write(errors, f'{words[0]}: {error.strerror}\n'.encode())
                os.write(code, bytes([127]))
                os.close(code)
        os.close(errors)
        connection.close()


def wait_for_ends(wake):
    while wake.recv(64):
        with lock:
            while True:
                try:
                    pid, status = os.waitpid(-1, os.WNOHANG)
                except ChildProcessError:
                    break
                if pid == 0:
                    break
                if (code := running.pop(pid, None)) is not None:
                    ended = os.waitstatus_to_exitcode(status)
                    try:
                        os.write(code, bytes([ended if ended >= 0 else 128 - ended]))
                    except OSError:
                        pass  # nobody waits for it any more
                    os.close(code)


def read_exactly(connection, size):
    data = b''
    while len(data) < size:
        if not (more := connection.recv(size - len(data))):
            raise EOFError
        data += more
    return data


def enter(path, words):
    connection = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    connection.connect(path)
    code, code_there = os.pipe()
    text = json.dumps(words).encode()
    socket.send_fds(connection, [struct.pack('=I', len(text))], [2, code_there])
    os.close(code_there)
    connection.sendall(text)
    threading.Thread(target=send_input, args=(connection,), daemon=True).start()
    while data := receive(connection):
        os.write(1, data)
    return (os.read(code, 1) or b'\xff')[0]


def receive(connection):
    try:
        return connection.recv(65536)
    except ConnectionResetError:  # the command has ended without reading all of its input
        return b''


def send_input(connection):
    try:
        while data := os.read(0, 65536):
            connection.sendall(data)
        connection.shutdown(socket.SHUT_WR)
    except OSError:
        pass  # the command has ended


if __name__ == '__main__':
    if sys.argv[1] == 'serve':
        serve(sys.argv[2])
    sys.exit(enter(sys.argv[2], sys.argv[3:]))
