"""Output of programs on a terminal and into a pipe."""
import os
import pty
import subprocess


def on_terminal(command, codes=(0,)):
    """Standard output if it is a terminal, and standard error."""
    leader, follower = pty.openpty()
    process = subprocess.Popen(command, stdout=follower, stderr=subprocess.PIPE)
    os.close(follower)
    text = b""
    while True:
        try:
            part = os.read(leader, 4096)
        except OSError:  # closed at the other end
            break
        if not part:
            break
        text += part
    error = process.stderr.read().decode()
    assert process.wait() in codes, error
    return text.decode().replace("\r\n", "\n"), error


def in_pipe(command, codes=(0,)):
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode in codes, done.stderr
    return done.stdout, done.stderr
