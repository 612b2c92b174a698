#!/usr/bin/env python3
"""The live view's server under misuse: whatever is asked, the run goes on and nothing but its own comes out.

    watch_misuse.py PROGRAM CASE WORK

Starts a run with --watch on a free port of the loopback device, asks it for what it should not give, then
stops it; what it has written must be, byte for byte, what a run writes that nobody watches.
"""
import http.client
import json
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
import zlib
from pathlib import Path

SECRET = b"not-for-the-network"
CLIENTS = 200
SECONDS = 20  # longest wait for any answer


def start(program, case, folder, end, *options):
    return subprocess.Popen(
        [program, "run", str(case), "-o", str(folder), "--set", f"time.end={end}",
         "--set", "output.interval=0.1", *options],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def port_of(process):
    for line in process.stdout:
        found = re.search(r"http://127\.0\.0\.1:(\d+)/", line)
        if found:
            return int(found[1])
    sys.exit("the run printed no address")


def get(port, path, method="GET", body=None, headers=None):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=SECONDS)
    try:
        connection.request(method, path, body=body, headers=headers or {})
        answer = connection.getresponse()
        return answer.status, answer.read()
    finally:
        connection.close()


def raw(port, data, wait=2):
    """What the server answers to bytes as they are; empty if it hangs up, or waits for more."""
    with socket.create_connection(("127.0.0.1", port), timeout=wait) as link:
        try:
            link.sendall(data)
            link.shutdown(socket.SHUT_WR)
            answer = b""
            while part := link.recv(65536):
                answer += part
            return answer
        except OSError:
            return b""


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")
    print(f"ok: {what}", flush=True)


def check_what_it_gives(port):
    status, page = get(port, "/")
    expect(status == 200 and b"page-data" in page, "the page")
    state = json.loads(get(port, "/state")[1])
    expect(state["frames"] >= 1 and state["tables"]["history"] > 0, "the state")
    expect(len(json.loads(get(port, "/frames?from=0")[1])) >= 1, "the list of frames")
    package = zlib.decompress(get(port, "/frame?number=0")[1])
    length = int.from_bytes(package[:4], "little")
    expect(json.loads(package[4:4 + length])["t"] == 0.0, "a frame")
    table = get(port, "/history.csv?from=5")[1]
    expect(get(port, "/history.csv")[1][5:5 + len(table)] == table, "the rest of a table")
    expect(get(port, "/history.csv?from=999999999999")[1] == b"", "no rest of a table")


def check_traversal(port, work):
    (work / "secret.csv").write_bytes(SECRET)
    paths = ["/../secret.csv", "/..%2fsecret.csv", "/%2e%2e/secret.csv", "/....//secret.csv",
             "/history.csv/../../secret.csv", "//secret.csv", "/run/../../secret.csv", "/..\\secret.csv",
             "/%5c..%5csecret.csv", "/history.csv%00.html", "/run.json", "/checkpoint-000000.h5", "/surface",
             "/surface/surface-000000.vtu", "/etc/passwd", "/../../../../../../etc/passwd", "*", "/."]
    for path in paths:
        answer = raw(port, f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n".encode())
        status = answer.split(b" ")[1:2]
        if SECRET in answer or b"root:" in answer or status == [b"200"]:
            sys.exit(f"FAILED: {path} was answered with {answer[:200]}")
    print(f"ok: {len(paths)} paths lead nowhere", flush=True)


def check_numbers(port):
    for text in ["-1", "1e9", "x", "", "0x10", " 1", "18446744073709551616", "1;2", "%00"]:
        status, body = get(port, f"/frame?number={text}".replace(" ", "%20"))
        if status not in (400, 404):
            sys.exit(f"FAILED: number={text!r} was answered with {status} {body[:80]}")
    expect(get(port, "/frame?number=999999")[0] == 404, "numbers that are none, or too large")


def check_malformed(port):
    host = f"Host: 127.0.0.1:{port}\r\n".encode()
    oversized = [b"GET /" + b"a" * 100_000 + b" HTTP/1.1\r\n" + host + b"\r\n",
                 b"GET / HTTP/1.1\r\n" + host + b"X: " + b"b" * 100_000 + b"\r\n\r\n",
                 b"GET / HTTP/1.1\r\n" + host + b"X: y\r\n" * 50_000 + b"\r\n"]
    for request in oversized:
        if raw(port, request).startswith(b"HTTP/1.1 200"):
            sys.exit("FAILED: an oversized request was answered as if it were none")
    for request in [b"", b"\r\n\r\n", b"\x00\xff\xfe" * 1000, b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n",
                    b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", b"GET / HTTP/1.1\r\nHost\r\n\r\n",
                    b"GET / HTTP/1.1\r\n" + host + b"Content-Length: -5\r\n\r\n",
                    b"GET / HTTP/1.1\r\n" + host + b"Content-Length: 99999999999999999999\r\n\r\n",
                    b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"]:
        raw(port, request)
    expect(get(port, "/state")[0] == 200, "alive after oversized and malformed requests")


def check_methods(port):
    for method in ["POST", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE"]:
        status, _ = get(port, "/state", method)
        if status not in (405, 501):
            sys.exit(f"FAILED: {method} was answered with {status}")
    try:
        status, _ = get(port, "/state", "POST", body=b"x" * 5_000_000)
    except OSError:
        status = 405  # hung up before all was sent
    expect(status in (405, 413), "other methods, and bodies, are refused")
    expect(get(port, "/state", "GET", body=b"x")[0] == 413, "a GET with a body is refused")
    expect(get(port, "/state", headers={"Host": "elsewhere.example"})[0] == 403, "another host's name is refused")


def crowd(port):
    """Many who ask at once: how many got an answer."""
    answered = []

    def ask():
        try:
            for path in ("/", "/state", "/frame?number=0"):
                if get(port, path)[0] != 200:
                    return
            answered.append(1)
        except OSError:
            pass

    threads = [threading.Thread(target=ask) for _ in range(CLIENTS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return len(answered)


def slow_clients(port, count):
    """Those who begin a request, or read an answer, and then do nothing."""
    links = []
    for k in range(count):
        link = socket.create_connection(("127.0.0.1", port), timeout=SECONDS)
        link.sendall(b"GET / HT" if k % 2 else f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
        links.append(link)
    return links


def main():
    program, case, work = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    process = start(program, case, work / "watched", 1000, "--watch", "--port", "0")
    port = port_of(process)
    try:
        while json.loads(get(port, "/state")[1])["frames"] == 0:
            time.sleep(0.05)
        check_what_it_gives(port)
        check_traversal(port, work)
        check_numbers(port)
        check_malformed(port)
        check_methods(port)
        slow = slow_clients(port, 40)
        began = time.monotonic()
        expect(get(port, "/state")[0] == 200 and time.monotonic() - began < 2, "40 slow clients hold up nobody")
        expect(crowd(port) == CLIENTS, f"{CLIENTS} clients at once beside them are all answered")
        expect(process.poll() is None, "the run goes on")
        for link in slow:
            link.close()
        second = subprocess.run([program, "run", str(case), "-o", str(work / "second"), "--watch", "--port", str(port)],
                                capture_output=True, text=True)
        expect(second.returncode == 2 and "cannot listen" in second.stderr and not (work / "second").exists(),
               "a port in use is refused before anything is written")
        process.send_signal(signal.SIGINT)
        process.stdout.read()
        expect(process.wait() == 1, "the run stops when it is told to, after its step")
    finally:
        process.kill()
    try:
        get(port, "/state")
        sys.exit("FAILED: the server outlives the run")
    except OSError:
        print("ok: the server stops with the run")
    alone = start(program, case, work / "alone", 0.1)
    alone.stdout.read()
    expect(alone.wait() == 0, "the beginning of the same run without --watch")
    for name in ("history.csv", "drops.csv", "surface/surface-000000.vtu"):
        expect((work / "watched" / name).read_bytes().startswith((work / "alone" / name).read_bytes()),
               f"the same bytes: {name}")


if __name__ == "__main__":
    main()
